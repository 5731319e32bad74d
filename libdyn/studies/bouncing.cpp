#include "libdyn/studies/bouncing.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/random.hpp"
#include "libdyn/studies/stopped_flow.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int line_samples = 128;     ///< of a period, for its lines
constexpr long watched_bounces = 20;  ///< revolutions in which it is seen whether a motion bounces
constexpr double least_share = 0.05;  ///< of the second line, to count beside the first
constexpr int tried_orbits = 6;       ///< motions at a speed that are closed by Newton's method

/// Value of a branch between the speeds of its diagram.
double frequency_at(const Campbell& diagram, int branch, double speed) {
  const auto& speeds = diagram.speeds;
  const auto& values = diagram.branches[static_cast<std::size_t>(branch)].frequency;
  const auto upper = std::upper_bound(speeds.begin(), speeds.end(), speed);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(upper - speeds.begin(), 1, std::ssize(speeds) - 1));
  const double s = (speed - speeds[i - 1]) / (speeds[i] - speeds[i - 1]);
  return values[i - 1] + s * (values[i] - values[i - 1]);
}

/// The states of a mode at unit amplitude of a contact's station, at two moments of its cycle.
struct Shape {
  Vec cosine, sine;
};

std::optional<Shape> shape_of(const Scene& scene, const Modes& modes, double frequency,
                              Whirl whirl) {
  const Mode* nearest = nullptr;
  for (const Mode& m : modes.oscillatory) {
    if (m.whirl != whirl) continue;
    if (!nearest ||
        std::abs(m.frequency() - frequency) < std::abs(nearest->frequency() - frequency)) {
      nearest = &m;
    }
  }
  if (!nearest) return std::nullopt;
  const CVec q = NearestCoordinates(scene).matrix().cast<Complex>() * nearest->shape;
  // radius of its circle at the contact that it reaches first, in clearances
  double reach = 0.0;
  for (const ReducedContact& c : scene.contacts.contacts()) {
    const Mat U = projection_of(c.geometry) * c.U;
    reach = std::max(reach, Orbit((U.row(0) * q)(0), (U.row(1) * q)(0)).major() / c.clearance);
  }
  if (!(reach > 0.0)) return std::nullopt;
  const StateLayout layout = scene.contacts.layout();
  CVec y(layout.size());
  layout.eta(y) = q;
  layout.rate(y) = nearest->lambda * q;
  y /= reach;
  return Shape{y.real(), y.imag()};
}

}  // namespace

std::array<int, 2> strongest_lines(const Scene& scene, const AutonomousFlow& flow,
                                   const AutonomousOrbit& cycle) {
  const ReducedContact& contact = scene.contacts.contacts().front();
  const StateLayout layout = scene.contacts.layout();
  std::vector<Complex> path;
  Vec y = cycle.state;
  for (int i = 0; i < line_samples; ++i) {
    const Vec2 u = contact.U * layout.eta(y);
    path.emplace_back(u(0), u(1));
    AutonomousFlow::Result at = flow.go(y, cycle.period / line_samples, WithTangent::no);
    if (at.failure) return {};
    y = std::move(at.end);
  }
  std::array<int, 2> lines{};
  std::array<double, 2> sizes{};
  for (int k = 1; k <= line_samples / 4; ++k) {  // 0 stands still seen from the rotor
    Complex forward = 0.0, backward = 0.0;
    for (int i = 0; i < line_samples; ++i) {
      const Complex turned = std::polar(1.0, turn * k * i / line_samples);
      forward += path[static_cast<std::size_t>(i)] * std::conj(turned);
      backward += path[static_cast<std::size_t>(i)] * turned;
    }
    const double size = std::hypot(std::abs(forward), std::abs(backward));
    if (size > sizes[0]) {
      lines = {k, lines[0]};
      sizes = {size, sizes[0]};
    } else if (size > sizes[1]) {
      lines[1] = k;
      sizes[1] = size;
    }
  }
  if (sizes[1] < least_share * sizes[0]) lines[1] = 0;
  if (lines[1] > lines[0]) std::swap(lines[0], lines[1]);
  return lines;
}

std::optional<Bouncing> find_bouncing(
    const std::function<std::shared_ptr<const Scene>(double speed)>& scene_at,
    const Campbell& diagram, const InternalResonance& resonance, const BouncingOptions& options) {
  std::mt19937_64 random(options.seed);
  const auto stops = [&options] { return options.is_stopped && options.is_stopped(); };
  const auto watch = [&](long) { return !stops(); };
  for (double above = 0.0; above < options.most + 0.5 * options.step; above += options.step) {
    if (stops()) return std::nullopt;
    const double speed = (1.0 + above) * resonance.speed;
    const std::shared_ptr<const Scene> scene = scene_at(speed);
    if (scene->contacts.contacts().empty()) return std::nullopt;
    const AutonomousFlow flow = until(stops, rotating_flow(scene));
    const Modes modes = complex_modes(scene->system, static_cast<int>(diagram.branches.size()) + 4);
    const auto branch = [&](int number) {
      return shape_of(*scene, modes, frequency_at(diagram, number, speed),
                      diagram.branches[static_cast<std::size_t>(number)].whirl);
    };
    const auto fast = branch(resonance.fast), slow = branch(resonance.slow);
    if (!fast || !slow) return std::nullopt;
    std::vector<Trajectory> motions;
    for (int i = 0; i < options.starts; ++i) {
      Trajectory t{.system = &scene->contacts, .revolutions = options.transient};
      t.state.y = Vec::Zero(scene->contacts.size());
      for (const Shape* shape : {&*fast, &*slow}) {
        const double amplitude = 0.2 * std::pow(10.0, random_share(random)),
                     phase = turn * random_share(random);
        t.state.y += amplitude * (std::cos(phase) * shape->cosine - std::sin(phase) * shape->sine);
      }
      motions.push_back(std::move(t));
    }
    integrate_batch(motions, {.tolerance = 1e-8, .threads = 1, .watch = watch});
    if (stops()) return std::nullopt;
    std::erase_if(motions, [](const Trajectory& t) { return t.outcome != Outcome::reached_end; });
    for (Trajectory& t : motions) {
      t.revolutions = watched_bounces;
    }
    integrate_batch(motions, {.tolerance = 1e-8, .threads = 1, .measures = true, .watch = watch});
    std::optional<Bouncing> found;
    int tried = 0;
    for (const Trajectory& t : motions) {
      const bool bounces = std::any_of(t.contacts.begin(), t.contacts.end(),
                                       [](const ContactTimes& c) { return c.impacts > 1.0; });
      if (t.outcome != Outcome::reached_end || !bounces || tried == tried_orbits) continue;
      ++tried;
      const auto guess = recurrence(*scene, t.state.y, most_recurrence);
      if (!guess) continue;
      AutonomousOrbit cycle = shorten(flow, find_autonomous_orbit(flow, t.state.y, *guess));
      if (!cycle.is_good()) continue;
      const auto lines = strongest_lines(*scene, flow, cycle);
      if (lines[0] != resonance.p || lines[1] != resonance.q) continue;
      found = Bouncing{speed, cycle.period / scene->contacts.period(), std::move(cycle), lines};
      if (found->cycle.is_stable()) break;
    }
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace whirl::inline dyn

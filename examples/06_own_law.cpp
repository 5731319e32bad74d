// A contact law of one's own, with no change of whirl: a ring with a layer that stiffens. The laws
// that whirl integrates by itself are a closed list (libcontact/laws.hpp); any other law needs an
// integration of its own, and whatever takes a flow map then takes it: orbits, multipliers,
// branches.
//
//   06_own_law models/jeffcott_stator.toml

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "libdyn/motions/start.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libio/model/model_file.hpp"

using namespace whirl;

namespace {

/// N = k d (1 + (d / width)^2)
struct StiffeningLayer {
  double k;      ///< at first [N/m]
  double width;  ///< depth at which it is twice as stiff as it was [m]

  double normal(double d) const { return k * d * (1.0 + d * d / (width * width)); }
};

/// The rotor of a scene, whose contacts follow this law instead of their own.
struct Rotor {
  const Scene& scene;
  StiffeningLayer law;
  ContactSystem free{scene.assembler, scene.reduced, {}};  ///< without contacts

  /// Which contacts the rotor is in touch with.
  std::vector<bool> touches(double phase, const Vec& y) const {
    std::vector<bool> all;
    for (const ReducedContact& contact : scene.contacts.contacts()) {
      all.push_back(kinematics(contact, phase, y.data(), free.coordinates()).depth > 0.0);
    }
    return all;
  }

  /// y' = (eta', eta'') of y = (eta, eta').
  Vec rates(double phase, const Vec& y, const std::vector<bool>& in_touch) const {
    const int n = free.coordinates();
    Vec a(n), rate(2 * n);
    free.acceleration(phase, y.data(), a.data());
    for (std::size_t i = 0; i < in_touch.size(); ++i) {
      if (!in_touch[i]) continue;
      const ReducedContact& contact = scene.contacts.contacts()[i];
      ContactForces f = kinematics(contact, phase, y.data(), n);
      f.normal = law.normal(f.depth);
      push(contact, f, contact.friction.mu * std::copysign(f.normal, f.slip), a);
    }
    rate << y.tail(n), a;
    return rate;
  }

  /// A step of the classical Runge-Kutta method [Kutta1901].
  Vec step(double phase, const Vec& y, double h, const std::vector<bool>& in_touch) const {
    const double turn = free.phase_rate() * h;
    const Vec a = rates(phase, y, in_touch);
    const Vec b = rates(phase + turn / 2.0, y + h / 2.0 * a, in_touch);
    const Vec c = rates(phase + turn / 2.0, y + h / 2.0 * b, in_touch);
    const Vec d = rates(phase + turn, y + h * c, in_touch);
    return y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }

  /// The state a revolution later. A step in which the rotor touches or parts ends there.
  Vec revolution(Vec y) const {
    const double period = free.period(), rate = free.phase_rate();
    double time = 0.0;
    while (time < period) {
      const auto in_touch = touches(rate * time, y);
      const auto stays = [&](double h) {
        return touches(rate * (time + h), step(rate * time, y, h, in_touch)) == in_touch;
      };
      double h = std::min(period / 1000.0, period - time);
      for (double low = 0.0, width = h; !stays(h) && width > 1e-15 * period; width /= 2.0) {
        (stays(low + width / 2.0) ? low : h) = low + width / 2.0;
      }
      y = step(rate * time, y, h, in_touch);
      time += h;
    }
    return y;
  }

  FlowResult passage(Vec y, long revolutions) const {
    for (long i = 0; i < revolutions; ++i) y = revolution(y);
    return {.end = y, .tangent = {}, .contacts = {}, .failure = {}};
  }

  /// The flow map, with its derivative by central differences.
  Flow flow() const {
    const Vec scale = scene.contacts.state_scale();
    return {.scale = scale,
            .period = free.period(),
            .go = [=, this](std::span<const Vec> starts, long revolutions, WithTangent wanted) {
              constexpr double difference = 1e-6;  // [scales]
              std::vector<FlowResult> all;
              for (const Vec& y : starts) {
                FlowResult p = passage(y, revolutions);
                if (wanted == WithTangent::yes) p.tangent.resize(y.size(), y.size());
                for (Eigen::Index i = 0; i < p.tangent.cols(); ++i) {
                  const Vec step = difference * scale(i) * Vec::Unit(y.size(), i);
                  p.tangent.col(i) =
                      (passage(y + step, revolutions).end - passage(y - step, revolutions).end) /
                      (2.0 * step(i));
                }
                all.push_back(p);
              }
              return all;
            }};
  }
};

/// Damping of the slowest deviation from a periodic orbit that the rotor runs into [1/s].
double damping(const Rotor& rotor, const Vec& start) {
  const Flow flow = rotor.flow();
  const PeriodicOrbit orbit = find_orbit(flow, rotor.passage(start, 50).end, {.period = 1});
  fmt::print(
      "width {:g} m: {}\n", rotor.law.width,
      orbit.is_good() ? fmt::format("{:+.4f} 1/s", orbit.exponents()(0).real()) : orbit.failure);
  return orbit.is_good() ? orbit.exponents()(0).real() : NAN;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} models/jeffcott_stator.toml\n", argv[0]);
    return 2;
  }
  const Model model =
      read_model(argv[1], {"operation.speed=136 rad/s", "contact.ring.stiffness=150 MN/m",
                           "contact.ring.friction=0.1"});
  const Scene scene = make_scene(model);
  const Vec start = start_state(model, scene, nullptr).y;
  const double linear = damping({scene, {.k = 150e6, .width = INFINITY}}, start);
  const double layer = damping({scene, {.k = 150e6, .width = 0.2e-3}}, start);
  // the linear law is one of whirl's: example 4 has it from exact events
  return std::abs(linear + 2.944044) < 1e-3 && std::abs(layer - linear) > 1e-2 ? 0 : 1;
}

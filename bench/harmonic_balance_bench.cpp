// Harmonic balance against shooting on every bundled model: error and time by the number of
// harmonics.
//
//   whirl_harmonic_balance           prints the table of docs/benchmarks.md

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "libdyn/motions/start.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/orbits/hill.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/model/model_file.hpp"

namespace whirl {
namespace {

constexpr int harmonics[] = {10, 20, 40, 80};  ///< a revolution

struct Case {
  std::string file, about;
  int period = 1;
  long transient = 500;
  std::vector<std::string> sets;
};

// where the motion that a model settles to does not repeat, one that does: without contact, or at
// rest
const Case cases[] = {
    {"jeffcott", "no contact"},
    {"overhung_disk", "no contact"},
    {"cross_coupled_bearing", "unstable, no contact", 1, 0},
    {"dropped_rotor", "always in touch", 1, 1000},
    {"jeffcott_stator", "five impacts"},
    {"jeffcott_stator", "two long contacts", 1, 500, {"contact.ring.stiffness=20e6"}},
    {"jeffcott_stator",
     "always in touch",
     1,
     500,
     {"operation.speed=151 rad/s", "contact.ring.stiffness=50e6", "contact.ring.friction=0.05"}},
    {"two_disk_mac", "no contact"},
    {"two_disk_mac", "one impact", 1, 500, {"operation.speed=225 rad/s", "gravity=9.81"}},
    {"two_disk_double_rub", "no contact"},
    {"two_disk_oil_film", "films, two impacts"},
    {"overhung_face_rub", "period 3, ring and face", 3},
    {"blade_seal", "seal and blades"}};

/// Processor time.
double milliseconds(const auto& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

std::string short_number(double x) {
  return x >= 9.95 ? fmt::format("{:.0f}", x) : fmt::format("{:.1f}", x);
}

std::string row(const Case& c) {
  const std::string path = std::string(WHIRL_MODELS) + "/" + c.file + ".toml";
  const Model model = read_model(path, c.sets);
  const Scene scene = make_scene(model);
  const ContactSystem& system = scene.contacts;
  Trajectory t{
      .system = &system, .state = start_state(model, scene, nullptr), .revolutions = c.transient};
  integrate_single(t, {});
  const Flow flow = flow_of(system);
  PeriodicOrbit exact;
  double shooting =
      milliseconds([&] { exact = find_orbit(flow, t.state.y, {.period = c.period}); });
  const HarmonicProblem problem = harmonic_problem(system);
  const Mat start = harmonic_start(system, t.state.y, c.period);

  std::vector<HarmonicOrbit> orbits;
  std::vector<HillStability> stabilities;
  std::vector<double> times[2];
  for (const int H : harmonics) {
    orbits.emplace_back();
    stabilities.emplace_back();
    times[0].push_back(milliseconds([&] {
      orbits.back() =
          find_harmonic_orbit(problem, start, {.period = c.period, .harmonics = H * c.period});
    }));
    times[1].push_back(milliseconds([&] {
      if (orbits.back().is_good()) stabilities.back() = hill_stability(problem, orbits.back());
    }));
  }
  std::string note;
  // shooting may find none from the transient, or another one
  const bool is_other =
      !exact.is_good() ||
      (orbits.back().is_good() && distance(system, exact.states[0], orbits.back().state()) > 0.1);
  if (is_other && orbits.back().is_good()) {
    std::vector<Vec> states;
    for (int i = 0; i < c.period; ++i) states.push_back(orbits.back().state(i));
    shooting = milliseconds([&] { exact = find_orbit(flow, states, {.period = c.period}); });
    note = " *";
  }
  std::string text = fmt::format("| {} | {} | {} | {}{}", c.file, c.about, system.coordinates(),
                                 short_number(shooting), note);
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    const HarmonicOrbit& orbit = orbits[i];
    if (!orbit.is_good() || !exact.is_good()) {
      text += " | -";
      continue;
    }
    double error = 0.0, of_multipliers = 0.0;
    for (int k = 0; k < c.period; ++k) {
      const Vec gap = (orbit.state(k) - exact.states[static_cast<std::size_t>(k)])
                          .cwiseQuotient(system.state_scale());
      error = std::max(error, gap.head(system.coordinates()).cwiseAbs().maxCoeff());
    }
    for (const Complex& m : stabilities[i].multipliers) {
      of_multipliers = std::max(of_multipliers, (exact.multipliers.array() - m).abs().minCoeff());
    }
    text += fmt::format(" | {:.0e}, {:.0e}; {} + {}", error, of_multipliers,
                        short_number(times[0][i]), short_number(times[1][i]));
  }
  return text + " |\n";
}

}  // namespace
}  // namespace whirl

int main() {
  fmt::print("| model | orbit | coordinates | shooting [ms]");
  for (const int H : whirl::harmonics) fmt::print(" | H = {}", H);
  fmt::print(" |\n|---|---|---|---|---|---|---|---|\n");
  for (const whirl::Case& c : whirl::cases) {
    fmt::print("{}", whirl::row(c));
    std::fflush(stdout);
  }
}

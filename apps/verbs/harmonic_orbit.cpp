// Orbits by harmonic balance: what `whirl orbit --method harmonic-balance` says.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/verbs/common.hpp"
#include "apps/verbs/orbits.hpp"
#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/orbits/hill.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl {

namespace {

constexpr long most_harmonics = 10000;

/// Differences from the orbit that shooting finds from the same states.
struct Verification {
  PeriodicOrbit shot;
  double displacement = 0.0, velocity = 0.0;  ///< at the starts of revolutions [length scales]
  double multiplier = 0.0;                    ///< of each, from the nearest of shooting
};

Verification verify(const Scene& scene, const FoundOrbit& orbit) {
  const ContactSystem& system = scene.contacts;
  const auto n = system.coordinates();
  Verification v;
  v.shot = find_orbit(flow_of(system), orbit.states, {.period = orbit.period});
  if (!v.shot.is_good()) return v;
  for (std::size_t i = 0; i < orbit.states.size(); ++i) {
    const Vec gap =
        (orbit.states[i] - v.shot.states[i]).cwiseQuotient(system.state_scale()).cwiseAbs();
    v.displacement = std::max(v.displacement, gap.head(n).maxCoeff());
    v.velocity = std::max(v.velocity, gap.tail(n).maxCoeff());
  }
  for (const Complex& m : orbit.multipliers) {
    const Vec gap = (v.shot.multipliers.array() - m).abs();
    v.multiplier = std::max(v.multiplier, gap.minCoeff());
  }
  return v;
}

std::string text_of(const HarmonicOrbit& orbit, const HillStability& hill) {
  std::string text = fmt::format(
      "residual {:.1e} length scales\n  {} harmonics of {}", orbit.residual, orbit.harmonics(),
      orbit.motion.period == 1 ? std::string("the speed")
                               : fmt::format("1/{} of the speed", orbit.motion.period));
  text += std::isfinite(orbit.truncation)
              ? fmt::format(", those left out change displacements by about {:.1e} length scales",
                            orbit.truncation)
              : std::string(", what those left out change is not known");
  if (!hill.failure.empty()) text += "\n  stability: " + hill.failure;
  if (hill.averaged > 0) {
    text +=
        fmt::format("\n  {} multipliers of modes too fast for the harmonics are from mean forces",
                    hill.averaged);
  }
  if (hill.missing > 0) {
    text += fmt::format("\n  {} multipliers below 1e-4 are left out", hill.missing);
  }
  return text;
}

}  // namespace

int harmonics_of(const Invocation& call, int period) {
  if (!call.has("harmonics")) return 0;
  const long harmonics = call.integer("harmonics");
  if (harmonics < period || harmonics > most_harmonics) {
    throw ModelError({"--harmonics " + call.text("harmonics")}, "",
                     fmt::format("expected {} to {}: the speed is harmonic {} of the orbit", period,
                                 most_harmonics, period));
  }
  return static_cast<int>(harmonics);
}

FoundOrbit find_by_harmonic_balance(const Invocation& call, const Scene& scene, const Vec& start,
                                    int period) {
  const ContactOrbit found = find_harmonic_orbit(
      scene.contacts, start, {.period = period, .harmonics = harmonics_of(call, period)});
  const HarmonicOrbit& orbit = found.orbit;
  FoundOrbit result{.period = period, .shortest_period = period};
  result.residual = orbit.residual;
  result.failure = orbit.failure;
  for (const HarmonicOrbit::Level& level : orbit.levels) result.steps += level.steps;
  for (int i = 0; i < period; ++i) result.states.push_back(orbit.state(i));
  Record more, levels = Record::array();
  for (const HarmonicOrbit::Level& level : orbit.levels) {
    Record l;
    l.set("harmonics", level.harmonics).set("steps", level.steps).set("change", level.change);
    levels.add(l);
  }
  more.set("harmonics", orbit.harmonics())
      .set("truncation", orbit.truncation)
      .set("levels", levels);
  if (orbit.is_good()) {
    result.contacts = found.contacts;
    result.shortest_period = shortest_period(orbit);
    const HillStability hill = hill_stability(harmonic_problem(scene.contacts), orbit);
    result.multipliers = hill.multipliers;
    result.exponents = hill.exponents;
    result.is_stable = hill.is_stable();
    result.summary = text_of(orbit, hill);
    more.set("multipliers_left_out", hill.missing).set("multipliers_of_means", hill.averaged);
    if (call.has("verify")) {
      const Verification v = verify(scene, result);
      Record r;
      if (v.shot.is_good()) {
        r.set("displacement", v.displacement).set("velocity", v.velocity);
        r.set("multiplier", v.multiplier).set("residual", v.shot.residual);
        result.summary += fmt::format(
            "\n  from shooting it differs by {:.1e} in displacements, {:.1e} in velocities (length "
            "scales, and those times the speed), {:.1e} in multipliers",
            v.displacement, v.velocity, v.multiplier);
      } else {
        r.set("failure", v.shot.failure);
        result.summary += "\n  shooting from there: " + v.shot.failure;
      }
      more.set("shooting", r);
    }
    const Mat full = scene.displacement_map() * orbit.motion.coefficients;
    Vec orders(orbit.harmonics() + 1);
    CMat amplitudes(full.rows(), orders.size());
    orders(0) = 0.0;
    amplitudes.col(0) = full.col(0).cast<Complex>();
    for (Eigen::Index k = 1; k < orders.size(); ++k) {
      orders(k) = static_cast<double>(k) / period;
      amplitudes.col(k) = full.col(2 * k - 1) - Complex(0.0, 1.0) * full.col(2 * k);
    }
    const double truncation = orbit.truncation;
    result.write = [orders, amplitudes, truncation](ResultWriter& file) {
      file.dataset("/orbit/order", orders, {"", "frequency over speed", {""}});
      file.dataset("/orbit/amplitude", amplitudes,
                   {"m, rad",
                    "displacement of all points is Re sum amplitude e^(i order phase)",
                    {"", "/orbit/order"}});
      file.attribute("/orbit", "truncation", truncation);
    };
  }
  result.more = more;
  return result;
}

}  // namespace whirl

#include "libdyn/orbits/orbit_measure.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/quadrature.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int quadrature_points = 10;  ///< of a step, whose series have order 12 or so

/// Rows that are asked for at every instant.
struct Instants {
  Instants(const Scene& scene, std::span<const Point> stations, OrbitFrame frame)
      : loads(scene.contacts.excitations().begin() + 1, scene.contacts.excitations().end()),
        rows(2 * std::ssize(stations), scene.contacts.coordinates()),
        across(0, scene.contacts.coordinates()) {
    const Mat map = scene.displacement_map();
    probes = probe_rows(scene, map);
    if (frame == OrbitFrame::rotating) {
      std::vector<Probe> at_right_angles = probes_of(scene);
      for (Probe& probe : at_right_angles) probe.angle += 0.25 * turn;
      across = probe_rows(at_right_angles, scene, map);
    }
    least = most = Vec::Constant(probes.rows(), nan);
    Eigen::Index k = 0;
    for (const Point& p : stations) {
      rows.row(k++) = map.row(scene.reduced.dofs.full_index(p, X));
      rows.row(k++) = map.row(scene.reduced.dofs.full_index(p, Y));
    }
    found.radii.assign(stations.size(), 0.0);
    for (ReducedExcitation& o : loads) {
      o.cosine = scene.reduced.M * o.cosine;
      o.sine = scene.reduced.M * o.sine;
    }
  }

  /// What was found, with the work of one revolution.
  OrbitMeasure result(double revolutions) {
    found.work /= revolutions;
    for (Eigen::Index i = 0; i < most.size(); ++i) {
      found.probe_peak_to_peak.push_back(most(i) - least(i));
    }
    return std::move(found);
  }

  /// @param weight  of the instant in the integral of the power [s]
  void add(const Instant& now, const Eigen::Ref<const Vec>& eta, const Eigen::Ref<const Vec>& rate,
           double weight) {
    for (const ReducedExcitation& o : loads) {
      const double angle = o.angle(now);
      found.work += weight * (std::cos(angle) * o.cosine + std::sin(angle) * o.sine).dot(rate);
    }
    const Vec places = rows * eta;
    for (std::size_t i = 0; i < found.radii.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(2 * i);
      found.radii[i] = std::max(found.radii[i], std::hypot(places(k), places(k + 1)));
    }
    if (probes.rows() == 0) return;
    const Vec along = probes * eta, beside = across * eta;
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      const bool turns = beside.size() > 0;
      const double size = turns ? std::hypot(along(i), beside(i)) : along(i);
      least(i) = std::fmin(least(i), turns ? -size : size);
      most(i) = std::fmax(most(i), size);
    }
  }

  std::vector<ReducedExcitation> loads;  ///< but for the constant one; generalized forces
  Mat rows, probes;                      ///< what stations and probes read of the coordinates
  Mat across;                            ///< and probes at right angles to these; empty: not asked
  Vec least, most;                       ///< readings of the probes so far
  OrbitMeasure found;
};

std::vector<OrbitProbe> with_labels(const Scene& scene, const std::vector<double>& peak_to_peak) {
  std::vector<OrbitProbe> probes;
  for (const Probe& probe : probes_of(scene)) {
    probes.push_back({probe, peak_to_peak[probes.size()]});
  }
  return probes;
}

}  // namespace

OrbitMeasure measure_orbit(const Scene& scene, std::span<const Point> stations, const Vec& y,
                           double revolutions, OrbitFrame frame) {
  Instants instants(scene, stations, frame);
  const StateLayout layout = scene.contacts.layout();
  const Quadrature gauss = Quadrature::gauss(quadrature_points);
  const double end = revolutions * turn;  // within the last revolution
  Trajectory t{.system = &scene.contacts, .revolutions = static_cast<long>(std::ceil(revolutions))};
  t.state.y = y;
  Vec at(layout.size());
  integrate_single(t, {.sections = true}, [&](const Step& step) {
    const double begin = static_cast<double>(step.revolution) * turn + step.phase;
    const double share = step.after_turn(end - begin);
    for (int i = 0; i < quadrature_points && share > 0.0; ++i) {
      const double s = share * gauss.x(i);
      step.at(s, at.data());
      instants.add(step.instant(s), layout.eta(at), layout.rate(at), share * gauss.w(i) * step.h);
    }
    return true;
  });
  const auto whole = static_cast<Eigen::Index>(std::floor(revolutions));
  if (t.outcome == Outcome::reached_end) {
    instants.found.sections.resize(instants.rows.rows(), whole);
    for (Eigen::Index k = 0; k < whole; ++k) {
      instants.found.sections.col(k) =
          instants.rows * layout.eta(t.sections.data() + k * layout.size());
    }
  }
  return instants.result(revolutions);
}

OrbitMeasure measure_orbit(const Scene& scene, std::span<const Point> stations,
                           const Periodic& motion) {
  Instants instants(scene, stations, OrbitFrame::stationary);
  const int samples = 8 * motion.harmonics() + 8;
  const double weight = turn / motion.rate * motion.period / samples;
  for (int k = 0; k < samples; ++k) {
    const double theta = turn * k / samples;
    const Periodic::Instant at = motion.at(theta);
    instants.add(motion.phase(theta), at.x, at.rate, weight);
  }
  instants.found.sections.resize(instants.rows.rows(), motion.period);
  for (int k = 0; k < motion.period; ++k) {
    instants.found.sections.col(k) = instants.rows * motion.at(turn * k / motion.period).x;
  }
  return instants.result(motion.period);
}

std::vector<OrbitProbe> probes_along(const Scene& scene, const Vec& y, double revolutions,
                                     OrbitFrame frame) {
  if (probes_of(scene).empty()) return {};
  return with_labels(scene, measure_orbit(scene, {}, y, revolutions, frame).probe_peak_to_peak);
}

std::vector<OrbitProbe> probes_along(const Scene& scene, const Periodic& motion) {
  if (probes_of(scene).empty()) return {};
  return with_labels(scene, measure_orbit(scene, {}, motion).probe_peak_to_peak);
}

}  // namespace whirl::inline dyn

#include "libdyn/studies/portrait.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/numerics/constants.hpp"
#include "libdyn/motions/response.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/motions/support_loads.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int samples = 64;       ///< per revolution
constexpr int highest_order = 8;  ///< of the spectra
constexpr int sectors = 36;       ///< around a stator

/// Last sections at a point along x or y, one per column.
Vec sections_at(const Scene& scene, const Classification& found, const Point& point, Component c) {
  const StateLayout layout = scene.contacts.layout();
  const Eigen::Map<const Mat> states(found.sections.data(), layout.size(),
                                     std::ssize(found.sections) / layout.size());
  const Mat map = scene.displacement_map();
  return (map.row(scene.reduced.dofs.full_index(point, c)) * layout.eta(states)).transpose();
}

/// Share of samples in touch, by the angle to which the rotor is displaced there.
Mat contact_angles(const ContactSystem& system, const Recording& recording) {
  Mat shares = Mat::Zero(system.owners(), sectors);
  const double each = 1.0 / static_cast<double>(recording.eta.cols());
  int last = -1;
  for (const ReducedContact& c : system.contacts()) {
    if (c.owner == last) continue;  // another place
    last = c.owner;
    for (Eigen::Index j = 0; j < recording.eta.cols(); ++j) {
      if (recording.normal(c.owner, j) <= 0.0) continue;
      const Vec2 d = c.U * recording.eta.col(j) - c.offset;
      const double share = std::atan2(d(1), d(0)) / turn;
      const auto sector = static_cast<int>((share < 0.0 ? share + 1.0 : share) * sectors);
      shares(c.owner, std::min(sector, sectors - 1)) += each;
    }
  }
  return shares;
}

/// Adds what the probes read at phase 0.
void add_probe_sections(const Scene& scene, const Classification& found, long sections,
                        Portrait& to) {
  if (probes_of(scene).empty()) return;
  const StateLayout layout = scene.contacts.layout();
  const Eigen::Map<const Mat> states(found.sections.data(), layout.size(),
                                     std::ssize(found.sections) / layout.size());
  const Mat readings = probe_rows(scene, scene.displacement_map()) * layout.eta(states);
  to.probe_sections =
      Mat::Constant(readings.rows(), sections, std::numeric_limits<double>::quiet_NaN());
  to.probe_sections.leftCols(readings.cols()) = readings;
}

/// Adds what they read of a recording.
void add_probe_readings(const Scene& scene, const Mat& eta, const ResponseSpectra& spectra,
                        long lines, Portrait& to) {
  if (probes_of(scene).empty()) return;
  const Mat rows = probe_rows(scene, scene.displacement_map());
  const Mat readings = rows * eta;
  to.probe_mean = readings.rowwise().mean();
  to.probe_peak_to_peak = readings.rowwise().maxCoeff() - readings.rowwise().minCoeff();
  to.probe_spectrum.resize(readings.rows(), lines + 1);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Spectrum s = spectra.of(rows.row(i));
    for (long k = 0; k <= lines; ++k) {  // a cosine is two circles of half its amplitude
      to.probe_spectrum(i, k) = (k == 0 ? 2.0 : 4.0) * std::abs(s.at(k));
    }
  }
}

/// @param forces  x and y on each part in turn: rows, a column per sample
void add_support_forces(const Mat& forces, Portrait& to) {
  const auto even = Eigen::seq(0, forces.rows() - 2, 2), odd = Eigen::seq(1, forces.rows() - 1, 2);
  const Mat x = forces(even, Eigen::all), y = forces(odd, Eigen::all);
  to.support_largest = (x.array().square() + y.array().square()).rowwise().maxCoeff().sqrt();
  to.support_mean_x = x.rowwise().mean();
  to.support_mean_y = y.rowwise().mean();
}

}  // namespace

Vec portrait_orders(long spectrum_revolutions) {
  const long lines = spectrum_revolutions * highest_order;
  return Vec::LinSpaced(2 * lines + 1, -highest_order, highest_order);
}

Vec probe_orders(long spectrum_revolutions) {
  return Vec::LinSpaced(spectrum_revolutions * highest_order + 1, 0.0, highest_order);
}

Vec portrait_sectors() {
  const double width = turn / sectors;
  return Vec::LinSpaced(sectors, 0.5 * width, (sectors - 0.5) * width);
}

Portrait portrait_of(const Model& model, const Scene& scene, const Classification& found,
                     long sections, double tolerance, const PortraitOptions& options) {
  Portrait portrait;
  const Eigen::Index n = std::ssize(options.stations);
  portrait.poincare_x = portrait.poincare_y =
      Mat::Constant(n, sections, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Point& point = options.stations[static_cast<std::size_t>(i)].point;
    for (const Component c : {X, Y}) {
      const Vec line = sections_at(scene, found, point, c);
      (c == X ? portrait.poincare_x : portrait.poincare_y).row(i).head(line.size()) = line;
    }
  }
  add_probe_sections(scene, found, sections, portrait);
  if (options.spectrum_revolutions == 0) return portrait;

  SimulationOptions how{
      .revolutions = options.spectrum_revolutions, .discard = 0, .samples = samples};
  how.method = Taylor{};
  how.integration.tolerance = tolerance;
  const SupportLoads supports(model, scene);
  how.supports = &supports;
  const Simulation seen = simulate(scene, found.end, how);
  if (seen.recording.revolutions < options.spectrum_revolutions) return portrait;
  const ResponseSpectra spectra(scene, seen.recording);
  const long lines = options.spectrum_revolutions * highest_order;
  portrait.max_radius.resize(n);
  portrait.spectrum.resize(n, 2 * lines + 1);
  const Mat map = scene.displacement_map();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Point& point = options.stations[static_cast<std::size_t>(i)].point;
    const Mat x = map.row(scene.reduced.dofs.full_index(point, X)) * seen.recording.eta;
    const Mat y = map.row(scene.reduced.dofs.full_index(point, Y)) * seen.recording.eta;
    portrait.max_radius(i) = std::sqrt((x.array().square() + y.array().square()).maxCoeff());
    const Spectrum s = spectra.at(point);
    for (long k = -lines; k <= lines; ++k) portrait.spectrum(i, k + lines) = std::abs(s.at(k));
  }
  add_probe_readings(scene, seen.recording.eta, spectra, lines, portrait);
  portrait.contact_angle = contact_angles(scene.contacts, seen.recording);
  add_support_forces(seen.recording.on_supports, portrait);
  return portrait;
}

}  // namespace whirl::inline dyn

// Responses to forces of other frequencies than that of the speed.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libio/figures/bode_curves.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Forces by their order or frequency, each once.
std::vector<std::string> forces_of(const UnbalanceStudy& study) {
  std::vector<std::string> forces;
  for (const ForcedResponse& f : study.forced) {
    if (std::find(forces.begin(), forces.end(), f.force) == forces.end()) forces.push_back(f.force);
  }
  return forces;
}

/// The largest magnitude; what is not bounded does not count.
double largest_bounded(const CMat& a) {
  double most = 0.0;
  for (const Complex& value : a.reshaped()) {
    if (std::isfinite(std::abs(value))) most = std::max(most, std::abs(value));
  }
  return most;
}

/// Where every curve is largest.
FigureTable table_of_largest(const std::vector<double>& speed, const BodeCurves& shown) {
  FigureTable t{.header = {"", with_unit("largest p-p", shown.unit), shown_heading("at", "rpm")}};
  for (std::size_t i = 0; i < shown.names.size(); ++i) {
    double most = 0.0, at = std::nan("");
    for (Eigen::Index k = 0; k < shown.a.cols(); ++k) {
      const double size = std::abs(shown.a(static_cast<Eigen::Index>(i), k));
      if (size > most) most = size, at = speed[static_cast<std::size_t>(k)];
    }
    t.rows.push_back({shown.names[i], fmt::format("{:.4g}", 2.0 * shown.unit.factor * most),
                      std::isfinite(at) ? speed_label(at) : "–"});
  }
  return t;
}

Figure forced_figure(const ResultView& result, const std::vector<double>& speed,
                     const BodeCurves& shown, const std::string& force, const std::string& along) {
  Figure f = bode_figure(result, speed, shown);
  f.variant = fmt::format("{}, {}", force, along);
  f.probes = shown.probes;
  f.subtitle = fmt::format("Response to forces of {} along {}, amplitude peak to peak", force,
                           along == "x" || along == "y" ? along : "the probes");
  f.table = table_of_largest(speed, shown);
  f.notes = {fmt::format("At the frequency of the force, {}; phases lag behind its angle.", force)};
  return f;
}

/// Stations with a name, along x or y.
BodeCurves station_curves(const UnbalanceStudy& study, const std::string& force,
                          CVec ForcedResponse::*along) {
  std::vector<std::string> stations;
  std::vector<const CVec*> rows;
  for (const ForcedResponse& f : study.forced) {
    if (f.force != force) continue;
    if ((f.*along).size() != std::ssize(study.speeds)) {
      throw FileError("the response to forces is not of its speeds");
    }
    stations.push_back(f.label);
    rows.push_back(&(f.*along));
  }
  const std::vector<Eigen::Index> named = named_rows(stations);
  BodeCurves shown{{}, CMat(std::ssize(named), std::ssize(study.speeds)), {}, {}};
  for (std::size_t i = 0; i < named.size(); ++i) {
    const auto row = static_cast<std::size_t>(named[i]);
    shown.names.push_back(stations[row]);
    shown.a.row(static_cast<Eigen::Index>(i)) = rows[row]->transpose();
  }
  shown.unit = unit_for(2.0 * largest_bounded(shown.a), "m");
  return shown;
}

/// Whether two amplitudes are as large as each other everywhere.
bool is_as_large(const CMat& a, const CMat& b) {
  constexpr double same = 1e-6;  // of an isotropic rotor
  return largest_bounded((a.cwiseAbs() - b.cwiseAbs()).cast<Complex>()) <=
         same * largest_bounded(a);
}

std::vector<BodeCurves> reading_curves(const ResultView& result, const UnbalanceStudy& study,
                                       const std::string& force) {
  std::vector<BodeCurves> all;
  for (const ForcedReading& reading : study.forced_probes) {
    if (reading.force != force || !is_drawn(result, reading)) continue;
    if (reading.amplitude.size() != std::ssize(study.speeds)) {
      throw FileError("the readings of forces are not of their speeds");
    }
    add_reading(reading, reading.amplitude, all);
  }
  return all;
}

std::vector<Figure> forced_figures(const ResultView& result) {
  const auto& study = result_of<UnbalanceStudy>(result);
  const std::vector<double> speed = scaled(study.speeds, 1.0 / speed_unit().size);
  std::vector<Figure> figures;
  for (const std::string& force : forces_of(study)) {
    const std::vector<BodeCurves> readings = reading_curves(result, study, force);
    for (const BodeCurves& shown : readings) {
      figures.push_back(
          forced_figure(result, speed, shown, force,
                        readings.size() == 1 ? "probes" : "probes in " + shown.unit.name));
    }
    const BodeCurves x = station_curves(study, force, &ForcedResponse::x),
                     y = station_curves(study, force, &ForcedResponse::y);
    if (largest_bounded(x.a) > 0.0) figures.push_back(forced_figure(result, speed, x, force, "x"));
    if (largest_bounded(y.a) > 0.0 && !is_as_large(x.a, y.a)) {
      figures.push_back(forced_figure(result, speed, y, force, "y"));
    }
  }
  return figures;
}

}  // namespace

FigureKind forced_kind() {
  return {
      .name = "forced",
      .title = "Forces of other frequencies",
      .summary = "amplitude and phase of the responses to forces of other frequencies",
      .needs = {dataset_of<UnbalanceStudy>(&ForcedResponse::x)},
      .make = forced_figures,
  };
}

}  // namespace whirl::inline io

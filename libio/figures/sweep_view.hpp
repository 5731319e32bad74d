#pragma once
/// A sweep as its figures see it.

#include "libdyn/studies/sweep.hpp"
#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// How a way of a sweep is drawn.
struct SweepWayStyle {
  const char* name;
  Paint paint;
};
SweepWayStyle way_style(const std::string& direction);

/// A number of a station or probe; NaN where there is none.
double number_of(const Mat& m, std::size_t row, std::size_t column);

/// A sweep whose points are way after way, those of each way in the order of the values.
struct SweepView {
  explicit SweepView(const ResultView& result);

  const SweepResult& study;
  const std::vector<std::optional<SweepPoint>>& points;
  ShownAxis axis;
  std::vector<std::string> ways, stations;
  std::size_t sections = 0;  ///< of a station

  /// A point; null where it is not computed.
  const SweepPoint* point(std::size_t i) const {
    return i < points.size() && points[i] ? &*points[i] : nullptr;
  }
  /// Displacement of a station once a revolution [m].
  double x(std::size_t i, std::size_t station, std::size_t section) const {
    return point(i) ? number_of(point(i)->portrait.poincare_x, station, section) : std::nan("");
  }
  /// What a probe reads once a revolution [m].
  double reading(std::size_t i, std::size_t probe, std::size_t section) const {
    return point(i) ? number_of(point(i)->portrait.probe_sections, probe, section) : std::nan("");
  }
  /// The largest number of all contacts at a point; NaN where nothing is known.
  double most(std::size_t i, double ContactDoing::*number) const;
  /// Unit of the displacements of a station.
  DisplayUnit unit(std::size_t station) const;
};

}  // namespace whirl::inline io::figures

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/spectrum.hpp"
#include "libdyn/system/stations.hpp"
#include "libio/figures/full_spectrum.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/sampled_motion.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double drawn_tilts = 48.0;  ///< revolutions, of a path

/// The path of the tilts of a station, and its points once a revolution over the whole motion.
Figure tilt_figure(const ResultView& result, const Motion& m, const std::string& station,
                   const Mat& tilts) {
  Figure f{.variant = station, .width = 900.0, .height = 480.0};
  f.columns = 2;
  f.subtitle = fmt::format("{}: tilts{}", station, at_speed(result));
  const MotionSamples shown = m.shown(drawn_tilts), all = m.drawn(1e9);
  const DisplayUnit unit = tilt_unit(tilts.cwiseAbs().maxCoeff());
  Panel path, section;
  path.title = "path";
  section.title = "once a revolution";
  path.has_equal_scales = true;
  path.x.title = section.x.title = with_unit("θx", unit);
  path.y.title = section.y.title = with_unit("θy", unit);
  Curve line{.name = "tilt", .paint = Paint::forward};
  line.width = 1.0;
  Curve dots = dots_of_revolutions();
  Curve points{.paint = Paint::forward, .has_line = false};
  points.has_marker = true;
  points.size = 4.0;
  const auto add = [&](Curve& c, Eigen::Index j) {
    c.x.push_back(unit.factor * tilts(j, 0));
    c.y.push_back(unit.factor * tilts(j, 1));
    c.along.push_back(m.time(j));
  };
  for (Curve* c : {&line, &points}) c->along_title = "time";
  for (Eigen::Index j = shown.first; j <= shown.last; ++j) {
    add(line, j);
    if (m.ends_revolution(j)) add(dots, j);
  }
  for (Eigen::Index j = all.first; j <= all.last; ++j) {
    if (m.ends_revolution(j)) add(points, j);
  }
  path.curves.push_back(std::move(line));
  if (m.spins) path.curves.push_back(std::move(dots));
  f.panels.push_back(std::move(path));
  if (m.spins && !points.x.empty()) {
    // a motion that repeats is one point: the path's size is the scale then, not rounding
    const double room = 1e-3 * unit.factor * tilts.cwiseAbs().maxCoeff();
    keep_room(section.x, points.x, room);
    keep_room(section.y, points.y, room);
    section.curves.push_back(std::move(points));
    f.panels.push_back(std::move(section));
  } else {
    f.width = 540.0, f.columns = 1;
  }
  f.notes = m.notes(drawn_tilts);
  f.notes.push_back("θx turns y towards z, θy turns z towards x.");
  return f;
}

/// The full spectrum of the slopes dx/dz + i dy/dz = theta_y - i theta_x, of the last revolutions.
Figure tilt_spectrum(const ResultView& result, const Motion& m, const std::string& station,
                     const Mat& tilts) {
  const Eigen::Index count = spectrum_samples(m);
  if (count < 3) return {};
  CVec slopes = (tilts.col(1).tail(count).cast<Complex>() -
                 Complex(0, 1) * tilts.col(0).tail(count).cast<Complex>());
  slopes.array() -= slopes.mean();
  const Spectrum s = hann_spectrum(slopes, m.period / static_cast<double>(m.per_revolution));
  const Vec amplitude = s.ascending().cwiseAbs();
  if (!(amplitude.maxCoeff() > 0.0)) return {};
  Figure f = full_spectrum(result, station, signed_frequencies(count, s.bin), amplitude,
                           tilt_unit(amplitude.maxCoeff()));
  f.variant = station + ", spectrum";
  f.notes.push_back("Of the slopes dx/dz + i dy/dz = θy − i θx.");
  return f;
}

std::vector<Figure> tilts_figures(const ResultView& result) {
  const Motion m(result);
  const std::vector<NamedPoint> points = named_points(*result.model, *result.assembler);
  std::vector<Figure> figures;
  for (const std::size_t i : stations_by_interest(result, m.stations)) {
    const auto at = std::find_if(points.begin(), points.end(),
                                 [&](const NamedPoint& p) { return p.label() == m.stations[i]; });
    if (at == points.end()) continue;
    const Mat tilts = motion_of_point(result, m.record, at->point).rightCols<2>();
    if (!(tilts.cwiseAbs().maxCoeff() > 0.0)) continue;
    figures.push_back(tilt_figure(result, m, m.stations[i], tilts));
    Figure spectrum = tilt_spectrum(result, m, m.stations[i], tilts);
    if (!spectrum.panels.empty()) figures.push_back(std::move(spectrum));
  }
  return figures;
}

}  // namespace

FigureKind tilts_kind() {
  return {
      .name = "tilts",
      .title = "Tilts",
      .summary = "path, section and full spectrum of the tilts of a station",
      .needs = {dataset_of<MotionRecord>(&StationMotion::x)},
      .needs_model = true,
      .make = tilts_figures,
      .takes_window = true,
  };
}

}  // namespace whirl::inline io

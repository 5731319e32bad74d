// Deflection shapes of a measured motion at its peaks, beside the modes that they are most like.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libbase/error.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/rotor_backdrop.hpp"
#include "libio/figures/shaft_shapes.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Probes along the shaft that read in one direction, by their numbers.
using ProbesByAngle = std::map<long, std::vector<std::size_t>>;

ProbesByAngle probes_along_shaft(const ResultView& result, const MeasuredIdentification& measured) {
  ProbesByAngle all;
  for (std::size_t i = 0; i < measured.probes.size(); ++i) {
    const ProbeLabel& probe = measured.probes[i];
    if (!is_drawn(result, probe) || probe.is_axial()) continue;
    if (!std::isfinite(measured.probe_z(static_cast<Eigen::Index>(i)))) continue;  // at a body
    all[std::lround(probe.angle_deg())].push_back(i);
  }
  for (auto& [angle, probes] : all) {
    std::sort(probes.begin(), probes.end(), [&](std::size_t a, std::size_t b) {
      return measured.probe_z(static_cast<Eigen::Index>(a)) <
             measured.probe_z(static_cast<Eigen::Index>(b));
    });
  }
  return all;
}

/// A peak with the mode that its shape is most like.
struct PeakShape {
  const MeasuredIdentification& measured;
  const IdentifiedPeak& peak;
  int mode = -1;         ///< from 0; -1: none is like the shape
  CVec readings;         ///< of the probes [m]
  CVec mode_readings;    ///< of the mode
  Complex factor = 0.0;  ///< by which these are nearest to the readings

  PeakShape(const MeasuredIdentification& m, const IdentifiedPeak& p, Eigen::Index number)
      : measured(m), peak(p), readings(m.deflection.row(number).transpose()) {
    const int best = most_alike(p.mac);
    if (best < 0 || !(p.mac[static_cast<std::size_t>(best)] >= least_likeness)) return;
    if (best >= m.mode_readings.rows() || m.mode_readings.cols() != readings.size()) {
      throw FileError("the readings of the modes are not of the peaks and probes");
    }
    mode_readings = m.mode_readings.row(best).transpose();
    factor = mode_readings.dot(readings) / mode_readings.squaredNorm();
    mode = best;
  }
  bool has_mode() const { return mode >= 0; }
};

/// The mode along a direction, at the angle of the probes' largest reading.
Curve mode_curve(const ShaftShapes& shapes, const PeakShape& shape, double angle, Complex turned,
                 double factor) {
  Curve c{.name = "mode most like it, as large"};
  const CVec along =
      shape.factor * turned *
      (std::cos(angle) * shapes.x.col(shape.mode) + std::sin(angle) * shapes.y.col(shape.mode));
  for (std::size_t i = 0; i < shapes.z.size(); ++i) {
    c.x.push_back(per_mm() * shapes.z[i]);
    c.y.push_back(factor * along(static_cast<Eigen::Index>(i)).real());
    c.hover.push_back(shapes.names[i]);
  }
  c.dash = Dash::dashed;
  c.width = 1.2;
  return c;
}

Panel deflection_panel(const ResultView& result, const ShaftShapes& shapes, const PeakShape& shape,
                       const ProbesByAngle& probes, const DisplayUnit& unit) {
  Panel p;
  p.x = shaft_axis(shapes);
  p.y = {.title = with_unit("reading at its largest", unit)};
  const double top = unit.factor * shape.readings.cwiseAbs().maxCoeff();
  p.y.last = 1.15 * top;
  p.y.first = -p.y.last;
  add_rotor(p, result, 0.0, 0.5 * top);
  std::size_t group = 0;
  for (const auto& [degrees, numbers] : probes) {
    const Paint paint = series_paint(group);
    CVec read(std::ssize(numbers));
    for (Eigen::Index i = 0; i < read.size(); ++i) {
      read(i) = shape.readings(static_cast<Eigen::Index>(numbers[static_cast<std::size_t>(i)]));
    }
    const Complex turned = turn_of(read);
    Curve c{.name = fmt::format("probes at {}°", degrees), .paint = paint};
    c.has_line = false;
    c.has_marker = true;
    c.marker = static_cast<Marker>(group % markers);
    c.size = 9.0 - 2.0 * static_cast<double>(group % 2);  // of a round orbit both are seen
    ++group;
    for (Eigen::Index i = 0; i < read.size(); ++i) {
      const std::size_t number = numbers[static_cast<std::size_t>(i)];
      c.x.push_back(per_mm() * shape.measured.probe_z(static_cast<Eigen::Index>(number)));
      c.y.push_back(unit.factor * (turned * read(i)).real());
      c.hover.push_back(shape.measured.probes[number].name);
    }
    if (shape.has_mode()) {
      const double angle = shape.measured.probes[numbers.front()].angle;
      Curve mode = mode_curve(shapes, shape, angle, turned, unit.factor);
      mode.paint = paint;
      p.curves.push_back(std::move(mode));
    }
    p.curves.push_back(std::move(c));
  }
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::gray, Dash::dash_dot});
  return p;
}

/// Readings of the probes as amplitude and phase, and of the mode beside them.
FigureTable readings_table(const PeakShape& shape, const DisplayUnit& unit) {
  FigureTable t{.header = {"probe", with_unit("amplitude", unit), "phase [deg]"}};
  if (shape.has_mode()) {
    t.header.push_back(fmt::format("mode {} [{}]", shape.mode + 1, unit.name));
    t.header.emplace_back("its phase [deg]");
  }
  const auto add = [&](std::vector<std::string>& row, Complex reading) {
    row.push_back(fmt::format("{:.4g}", unit.factor * std::abs(reading)));
    row.push_back(with_minus(fmt::format("{:.1f}", std::arg(reading) / degree)));
  };
  for (std::size_t i = 0; i < shape.measured.probes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    std::vector<std::string> row{probe_name(shape.measured.probes[i])};
    add(row, shape.readings(at));
    if (shape.has_mode()) add(row, shape.factor * shape.mode_readings(at));
    t.rows.push_back(std::move(row));
  }
  return t;
}

std::string likeness(const PeakShape& shape) {
  if (!shape.has_mode()) return "like none of the modes compared";
  return fmt::format("mode {}, MAC {:.2f}", shape.mode + 1,
                     shape.peak.mac[static_cast<std::size_t>(shape.mode)]);
}

std::vector<Figure> measured_deflection_figures(const ResultView& result) {
  const auto& measured = result_of<MeasuredIdentification>(result);
  const std::vector<IdentifiedPeak>& peaks = result_of<Identification>(result).peaks;
  if (measured.deflection.rows() != std::ssize(peaks) ||
      measured.deflection.cols() != std::ssize(measured.probes) ||
      measured.probe_z.size() != std::ssize(measured.probes)) {
    throw FileError("the deflection shapes are not of the peaks and probes");
  }
  const ProbesByAngle probes = probes_along_shaft(result, measured);
  if (probes.empty()) return {};
  const ShaftShapes shapes = shaft_shapes(result, result_of<ModesAtPoints>(result).shape);
  constexpr std::size_t most = 6;  // beside each other
  Figure all{.variant = "all", .subtitle = "Deflection shapes at the peaks", .width = 1080.0};
  std::vector<Figure> singles;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const PeakShape shape(measured, peaks[i], static_cast<Eigen::Index>(i));
    const double largest = shape.readings.cwiseAbs().maxCoeff();
    if (!(largest > 0.0)) continue;
    if (shape.has_mode() && shape.mode >= shapes.x.cols()) {
      throw FileError("the modes of the peaks are not those of the result");
    }
    const DisplayUnit unit = unit_of(measured.probes, largest);
    const double frequency = peaks[i].frequency * result.frequency.factor;
    const std::string name =
        fmt::format("{} {}", with_minus(fmt::format("{:+.5g}", frequency)), result.frequency.name);
    Panel p = deflection_panel(result, shapes, shape, probes, unit);
    p.title = fmt::format("{} | {}", name, likeness(shape));
    Figure f{.variant = name, .height = 380.0};
    f.subtitle = "Deflection shape at the peak";
    f.table = readings_table(shape, unit);
    f.panels = {p};
    singles.push_back(std::move(f));
    if (all.panels.size() < most) all.panels.push_back(std::move(p));
  }
  if (singles.size() < 2) return singles;
  all.columns = 2;
  all.height = 80.0 + 230.0 * static_cast<double>((all.panels.size() + 1) / 2);
  std::vector<Figure> figures{std::move(all)};
  std::move(singles.begin(), singles.end(), std::back_inserter(figures));
  return figures;
}

}  // namespace

FigureKind measured_deflection_kind() {
  return {
      .name = "measured_deflection",
      .title = "Deflection shapes",
      .summary = "readings of the probes along the shaft at the peaks, and the modes like them",
      .needs = {dataset_of<MeasuredIdentification>(&MeasuredIdentification::deflection),
                dataset_of<MeasuredIdentification>(&MeasuredIdentification::probe_z),
                dataset_of<ModesAtPoints>(&ModesAtPoints::shape),
                dataset_of<PointNames>(&PointNames::z)},
      .make = measured_deflection_figures,
  };
}

}  // namespace whirl::inline io

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libio/figures/result_of.hpp"
#include "libio/figures/sampled_motion.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double drawn_contacts = 48.0;  ///< revolutions, of a phase plane

/// Distance of the rotor from the middle of a clearance at all samples, along the direction of a
/// stop, of an ellipse in the measure in which its wall is at the clearance; of a face the axial
/// one of its rim [m].
Vec distance_to_middle(const ResultView& result, const MotionRecord& record, const Contact& c) {
  const AnyGeometry geometry = geometry_of(c);
  Mat motion = motion_of_point(result, record, result.assembler->point(c.at));
  const Point against = result.assembler->point(c.against);
  if (against.kind != Point::Kind::ground) motion -= motion_of_point(result, record, against);
  if (closing_of(geometry) == Closing::tilts) {
    return arm_of(geometry) * motion.rightCols<2>().rowwise().norm();
  }
  const Mat d = motion.leftCols<2>().rowwise() - c.offset.transpose();
  Vec distance(d.rows());
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    distance(i) = distance_of(geometry, c.clearance, d.row(i).transpose());
  }
  return distance;
}

/// The section at impacts: phase of the rotor where a touch begins, and how fast the distance grew.
Panel impact_panel(const Motion& m, const Vec& distance, double clearance,
                   const std::vector<Eigen::Index>& begins) {
  Panel p;
  p.title = "where touch begins";
  Curve c{.paint = Paint::stator, .has_line = false};
  c.has_marker = true;
  c.size = 4.0;
  c.along_title = "time";
  std::vector<double> speeds;
  for (const Eigen::Index j : begins) {
    const double growth = distance(j) - distance(j - 1), step = m.time(j) - m.time(j - 1);
    const double share =
        growth > 0.0 ? std::clamp((clearance - distance(j - 1)) / growth, 0.0, 1.0) : 1.0;
    const double angle =
        (m.phase(j - 1) + share * (m.phase(j) - m.phase(j - 1))) / (2.0 * std::numbers::pi);
    c.x.push_back(360.0 * (angle - std::floor(angle)));
    speeds.push_back(growth / step);
    c.along.push_back(m.time(j - 1) + share * step);
  }
  const DisplayUnit unit = unit_for(largest_of(speeds), "m/s");
  c.y = scaled(std::move(speeds), unit.factor);
  p.x = {.title = "phase of the rotor [°]", .first = 0.0, .last = 360.0, .step = 90.0};
  p.y.title = with_unit("speed of approach", unit);
  p.y.first = 0.0;
  p.curves.push_back(std::move(c));
  return p;
}

std::vector<Figure> contact_motion_figures(const ResultView& result) {
  const Motion m(result);
  const MotionSamples shown = m.shown(drawn_contacts);
  std::vector<Figure> figures;
  const std::vector<Contact>& contacts = result.model->contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = contacts[i];
    if (c.limits) continue;               // no place
    if (turns(geometry_of(c))) continue;  // blades: another one is nearest at every moment
    const Vec distance = distance_to_middle(result, m.record, c);
    const auto begins = touches(m.record.normal, static_cast<Eigen::Index>(i), shown);
    Figure f{.variant = c.name, .width = 900.0, .height = 460.0};
    f.subtitle = fmt::format("{}: motion relative to the stator{}", c.name, at_speed(result));
    Panel plane =
        phase_plane(m, shown, {"distance", distance, rates(distance, m.time), "m"}, begins);
    const DisplayUnit unit = unit_for(distance.cwiseAbs().maxCoeff(), "m");
    plane.title = "from the middle of the clearance";
    plane.rules.push_back(
        {Rule::Kind::vertical, unit.factor * c.clearance, "clearance", Paint::stator});
    f.panels.push_back(std::move(plane));
    f.notes = m.notes(drawn_contacts);
    f.notes.push_back(rates_note(m));
    if (!begins.empty() && m.spins) {
      f.columns = 2;
      f.panels.push_back(impact_panel(m, distance, c.clearance, begins));
      f.notes.push_back(fmt::format("{} touches.", begins.size()));
    } else {
      f.width = 540.0;
      f.notes.push_back(begins.empty() ? "No touch begins." : "The rotor does not spin.");
    }
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind contact_motion_kind() {
  return {
      .name = "contact_motion",
      .title = "Relative motion",
      .summary = "distance from the middle of a clearance against its rate; section at impacts",
      .needs = {dataset_of<MotionRecord>(&MotionRecord::normal)},
      .needs_model = true,
      .make = contact_motion_figures,
      .takes_window = true,
  };
}

}  // namespace whirl::inline io

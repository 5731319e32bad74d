#include <fmt/format.h>

#include <array>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr int sectors = 36;

/// Rings and rays of a plot in polar coordinates, without frame.
void add_grid(Panel& p, double radius, const std::string& unit) {
  const double outer = axis_around({0.0, radius}, Scale::linear).last;
  for (const double share : {0.5, 1.0}) {
    Curve ring = circle("", share * outer);
    ring.paint = Paint::faint;
    ring.dash = Dash::solid;
    ring.width = 1.0;
    p.curves.push_back(ring);
    p.labels.push_back({share * outer * std::cos(0.39), share * outer * std::sin(0.39),
                        fmt::format("{:g} {}", share * outer, unit), Anchor::start, 3.0, 4.0,
                        Paint::gray});
  }
  for (int k = 0; k < 8; ++k) {
    const double angle = turn * k / 8.0;
    Curve ray{.paint = Paint::faint};
    ray.width = 1.0;
    ray.x = {0.0, outer * std::cos(angle)};
    ray.y = {0.0, outer * std::sin(angle)};
    p.curves.push_back(ray);
    constexpr std::array<const char*, 8> names{"0° (x)", "45°",  "90° (y)", "135°",
                                               "180°",   "225°", "270°",    "315°"};
    p.labels.push_back({1.1 * outer * std::cos(angle), 1.1 * outer * std::sin(angle),
                        names[static_cast<std::size_t>(k)], Anchor::middle, 0.0, 4.0, Paint::gray});
  }
  p.has_equal_scales = true;
  p.has_frame = false;
  p.x.first = p.y.first = -1.2 * outer;
  p.x.last = p.y.last = 1.2 * outer;
}

/// Direction of a contact's opening at every sample, as it is in touch.
struct Touches {
  std::vector<double> angle, force, time;
};

Touches touches_of(const ResultView& result, std::size_t contact, const MotionRecord& m) {
  const DofMap& dofs = result.assembler->dofs();
  const Contact& c = result.model->contacts[contact];
  const Point at = result.assembler->point(c.at), against = result.assembler->point(c.against);
  Mat U = Mat::Zero(2, m.basis.cols());
  for (const int k : {X, Y}) {
    if (const int i = dofs.full_index(at, k); i >= 0) U.row(k) += m.basis.row(i);
    if (const int i = dofs.full_index(against, k); i >= 0) U.row(k) -= m.basis.row(i);
  }
  Touches t;
  for (Eigen::Index j = 0; j < m.coordinates.cols(); ++j) {
    const double n = m.normal(static_cast<Eigen::Index>(contact), j);
    if (n <= 0.0) continue;
    const Vec2 d = U * m.coordinates.col(j) - c.offset;
    t.angle.push_back(std::atan2(d(1), d(0)));
    t.force.push_back(n);
    t.time.push_back(m.time(j));
  }
  return t;
}

std::vector<Figure> contact_angle_figures(const ResultView& result) {
  const auto& motion = result_of<MotionRecord>(result);
  const auto contacts = result.model->contacts.size();
  if (static_cast<std::size_t>(motion.normal.rows()) != contacts ||
      motion.basis.rows() != result.assembler->dofs().full_size)
    return {};
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < contacts; ++i) {
    const Touches t = touches_of(result, i, motion);
    if (t.angle.empty()) continue;
    const std::string name = result.model->contacts[i].name;
    Figure f{.variant = name, .width = 900.0, .height = 480.0};
    f.columns = 2;
    f.subtitle = fmt::format("{}: where around the stator it touches", name);
    Panel forces, rose;
    const DisplayUnit unit = unit_for(largest_of(t.force), "N");
    forces.title = "normal force";
    add_grid(forces, unit.factor * largest_of(t.force), unit.name);
    Curve dots{.paint = Paint::alarm, .has_line = false};
    dots.has_marker = true;
    dots.size = t.angle.size() < 200 ? 5.0 : 1.8;
    dots.along = t.time;
    dots.along_title = "time";
    std::vector<double> shares(sectors, 0.0);
    for (std::size_t j = 0; j < t.angle.size(); ++j) {
      const double n = unit.factor * t.force[j];
      dots.x.push_back(n * std::cos(t.angle[j]));
      dots.y.push_back(n * std::sin(t.angle[j]));
      dots.hover.push_back(
          fmt::format("{:.4g} {} at {:.1f}°", n, unit.name, t.angle[j] * 360.0 / turn));
      const double place = t.angle[j] < 0.0 ? t.angle[j] / turn + 1.0 : t.angle[j] / turn;
      shares[std::min<std::size_t>(sectors - 1, static_cast<std::size_t>(place * sectors))] += 1.0;
    }
    if (dots.hover.size() > 4096) dots.hover.clear();
    forces.curves.push_back(std::move(dots));

    rose.title = "share of the time in touch, by angle";
    const double whole = static_cast<double>(t.angle.size());
    add_grid(rose, 100.0 * largest_of(shares) / whole, "%");
    for (int k = 0; k < sectors; ++k) {
      const double percent = 100.0 * shares[static_cast<std::size_t>(k)] / whole;
      if (percent == 0.0) continue;
      Curve wedge{.paint = Paint::forward, .has_line = true};
      wedge.width = 0.8;
      wedge.fill = 0.55;
      wedge.x = {0.0};
      wedge.y = {0.0};
      for (int s = 0; s <= 4; ++s) {
        const double angle = turn * (k + s / 4.0) / sectors;
        wedge.x.push_back(percent * std::cos(angle));
        wedge.y.push_back(percent * std::sin(angle));
      }
      wedge.x.push_back(0.0);
      wedge.y.push_back(0.0);
      wedge.hover.assign(wedge.x.size(),
                         fmt::format("{:.0f}° to {:.0f}°: {:.2f} %", 360.0 * k / sectors,
                                     360.0 * (k + 1) / sectors, percent));
      rose.curves.push_back(std::move(wedge));
    }
    f.panels = {std::move(forces), std::move(rose)};
    f.notes = {fmt::format("In touch {:.1f} % of the recorded time.",
                           100.0 * whole / static_cast<double>(motion.time.size()))};
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind contact_angles_kind() {
  return {
      .name = "contact_angles",
      .title = "Contact angles",
      .summary = "where around the stator it touches, and how hard",
      .needs = {dataset_of<MotionRecord>(&MotionRecord::normal),
                dataset_of<MotionRecord>(&MotionRecord::coordinates)},
      .needs_model = true,
      .make = contact_angle_figures,
  };
}

}  // namespace whirl::inline io

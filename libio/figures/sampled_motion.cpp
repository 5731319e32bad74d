#include "libio/figures/sampled_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libbase/numerics/spectrum.hpp"

namespace whirl::inline io::figures {

const DofMap& dofs_of(const ResultView& result, const MotionRecord& record) {
  const DofMap& dofs = result.assembler->dofs();
  if (record.basis.rows() != dofs.full_size) {
    throw FileError("/trajectory/basis is not of the degrees of freedom of its model");
  }
  return dofs;
}

Mat motion_of_point(const ResultView& result, const MotionRecord& record, const Point& point) {
  const DofMap& dofs = dofs_of(result, record);
  Mat motion = Mat::Zero(record.coordinates.cols(), 4);
  for (int c = 0; c < 4; ++c) {
    const int row = dofs.full_index(point, c);
    if (row >= 0) motion.col(c) = (record.basis.row(row) * record.coordinates).transpose();
  }
  return motion;
}

Vec rates(const Vec& values, const Vec& time) {
  const auto count = values.size();
  Vec rate = Vec::Zero(count);
  for (Eigen::Index j = 0; j < count && count > 1; ++j) {
    const Eigen::Index before = std::max<Eigen::Index>(0, j - 1),
                       after = std::min(count - 1, j + 1);
    rate(j) = (values(after) - values(before)) / (time(after) - time(before));
  }
  if (count < 3) return rate;
  // at the ends of the record by the parabola through three samples, which are equally far apart
  const auto end = count - 1;
  rate(0) = (4.0 * values(1) - 3.0 * values(0) - values(2)) / (time(2) - time(0));
  rate(end) =
      (3.0 * values(end) - 4.0 * values(end - 1) + values(end - 2)) / (time(end) - time(end - 2));
  return rate;
}

std::vector<Eigen::Index> touches(const Mat& normal, Eigen::Index contact,
                                  const MotionSamples& samples) {
  std::vector<Eigen::Index> begins;
  if (contact < 0 || contact >= normal.rows()) return begins;
  for (Eigen::Index j = std::max<Eigen::Index>(1, samples.first); j <= samples.last; ++j) {
    if (normal(contact, j) > 0.0 && !(normal(contact, j - 1) > 0.0)) begins.push_back(j);
  }
  return begins;
}

Eigen::Index spectrum_samples(const Motion& motion) {
  return whole_revolutions(motion.size(), static_cast<long>(motion.per_revolution));
}

DisplayUnit tilt_unit(double largest) {
  if (largest >= 1.0) return {"rad", 1.0};
  return largest >= 1e-3 ? DisplayUnit{"mrad", 1e3} : DisplayUnit{"µrad", 1e6};
}

std::string rates_note(const Motion& motion) {
  return fmt::format("Rates are differences of samples, {} a revolution.", motion.per_revolution);
}

Panel phase_plane(const Motion& motion, const MotionSamples& shown, const Moving& of,
                  const std::vector<Eigen::Index>& begins) {
  const DisplayUnit unit = unit_for(of.value.cwiseAbs().maxCoeff(), of.unit),
                    per_second = unit_for(of.rate.cwiseAbs().maxCoeff(), of.unit + "/s");
  Panel p;
  p.x.title = with_unit(of.name, unit);
  p.y.title = with_unit("rate of " + of.name, per_second);
  const auto add = [&](Curve& c, Eigen::Index j) {
    c.x.push_back(unit.factor * of.value(j));
    c.y.push_back(per_second.factor * of.rate(j));
    c.along.push_back(motion.time(j));
  };
  Curve path{.name = "path", .paint = Paint::forward};
  path.width = 1.0;
  Curve dots = dots_of_revolutions();
  Curve marks{.name = "touch begins", .paint = Paint::stator, .has_line = false};
  marks.has_marker = true;
  marks.marker = Marker::triangle;
  marks.size = 6.0;
  for (Curve* c : {&path, &marks}) c->along_title = "time";
  for (Eigen::Index j = shown.first; j <= shown.last; ++j) {
    add(path, j);
    if (motion.ends_revolution(j)) add(dots, j);
  }
  for (const Eigen::Index j : begins) add(marks, j);
  p.curves.push_back(std::move(path));
  if (motion.spins) p.curves.push_back(std::move(dots));
  if (!begins.empty()) p.curves.push_back(std::move(marks));
  return p;
}

}  // namespace whirl::inline io::figures

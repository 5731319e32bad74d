#include "libio/results/torus_results.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/constants.hpp"
#include "libio/results/branch_ends.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/packed_branch.hpp"

namespace whirl::inline io {

namespace {

const std::string torus_group = "/torus";

void pack_circle(auto& in, auto& torus) {
  auto& circle = torus.circle;
  in(circle.points), in(circle.rotation), in(circle.period), in(circle.coordinate);
  in(circle.residual), in(circle.tail), in(circle.exponents), in(circle.along);
  in(torus.motion_rotation);
}

/// A walk goes on from its first point and its last one.
void pack_walk(auto& in, auto& walk, auto& branch) {
  in(branch.period);
  in.size(walk.points);
  for (auto& row : walk.points) in(row.value), in(row.rotation), in(row.growth), in(row.tail);
  if (walk.points.empty()) return;
  pack_point(in, branch.points.front());
  pack_point(in, branch.points.back());
}

void write_walks(ResultWriter& file, const ParameterAxis& axis, const TorusBranch& torus) {
  std::vector<double> value, rotation, growth, tail;
  for (const CirclePoint& p : torus.points()) {
    value.push_back(p.value);
    rotation.push_back(p.rotation);
    growth.push_back(p.growth);
    tail.push_back(p.tail);
  }
  file.dataset(torus_group + "/value", value, {axis.unit, axis.path, {""}});
  const std::vector<std::string> axes{torus_group + "/value"};
  file.dataset(torus_group + "/rotation", rotation,
               {"", "turns of the circle per revolution", axes});
  file.dataset(torus_group + "/largest_exponent", growth,
               {"", "largest exponent across the circle, per revolution", axes});
  file.dataset(torus_group + "/tail", tail, {"", "highest harmonics by the largest", axes});
  std::vector<std::optional<BranchEnd>> ends;
  for (const CircleWalk& walk : torus.walks) ends.push_back(walk.branch.end);
  write_ends(file, torus_group, "", ends);
}

}  // namespace

void write_torus(ResultWriter& file, const Scene& scene, const ParameterAxis& axis,
                 const TorusBranch& torus) {
  const InvariantCircle& circle = torus.circle;
  const Eigen::Index count = circle.points.cols();
  const Mat displacement =
      scene.displacement_map() * circle.points.topRows(scene.contacts.coordinates());
  std::vector<double> angle;
  for (Eigen::Index j = 0; j < count; ++j) {
    angle.push_back(turn * static_cast<double>(j) / static_cast<double>(count));
  }
  file.dataset(torus_group + "/angle", angle, {"rad", "angle around the circle", {""}});
  file.dataset(torus_group + "/displacement", Mat(displacement.transpose()),
               {"m, rad", "displacement of all points at phase 0", {torus_group + "/angle", ""}});
  file.attribute(torus_group, "rotation", circle.rotation / circle.period);
  file.attribute(torus_group, "period_revolutions", circle.period);
  file.attribute(torus_group, "stable", circle.is_stable() ? 1 : 0);
  if (!torus.walks.empty()) write_walks(file, axis, torus);
  Packer walk;
  pack_circle(walk, torus);
  walk.size(torus.walks);
  for (const CircleWalk& w : torus.walks) pack_walk(walk, w, w.branch);
  write_walk(file, torus_group, walk);
  file.attribute(torus_group, "complete", torus.is_complete ? 1 : 0);
}

TorusBranch read_torus(const ResultReader& file, Eigen::Index states) {
  TorusBranch torus;
  if (!file.has(torus_group + "/walk")) return torus;  // of an early version
  Unpacker walk = read_walk(file, torus_group);
  pack_circle(walk, torus);
  const Eigen::Index unknowns = torus.circle.points.size() + 2;  // the rotation and the parameter
  if (torus.circle.points.rows() != states || torus.circle.points.cols() < 3 ||
      torus.circle.coordinate >= states) {
    walk.fail(fmt::format("the circle has {} points of {} states, expected {} states",
                          torus.circle.points.cols(), torus.circle.points.rows(), states));
  }
  walk.size(torus.walks);
  for (CircleWalk& w : torus.walks) {
    BranchPoint first, last;
    w.branch.points = {first, last};
    pack_walk(walk, w, w.branch);
    if (w.points.empty()) walk.fail("a walk has no points");
    for (const BranchPoint& p : w.branch.points) {
      if (p.z.size() == unknowns && p.tangent.size() == unknowns) continue;
      walk.fail(fmt::format("a point has {} unknowns, expected {}", p.z.size(), unknowns));
    }
    w.branch.points.insert(w.branch.points.begin() + 1,
                           std::max<std::size_t>(w.points.size(), 2) - 2, {});
    if (w.points.size() == 1) w.branch.points.pop_back();
  }
  walk.finish();
  if (!torus.walks.empty()) {
    const std::vector<std::optional<BranchEnd>> ends = read_ends(file, torus_group);
    if (ends.size() != torus.walks.size()) walk.fail(fmt::format("{} ends", ends.size()));
    for (std::size_t i = 0; i < ends.size(); ++i) torus.walks[i].branch.end = ends[i];
  }
  torus.is_complete = file.number_attribute(torus_group, "complete") == 1.0;
  return torus;
}

}  // namespace whirl::inline io

#include "libio/results/torus_results.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libio/results/columns.hpp"
#include "libio/results/packed_branch.hpp"

namespace whirl::inline io {

namespace {

/// Only circles that were found are kept: none has a failure.
void pack_circle(auto& in, auto& torus) {
  auto& [circle, motion_rotation, walks, is_complete] = torus;
  auto& [points, rotation, period, coordinate, residual, tail, exponents, along, failure] = circle;
  in(points), in(rotation), in(period), in(coordinate);
  in(residual), in(tail), in(exponents), in(along);
  in(motion_rotation);
}

/// A walk goes on from its first point and its last one. It keeps no bifurcations, and ends are
/// columns of the result.
void pack_walk(auto& in, auto& walk) {
  auto& [branch, circles] = walk;
  auto& [period, points, bifurcations, end] = branch;
  in(period);
  in.size(circles);
  for (auto& row : circles) {
    auto& [value, rotation, growth, tail] = row;
    in(value), in(rotation), in(growth), in(tail);
  }
  if (circles.empty()) return;
  pack_point(in, points.front());
  pack_point(in, points.back());
}

}  // namespace

void write_torus(ResultWriter& file, const TorusBranch& torus, TorusResult result) {
  Packer walk;
  pack_circle(walk, torus);
  walk.size(torus.walks);
  for (const CircleWalk& w : torus.walks) pack_walk(walk, w);
  result.walk = walk.numbers();
  write_result(file, result);
  write_walk_format(file, TorusResult::group);
}

TorusBranch read_torus(const ResultReader& file, Eigen::Index states) {
  TorusBranch torus;
  const auto stored = read_result<TorusResult>(file);
  if (stored.walk.empty()) return torus;  // of an early version
  Unpacker walk = read_walk(file, TorusResult::group, stored.walk);
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
    pack_walk(walk, w);
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
  if (torus.walks.size() != stored.walks.size()) {
    walk.fail(fmt::format("{} ends", stored.walks.size()));
  }
  for (std::size_t i = 0; i < torus.walks.size(); ++i) {
    torus.walks[i].branch.end = stored.walks[i].branch_end();
  }
  torus.is_complete = stored.is_complete == 1;
  return torus;
}

}  // namespace whirl::inline io

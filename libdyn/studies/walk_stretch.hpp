#pragma once
/// Stretches of walks along branches, each a piece of work for any thread of any process.

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "libdyn/branches/continuation.hpp"
#include "libdyn/studies/orbit_travel.hpp"
#include "libdyn/studies/point_work.hpp"

namespace whirl::inline dyn {

/// A walk as far as it was done, which goes on from there bit by bit.
struct BegunWalk {
  bool is_curve = false;  ///< of bifurcations; else a branch of a tree
  Branch branch{};
  double direction = 1.0;  ///< of the parameter
  int harmonics = 0;       ///< of a branch by harmonic balance
  BifurcationKind kind{};  ///< of a curve
  std::string contact{};   ///< of a curve of grazings: which
  Vec by_parameter{};      ///< of its Continuation; empty: not known
};
template <class Bytes>
void travel(Bytes& bytes, Is<BegunWalk> auto& walk) {
  auto& [is_curve, branch, direction, harmonics, kind, contact, by_parameter] = walk;
  bytes(is_curve, branch, direction, harmonics, kind, contact, by_parameter);
}

/// What a stretch of a walk adds.
struct WalkNews {
  Branch branch{};                       ///< points, bifurcations and its end
  std::vector<OrbitMeasure> measures{};  ///< of a branch of a tree, per point
  std::vector<Vec> starts{};  ///< of the same points: states at phase 0, in the first basis
  Vec by_parameter{};         ///< as of BegunWalk, at the last point
};
template <class Bytes>
void travel(Bytes& bytes, Is<WalkNews> auto& news) {
  auto& [branch, measures, starts, by_parameter] = news;
  bytes(branch, measures, starts, by_parameter);
}

/// Stretches of walks as pieces: the first number tells branches from curves, the second one is the
/// number of the walk.
using WalkWork = PointWork<WalkNews, BegunWalk>;

/// When a stretch is over.
struct StretchLimits {
  std::chrono::duration<double> lasts{};  ///< the first point beyond this time ends the stretch
  std::function<bool()> is_stopped{};     ///< asked before each point and on the way to it
};

/// Walks on until a stretch is over, or the branch ends.
/// @param walk     as begun
/// @param measure  called with each point, to add its measures to the news
WalkNews walk_stretch(Continuation walk, const StretchLimits& limits,
                      const std::function<void(const BranchPoint& point, WalkNews&)>& measure = {});

}  // namespace whirl::inline dyn

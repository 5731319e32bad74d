#include "libdyn/motions/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libdyn/motions/equilibrium.hpp"
#include "libdyn/motions/late_loads.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libfe/eigen/positive_factor.hpp"

namespace whirl::inline dyn {

namespace {

/// Least share of a displacement that a place takes by itself.
constexpr double rigid = 1e-12;

Vec at_rest_under_gravity(const Model& model, const Scene& scene) {
  const bool is_loaded = model.structure.gravity != 0.0 || has_constant_force(model.structure) ||
                         !scene.contacts.constant_load().isZero(0.0);
  if (!is_loaded) return Vec::Zero(scene.contacts.coordinates());
  if (model.films.empty() && rolling_bearings(model.contacts).empty()) {
    require_supports(scene.assembler, model.speed, "start.from = \"static\" needs");
  }
  const bool is_late = std::ranges::any_of(
      model.structure.forces, [](const Force& f) { return f.is_constant() && f.begins.is_late(); });
  if (!is_late) return equilibrium(scene.contacts);
  const LateLoads late(model, scene);
  return equilibrium(*late.stages().front().system);
}

Vec end_of(const FullState* end, const Scene& scene, const NearestCoordinates& nearest) {
  if (!end) throw ModelError({}, "start.file", "no result file was given to start from");
  const Sparse& T = scene.system.dofs.T;
  if (end->displacement.size() != T.rows()) {
    throw ModelError(
        {}, "start.file",
        fmt::format("the result has {} degrees of freedom, the model {}: they do not fit",
                    end->displacement.size(), T.rows()));
  }
  // full vectors to the system's coordinates by least squares (T has full column rank)
  const Ldlt normal(Sparse(T.transpose() * T));
  const auto coordinates = [&](const Vec& full) {
    return nearest.of(normal.solve(T.transpose() * full));
  };
  const StateLayout layout = scene.contacts.layout();
  Vec y(layout.size());
  layout.eta(y) = coordinates(end->displacement);
  layout.rate(y) = coordinates(end->velocity);
  return y;
}

/// What a place does alone: the motion of least kinetic energy with it.
void displace(const Displaced& d, const Scene& scene, const NearestCoordinates& nearest, Vec& y) {
  const int n = scene.contacts.coordinates();
  const Point p = scene.assembler.point(d.at);
  Mat rows(2, n);
  rows.row(0) = scene.system.dofs.row(p, X).transpose() * scene.reduced.Phi;
  rows.row(1) = scene.system.dofs.row(p, Y).transpose() * scene.reduced.Phi;
  const Mat pull = nearest.mass().solve(rows.transpose());
  const DenseLu<Mat> share(rows * pull);
  if (!(share.rcond() > rigid)) {
    throw ModelError(d.at.where, "start.displaced", "this place cannot move by itself");
  }
  const StateLayout layout = scene.contacts.layout();
  layout.eta(y) += pull * share.solve(Vec2(d.x, d.y));
  layout.rate(y) += pull * share.solve(Vec2(d.vx, d.vy));
}

void whirl_in(const std::vector<WhirlStart>& wanted, const Modes& modes,
              const NearestCoordinates& nearest, Vec& y) {
  const StateLayout layout = StateLayout::of(y.size());
  for (const WhirlStart& w : wanted) {
    if (w.mode < 1 || w.mode > static_cast<int>(modes.oscillatory.size())) {
      throw ModelError(w.where, "start.whirl",
                       fmt::format("found mode {}, expected a mode from 1 to {}", w.mode,
                                   modes.oscillatory.size()));
    }
    const Mode& mode = modes.oscillatory[static_cast<std::size_t>(w.mode - 1)];
    const CVec q = std::polar(w.amplitude, w.phase) * mode.shape;
    layout.eta(y) += nearest.of(q.real());
    layout.rate(y) += nearest.of((mode.lambda * q).real());
  }
}

}  // namespace

int modes_of(const Start& start) {
  int highest = 0;
  for (const WhirlStart& w : start.whirl) highest = std::max(highest, w.mode);
  return highest;
}

MotionState start_state(const Model& model, const Scene& scene, const FullState* end) {
  const bool has_whirl = !model.start.whirl.empty();
  return start_state(model, scene, end,
                     has_whirl ? linear_modes(model, scene, modes_of(model.start)) : Modes{});
}

MotionState start_state(const Model& model, const Scene& scene, const FullState* end,
                        const Modes& modes) {
  const NearestCoordinates nearest(scene);
  const StateLayout layout = scene.contacts.layout();
  MotionState state;
  state.y = Vec::Zero(layout.size());
  if (model.start.from == StartFrom::equilibrium) {
    layout.eta(state.y) = at_rest_under_gravity(model, scene);
  } else if (model.start.from == StartFrom::file) {
    state.y = end_of(end, scene, nearest);
  }
  for (const Displaced& d : model.start.displaced) displace(d, scene, nearest, state.y);
  whirl_in(model.start.whirl, modes, nearest, state.y);
  return state;
}

MotionState start_state(const Model& model, const Scene& scene,
                        const std::optional<EarlierEnd>& earlier) {
  MotionState state = start_state(model, scene, earlier ? &earlier->state : nullptr);
  if (earlier) state.phase = earlier->phase;
  if (earlier && scene.contacts.repeats_after() != 1) state.revolution = earlier->revolution;
  return state;
}

}  // namespace whirl::inline dyn

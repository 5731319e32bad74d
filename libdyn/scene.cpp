#include "libdyn/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "libdyn/equilibrium.hpp"
#include "libfe/base/error.hpp"
#include "libfe/eigen/dense.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libfe/modes.hpp"
#include "libfe/static.hpp"

namespace whirl {

namespace {

constexpr std::array lateral{X, Y};
constexpr std::array lateral_and_tilts{X, Y, THETA_X, THETA_Y};
std::span<const Component> components(const Contact& c) {
  if (geometry_of(c.law) == Geometry::face) return lateral_and_tilts;
  return lateral;
}

void add_rows(std::vector<Vec>& rows, const DofMap& dofs, const Point& at, const Point& against,
              std::span<const Component> components = lateral) {
  for (const Component component : components) {
    Vec row = dofs.row(at, component) - dofs.row(against, component);
    if (row.squaredNorm() > 0.0) rows.push_back(std::move(row));
  }
}

/// Forces can only act on points that are held or have inertia: those of massless freedoms, which
/// are condensed, would not bend the shaft there.
void require_inertia(const Assembler& assembler, const System& system, const Station& station,
                     const std::string& what, std::span<const Component> components = lateral) {
  if (system.dofs.condensed == 0) return;
  const Point p = assembler.point(station);
  if (p.kind == Point::Kind::ground) return;
  const System whole = assembler.uncondensed(system.Omega);
  for (const Component component : components) {
    const Vec row = whole.dofs.row(p, component);
    const bool is_held = row.isZero(0.0), has_inertia = row.dot(whole.M * row) > 0.0;
    if (is_held || has_inertia) continue;
    throw ModelError(
        station.where, station.key,
        fmt::format("{} acts at a station without {}inertia, which cannot {} by itself: "
                    "give the shaft a density or the station a disk",
                    what, component >= THETA_X ? "rotary " : "",
                    component >= THETA_X ? "tilt" : "move"));
  }
}

}  // namespace

Scene make_scene(const Model& model, ReductionEstimate wanted) {
  Assembler assembler(model.structure);
  System system = assembler.at(model.speed);
  std::vector<Vec> ports, others;
  for (const Contact& c : model.contacts) {
    const std::string what = "contact \"" + c.name + "\"";
    require_inertia(assembler, system, c.at, what, components(c));
    require_inertia(assembler, system, c.against, what, components(c));
    add_rows(ports, system.dofs, assembler.point(c.at), assembler.point(c.against), components(c));
  }
  for (const OilFilm& film : model.films) {
    require_inertia(assembler, system, film.at, "oil film \"" + film.name + "\"");
    require_inertia(assembler, system, film.against, "oil film \"" + film.name + "\"");
    add_rows(ports, system.dofs, assembler.point(film.at), assembler.point(film.against));
  }
  for (const Unbalance& u : model.structure.unbalances) {
    require_inertia(assembler, system, u.at, "unbalance");
    add_rows(others, system.dofs, assembler.point(u.at), {});
  }
  for (const auto* list : {&model.structure.bearings, &model.structure.links}) {
    for (const Connection& c : *list) {
      if (coefficients(c.coefficients, model.speed).C.isZero(0.0)) continue;
      add_rows(others, system.dofs, assembler.point(c.from), assembler.point(c.to));
    }
  }
  ReductionError error;
  ReducedSystem reduced = reduce(system, model.reduction, ports, others,
                                 wanted == ReductionEstimate::yes ? &error : nullptr);
  ContactSystem contacts(assembler, reduced, model.contacts, model.films);
  return {std::move(assembler), std::move(system), std::move(reduced), error, std::move(contacts)};
}

Mat coordinates_of(const Scene& scene) {
  const Mat weighted = scene.reduced.Phi.transpose() * Mat(scene.system.M);
  return DenseLu<Mat>(scene.reduced.M).solve(weighted);
}

FullState full_state(const Scene& scene, const MotionState& state) {
  const Mat map = scene.displacement_map();
  const auto n = scene.contacts.coordinates();
  return {map * state.y.head(n), map * state.y.tail(n)};
}

MotionState start_state(const Model& model, const Scene& scene, const FullState* end) {
  const int n = scene.contacts.coordinates();
  MotionState state;
  state.y = Vec::Zero(2 * n);

  // the coordinates whose motion is nearest to a given one in kinetic energy
  const Mat weighted = scene.reduced.Phi.transpose() * Mat(scene.system.M);
  const DenseLu<Mat> mass(scene.reduced.M);
  const auto coordinates = [&](const Vec& q) -> Vec { return mass.solve(weighted * q); };

  switch (model.start.from) {
    case StartFrom::rest:
      break;
    case StartFrom::equilibrium:
      if (model.structure.gravity != 0.0) {
        if (model.films.empty()) {
          require_supports(scene.assembler, model.speed, "start.from = \"static\" needs");
        }
        state.y.head(n) = equilibrium(scene.contacts);
      }
      break;
    case StartFrom::file: {
      if (!end) throw ModelError({}, "start.file", "no result file was given to start from");
      const Sparse& T = scene.system.dofs.T;
      if (end->displacement.size() != T.rows()) {
        throw ModelError({}, "start.file",
                         fmt::format("the result has {} freedoms, the model {}: they do not fit",
                                     end->displacement.size(), T.rows()));
      }
      // full vectors to the system's coordinates by least squares (T has full column rank)
      const Mat dense_T(T);
      const DenseLu<Mat> normal(dense_T.transpose() * dense_T);
      state.y.head(n) = coordinates(normal.solve(dense_T.transpose() * end->displacement));
      state.y.tail(n) = coordinates(normal.solve(dense_T.transpose() * end->velocity));
      break;
    }
  }
  for (const Displaced& d : model.start.displaced) {
    // what the place does alone: the motion of least kinetic energy with it
    const Point p = scene.assembler.point(d.at);
    Mat rows(2, n);
    rows.row(0) = scene.system.dofs.row(p, X).transpose() * scene.reduced.Phi;
    rows.row(1) = scene.system.dofs.row(p, Y).transpose() * scene.reduced.Phi;
    const Mat pull = mass.solve(rows.transpose());
    const DenseLu<Mat> share(rows * pull);
    if (!(share.rcond() > 1e-12)) {
      throw ModelError(d.at.where, "start.displaced", "this place cannot move by itself");
    }
    state.y.head(n) += pull * share.solve(Vec2(d.x, d.y));
    state.y.tail(n) += pull * share.solve(Vec2(d.vx, d.vy));
  }
  if (model.start.whirl.empty()) return state;
  int highest = 0;
  for (const WhirlStart& w : model.start.whirl) highest = std::max(highest, w.mode);
  const Modes modes = complex_modes(scene.system, highest);
  for (const WhirlStart& w : model.start.whirl) {
    if (w.mode < 1 || w.mode > static_cast<int>(modes.oscillatory.size())) {
      throw ModelError(w.where, "start.whirl",
                       fmt::format("found mode {}, expected a mode from 1 to {}", w.mode,
                                   modes.oscillatory.size()));
    }
    const Mode& mode = modes.oscillatory[static_cast<std::size_t>(w.mode - 1)];
    const CVec q = std::polar(w.amplitude, w.phase) * mode.shape;
    state.y.head(n) += coordinates(q.real());
    state.y.tail(n) += coordinates((mode.lambda * q).real());
  }
  return state;
}

}  // namespace whirl

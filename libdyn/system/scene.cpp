#include "libdyn/system/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double band_by_force = 1.5;  ///< of the highest frequency of a force

constexpr std::array lateral{X, Y};
constexpr std::array tilts_alone{THETA_X, THETA_Y};
constexpr std::array lateral_and_tilts{X, Y, THETA_X, THETA_Y};
std::span<const Component> components(const Contact& c) {
  if (closing_of(geometry_of(c)) == Closing::tilts) return lateral_and_tilts;
  return lateral;
}

void add_rows(std::vector<Vec>& rows, const DofMap& dofs, const Point& at, const Point& against,
              std::span<const Component> components = lateral) {
  for (const Component component : components) {
    Vec row = dofs.row(at, component) - dofs.row(against, component);
    if (row.squaredNorm() > 0.0) rows.push_back(std::move(row));
  }
}

/// Forces can only act on points that are held or have inertia: those of massless dofs, which
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

/// Adds where a force acts. One of a base acts everywhere: its load is a row of its own.
void add_force(std::vector<Vec>& rows, const Assembler& assembler, const System& system,
               const Force& f) {
  if (f.has_station()) {
    const std::span<const Component> along =
        f.kind == ForceKind::moment ? std::span<const Component>(tilts_alone) : lateral;
    require_inertia(assembler, system, f.at, "force \"" + f.name + "\"", along);
    return add_rows(rows, system.dofs, assembler.point(f.at), {}, along);
  }
  const CVec load = system.dofs.T.transpose() * amplitude_of(f, assembler);
  for (const Vec& part : {Vec(load.real()), Vec(load.imag())}) {
    if (part.squaredNorm() > 0.0) rows.push_back(part);
  }
}

/// A reduced rotor: the band that is chosen for it reaches beyond the frequencies of its forces.
ReducedSystem reduced_rotor(const System& system, const Model& model, const std::vector<Vec>& ports,
                            const std::vector<Vec>& others, ReductionError* error) {
  Reduction how = model.reduction;
  const double highest = band_by_force * highest_frequency(model.structure, model.speed);
  const bool is_chosen = how.band == 0.0 && highest > 0.0;
  if (is_chosen && model.speed != 0.0) how.band = std::max(highest, 2.0 * std::abs(model.speed));
  if (!is_chosen || model.speed != 0.0) return reduce(system, how, ports, others, error);
  // at rest the modes say how wide it is by itself
  ReductionError found;
  ReducedSystem reduced = reduce(system, how, ports, others, &found);
  if (found.band > 0.0 && found.band < highest) {
    how.band = highest;
    return reduce(system, how, ports, others, error);
  }
  if (error) *error = found;
  return reduced;
}

}  // namespace

Scene make_scene(const Model& model, ReductionEstimate wanted) {
  return make_scene(Assembler(model.structure), model, wanted);
}

Scene make_scene(Assembler assembler, const Model& model, ReductionEstimate wanted) {
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
  for (const Force& f : model.structure.forces) add_force(others, assembler, system, f);
  for (int shaft = 0; shaft <= std::ssize(model.structure.rotors); ++shaft) {
    if (model.structure.bow_of(shaft).z.empty()) continue;
    const CVec bow = system.dofs.T.transpose() * assembler.bow(shaft);
    for (const Vec& part : {Vec(bow.real()), Vec(bow.imag())}) {
      if (part.squaredNorm() > 0.0) others.push_back(part);
    }
  }
  for (const auto& [kind, list] : model.structure.connections()) {
    for (const Connection& c : list) {
      if (assembler.coefficients_of(c, model.speed, model.speed).C.isZero(0.0)) continue;
      add_rows(others, system.dofs, assembler.point(c.from), assembler.point(c.to));
    }
  }
  ReductionError error;
  ReducedSystem reduced = reduced_rotor(system, model, ports, others,
                                        wanted == ReductionEstimate::yes ? &error : nullptr);
  ContactSystem contacts(assembler, reduced, model.contacts, model.films);
  return {std::move(assembler), std::move(system), std::move(reduced), error, std::move(contacts)};
}

Scene with_contacts(const Scene& scene, const Model& model) {
  return {scene.assembler, scene.system, scene.reduced, scene.error,
          ContactSystem(scene.assembler, scene.reduced, model.contacts, model.films)};
}

NearestCoordinates::NearestCoordinates(const Scene& scene)
    : weighted_((scene.system.M * scene.reduced.Phi).transpose()), mass_(scene.reduced.M) {}

FullState full_state(const Scene& scene, const MotionState& state) {
  const Mat map = scene.displacement_map();
  const StateLayout layout = scene.contacts.layout();
  return {map * layout.eta(state.y), map * layout.rate(state.y)};
}

}  // namespace whirl::inline dyn

#include "libdyn/motions/support_loads.hpp"

#include <cmath>
#include <utility>

#include "libdyn/system/model.hpp"
#include "libfe/analyses/connection_forces.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libfe/assembly/support_equations.hpp"

namespace whirl::inline dyn {

namespace {

/// The same freedoms with the full vector as coordinates.
DofMap of_full_vector(DofMap dofs) {
  dofs.T = Sparse(dofs.full_size, dofs.full_size);
  dofs.T.setIdentity();
  return dofs;
}

PlaneRows lateral_rows(const DofMap& full, const Point& at, const Point& against) {
  PlaneRows rows(2, full.size());
  for (const int k : {X, Y}) rows.row(k) = full.row(at, k) - full.row(against, k);
  return rows;
}

}  // namespace

std::vector<SupportLoads::Part> SupportLoads::parts_of(const Model& model,
                                                       const Assembler& assembler) {
  std::vector<Part> parts;
  for (const CarryingPart& part : carrying_parts(assembler)) {
    parts.push_back({std::string(part.kind), part.name});
  }
  for (const OilFilm& film : model.films) parts.push_back({"oil film", film.name});
  for (const Contact& bearing : rolling_bearings(model.contacts)) {
    parts.push_back({"rolling bearing", bearing.name});
  }
  return parts;
}

SupportLoads::SupportLoads(const Model& model, const Scene& scene)
    : parts_(parts_of(model, scene.assembler)),
      first_film_(2 * (std::ssize(parts_) - std::ssize(model.films) -
                       std::ssize(rolling_bearings(model.contacts)))) {
  const Assembler& assembler = scene.assembler;
  const double Omega = scene.system.Omega;
  for (const CarryingPart& part : carrying_parts(assembler)) {
    has_rigid_ = has_rigid_ || part.is_rigid;
  }
  const ConnectionForces forces(assembler, Omega, Omega, RigidRows::static_shape);
  const Mat map = scene.displacement_map();
  K_ = forces.K * map, C_ = forces.C * map, M_ = forces.M * map;
  needs_acceleration_ = !M_.isZero(0.0);
  Eigen::Index row = first_film_ + 2 * std::ssize(model.films);
  for (const Contact& c : model.contacts) {
    rows_of_bearings_.push_back(is_rolling_bearing(c) ? std::exchange(row, row + 2) : -1);
  }
  const bool any_limit =
      std::ranges::any_of(model.contacts, [](const Contact& c) { return c.limits.has_value(); });
  if (!has_rigid_ && !any_limit) return;
  add_loads(assembler, scene.contacts, forces.L);
  const DofMap full = of_full_vector(assembler.dofs());
  for (const Contact& c : model.contacts) {
    if (c.limits) {
      of_contacts_.push_back(shares_of_limit(*c.limits, assembler, forces.L));
      continue;
    }
    const PlaneRows rubbing = lateral_rows(full, assembler.point(c.at), assembler.point(c.against));
    of_contacts_.push_back(
        {forces.L * closing_rows(c, assembler, full).transpose(), forces.L * rubbing.transpose()});
  }
  for (const OilFilm& film : model.films) {
    of_films_.push_back(
        forces.L *
        lateral_rows(full, assembler.point(film.at), assembler.point(film.against)).transpose());
  }
}

SupportLoads::ContactShares SupportLoads::shares_of_limit(const LimitOfSupport& of,
                                                          const Assembler& assembler,
                                                          const Sparse& rigid) const {
  const Structure& structure = assembler.structure();
  const Support& support = structure.supports[of.support];
  const SignalLimit& limit = support.limits[of.limit];
  const LimitedSignal signal =
      limited_signal(structure, assembler.mesh(), assembler.dofs(), of.support, of.limit);
  Share closing = Share::Zero(rigid.rows(), 2);
  closing.col(0) = -(rigid * signal.force) / limit.force;
  // what the support itself has less, in whose rows the signal goes on beyond its limit
  const auto forces = support_forces(structure, assembler.mesh(), assembler.dofs());
  const Eigen::Index first = first_film_ - 2 * std::ssize(forces);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (forces[i].support != &support) continue;
    for (std::size_t k = 0; k < support.acts_on.size(); ++k) {
      const InterfaceCoordinate& port = support.acts_on[k];
      if (!(assembler.point(port.at) == forces[i].from)) continue;
      const double part = limit.to_forces(static_cast<Eigen::Index>(k)) / limit.force;
      closing.block<2, 1>(first + 2 * static_cast<Eigen::Index>(i), 0) +=
          part * Vec2(port.x, port.y);
    }
  }
  return {closing, Share::Zero(rigid.rows(), 2)};
}

void SupportLoads::add_loads(const Assembler& assembler, const ContactSystem& system,
                             const Sparse& rigid) {
  const double Omega = system.Omega();
  // as the system has its loads: constant, synchronous, then those that are not zero
  loads_.assign(system.excitations().begin(), system.excitations().end());
  for (ReducedExcitation& load : loads_) load.cosine = load.sine = Vec::Zero(rigid.rows());
  std::size_t other = 2;
  for (const Excitation& e : excitations_at(assembler, Omega)) {
    if (e.amplitude.isZero(0.0)) continue;
    const bool is_constant = e.frequency_at(Omega) == 0.0;
    ReducedExcitation& load = loads_[is_constant ? 0 : e.is_synchronous() ? 1 : other++];
    load.cosine += rigid * Vec(e.amplitude.real());
    if (!is_constant) load.sine -= rigid * Vec(e.amplitude.imag());
  }
}

void SupportLoads::at(const ContactSystem& system, const Instant& instant, const double* y,
                      const Vec& acceleration, const ContactStates& states,
                      std::span<const ContactForces> forces, Eigen::Ref<Vec> out) const {
  const StateLayout layout = system.layout();
  out.setZero();
  auto linear = out.head(first_film_);
  linear += K_ * layout.eta(y) + C_ * layout.rate(y);
  if (needs_acceleration_) linear += M_ * acceleration;
  for (const ReducedExcitation& load : loads_) {
    const double angle = load.angle(instant);
    linear += load.cosine * std::cos(angle) + load.sine * std::sin(angle);
  }
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (!states[i].in_touch()) continue;
    const ReducedContact& contact = system.contacts()[i];
    const auto owner = static_cast<std::size_t>(contact.owner);
    const ContactForces& f = forces[i];
    const Eigen::Index row = rows_of_bearings_[owner];
    if (row >= 0) out.segment<2>(row) += f.normal * f.n;
    if (of_contacts_.empty()) continue;
    const ContactShares& share = of_contacts_[owner];
    linear -= share.closing * (f.normal * f.n);
    linear -= (contact.rubs_apart() ? share.rubbing : share.closing) * (f.friction * f.t());
  }
  for (std::size_t i = 0; i < system.films().size(); ++i) {
    const Vec2 on_journal = film_force(system.films()[i], y, layout);
    out.segment<2>(first_film_ + static_cast<Eigen::Index>(2 * i)) = -on_journal;
    if (has_rigid_) linear += of_films_[i] * on_journal;
  }
}

}  // namespace whirl::inline dyn

// How the equations of a contact system come from a reduced rotor.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "libbase/numerics/dense.hpp"
#include "libcontact/blade.hpp"
#include "libdyn/system/contact_system.hpp"
#include "libdyn/system/load_periods.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libfe/assembly/support_equations.hpp"

namespace whirl::inline dyn {

namespace {

/// Relative difference of rows, centers and rim speeds up to which contacts slip alike: more than
/// rounding in a reduction, less than anybody can mean.
constexpr double alike = 1e-9;

/// Whether the slip of two contacts is the same in every motion.
bool slip_alike(const ReducedContact& a, const ReducedContact& b) {
  if (!a.friction.is_exact() || !b.friction.is_exact()) return false;
  if (!(a.geometry == b.geometry)) return false;
  const bool is_plane = direction_of(a.geometry).has_value();  // which is the same anywhere
  return (a.U - b.U).cwiseAbs().maxCoeff() <= alike * a.U.cwiseAbs().maxCoeff() &&
         (is_plane || (a.offset - b.offset).norm() <= alike * std::min(a.clearance, b.clearance)) &&
         std::abs(a.rim_speed - b.rim_speed) <= alike * std::abs(a.rim_speed);
}

PlaneRows rows_of(Closing closing, const DofMap& dofs, const Point& p) {
  PlaneRows r(2, dofs.size());
  switch (closing) {
    case Closing::lateral:
      r.row(0) = dofs.row(p, X).transpose();
      r.row(1) = dofs.row(p, Y).transpose();
      break;
    case Closing::tilts:
      r.row(0) = -dofs.row(p, THETA_Y).transpose();
      r.row(1) = dofs.row(p, THETA_X).transpose();
      break;
  }
  return r;
}
PlaneRows relative_rows(Closing closing, const DofMap& dofs, const Point& at,
                        const Point& against) {
  return rows_of(closing, dofs, at) - rows_of(closing, dofs, against);
}

/// Speed of the surface of `at` past that of `against` in the slip; what turns has its own in the
/// gap's motion.
double rim_speed_of(const AnyGeometry& geometry, const PartSpeeds& speeds,
                    const Friction& friction) {
  const double past = (turns(geometry) ? 0.0 : speeds.at) - speeds.against;
  return past * rim_radius_of(geometry).value_or(friction.radius);
}

/// A law with what follows from the operation: how much friction bends a blade.
AnyContactLaw<> law_at(double Omega, AnyContactLaw<> any, const Friction& friction) {
  if (auto* law = std::get_if<BladeTip<>>(&any)) {
    law->bend = blade_shortening(*law, friction.mu, Omega) * law->k * law->k;
  }
  return any;
}

/// The signal is told in lengths, clearance : limit; so is its rate, which makes no friction.
/// @param by  as ContactSystem::Reduction
template <class By>
void set_rows_of_limit(ReducedContact& limit, const By& by, const Contact& contact) {
  const Structure& structure = by.assembler.structure();
  const auto& [support, number] = *contact.limits;
  const SignalLimit& of = structure.supports[support].limits[number];
  const LimitedSignal signal =
      limited_signal(structure, by.assembler.mesh(), by.assembler.dofs(), support, number);
  const double length = contact.clearance / of.limit;  // per unit of the signal
  limit.U = limit.V = PlaneRows::Zero(2, by.back.cols());
  limit.U.row(0) = length * (signal.displacement.transpose() * by.back);
  limit.V.row(0) = length * (signal.rate.transpose() * by.back);
  limit.B = limit.B_t = PlaneColumns::Zero(by.back.cols(), 2);
  limit.B.col(0) = -by.load(signal.force) / of.force;
}

}  // namespace

PlaneRows closing_rows(const Contact& contact, const Assembler& assembler, const DofMap& dofs) {
  const AnyGeometry geometry = geometry_of(contact);
  return arm_of(geometry) * relative_rows(closing_of(geometry), dofs, assembler.point(contact.at),
                                          assembler.point(contact.against));
}

PartSpeeds part_speeds(const Contact& contact, const Assembler& assembler, double Omega) {
  // what touches is a rotor whether it says that it spins or not
  return {assembler.shaft_speed(assembler.point(contact.at), Omega),
          assembler.spin_speed(assembler.point(contact.against), Omega), Clock(Omega).rate()};
}

/// What the equations of a reduced rotor are made with.
struct ContactSystem::Reduction {
  const Assembler& assembler;
  const ReducedSystem& reduced;
  DenseLu<Mat> mass;
  Mat back;  ///< full displacement of each coordinate

  Reduction(const Assembler& of, const ReducedSystem& to)
      : assembler(of), reduced(to), mass(to.M), back(to.dofs.T * to.Phi) {}
  /// Accelerations that a full vector of forces makes.
  Vec load(const Vec& full) const { return mass.solve(back.transpose() * full); }
};

ContactSystem::ContactSystem(const Assembler& assembler, const ReducedSystem& reduced,
                             const std::vector<Contact>& contacts,
                             const std::vector<OilFilm>& films)
    : clock_(reduced.Omega) {
  const Reduction by(assembler, reduced);
  K_ = by.mass.solve(reduced.stiffness());
  D_ = by.mass.solve(reduced.D());
  add_loads(by);
  for (const Contact& c : contacts) add_contact(by, c, static_cast<int>(&c - contacts.data()));
  find_slip_groups();
  for (const OilFilm& film : films) add_film(by, film);
  find_scales(by);
}

void ContactSystem::add_loads(const Reduction& by) {
  const Vec none = Vec::Zero(coordinates());
  excitations_ = {{.cosine = none, .sine = none},
                  {.order = 1.0, .frequency = Omega(), .ratio = 1.0, .cosine = none, .sine = none}};
  for (const Excitation& f : excitations_at(by.assembler, Omega())) {
    if (f.amplitude.isZero(0.0)) continue;
    const Vec cosine = by.load(f.amplitude.real());  // Re(u e^(i alpha)) = Re u cos - Im u sin
    if (f.frequency_at(Omega()) == 0.0) {  // what turns with a rotor that stands is constant
      excitations_[0].cosine += cosine;
      continue;
    }
    const Vec sine = by.load(-f.amplitude.imag());
    if (f.is_synchronous()) {
      excitations_[1].cosine = cosine;
      excitations_[1].sine = sine;
      continue;
    }
    const double ratio = frequency_ratio(by.assembler.structure(), f, phase_rate());
    excitations_.push_back({f.order, f.frequency_at(Omega()), ratio, cosine, sine});
  }
}

void ContactSystem::add_contact(const Reduction& by, const Contact& c, int owner) {
  const AnyGeometry geometry = geometry_of(c);
  assert(may_stick(geometry) || !c.friction.is_exact());
  const PartSpeeds speeds = part_speeds(c, by.assembler, Omega());
  ReducedContact r{.name = c.name,
                   .offset = c.offset,
                   .clearance = c.clearance,
                   .rim_speed = rim_speed_of(geometry, speeds, c.friction),
                   .friction = c.friction,
                   .law = law_at(speeds.at, c.law, c.friction),
                   .geometry = geometry,
                   .owner = owner};
  if (c.limits) {
    set_rows_of_limit(r, by, c);
  } else {
    r.U = closing_rows(c, by.assembler, by.reduced.dofs) * by.reduced.Phi;
    r.B = by.mass.solve(r.U.transpose());
  }
  if (whirl::rubs_apart(geometry) && !c.limits) {
    r.V = relative_rows(Closing::lateral, by.reduced.dofs, by.assembler.point(c.at),
                        by.assembler.point(c.against)) *
          by.reduced.Phi;
    r.B_t = by.mass.solve(r.V.transpose());
  }
  for (int i = 0; i < places_of(geometry); ++i) {
    r.geometry = place_of(geometry, i, speeds);
    r.place = i;
    contacts_.push_back(r);
  }
}

void ContactSystem::add_film(const Reduction& by, const OilFilm& film) {
  ReducedFilm r{
      at_speed(film, Omega(), drag_speed(film, by.assembler, Omega())), film.name, {}, {}};
  r.U = relative_rows(Closing::lateral, by.reduced.dofs, by.assembler.point(film.at),
                      by.assembler.point(film.against)) *
        by.reduced.Phi;
  r.B = by.mass.solve(r.U.transpose());
  films_.push_back(std::move(r));
}

double ContactSystem::size_of_motion(const Reduction& by) const {
  const Mat& back = by.back;
  const Vec sag = least_squares(K_, constant_load());
  const double turn = phase_rate();
  double size = std::max({(back * sag).cwiseAbs().maxCoeff(),
                          (back * synchronous_load().cosine).cwiseAbs().maxCoeff() / (turn * turn),
                          (back * synchronous_load().sine).cwiseAbs().maxCoeff() / (turn * turn)});
  for (const ReducedExcitation& o : other_loads()) {
    for (const Vec* f : {&o.cosine, &o.sine}) {  // as if slow, or as if nothing held it
      const double slow = (back * least_squares(K_, *f)).cwiseAbs().maxCoeff(),
                   fast = (back * *f).cwiseAbs().maxCoeff() / (o.frequency * o.frequency);
      size = std::max(size, slow > 0.0 ? std::min(slow, fast) : fast);
    }
  }
  return size > 0.0 && std::isfinite(size) ? size : 1e-3;
}

void ContactSystem::find_scales(const Reduction& by) {
  constexpr double none = std::numeric_limits<double>::infinity();
  length_scale_ = none;
  for (const ReducedContact& c : contacts_) {
    if (!c.is_limit()) length_scale_ = std::min(length_scale_, c.clearance);
  }
  for (const ReducedFilm& film : films_) length_scale_ = std::min(length_scale_, film.clearance);
  if (length_scale_ == none) length_scale_ = size_of_motion(by);
  scale_.resize(size());
  for (int i = 0; i < coordinates(); ++i) {
    double largest = 0.0;
    for (const Point& p : by.reduced.dofs.points()) {
      for (const int component : {X, Y}) {
        const int row = by.reduced.dofs.full_index(p, component);
        largest = std::max(largest, std::abs(by.back(row, i)));
      }
    }
    for (const ReducedContact& c : contacts_) {
      const double part = c.is_limit() ? length_scale_ / c.clearance : 1.0;
      if (closing_of(c.geometry) == Closing::lateral && !c.is_limit()) continue;
      largest = std::max(largest, part * c.U.col(i).cwiseAbs().maxCoeff());
    }
    scale_(i) = largest > 0.0 ? length_scale_ / largest : length_scale_;
    scale_(layout().place_of_rate(i)) = scale_(i) * phase_rate();
  }
}

void ContactSystem::find_slip_groups() {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].slip_group = static_cast<int>(i);
    for (std::size_t j = 0; j < i; ++j) {
      if (!whirl::slip_alike(contacts_[i], contacts_[j])) continue;
      contacts_[i].slip_group = contacts_[j].slip_group;
      break;
    }
  }
}

}  // namespace whirl::inline dyn

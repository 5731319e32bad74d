#include "libdyn/motions/equilibrium.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libdyn/system/port_balance.hpp"

namespace whirl::inline dyn {

namespace {

/// Reciprocal condition number below which nothing holds a rotor, its journals or its contacts.
constexpr double lightest = 1e-16;

/// The rotor held at its films and at some contacts, in coordinates of a motion: nothing, if that
/// leaves it free.
///
///   [K  s B; s W  0] (eta, -F / s) = (f, s w),   f: the constant load
///
/// W are rows of independent ports, B the accelerations that forces there make.
std::optional<HeldRotor> held_rotor(const ContactSystem& system,
                                    const std::vector<ReducedContact>& contacts) {
  const Eigen::Index n = system.coordinates();
  const auto rows = 2 * (std::ssize(system.films()) + std::ssize(contacts));
  Mat U(rows, n), B(n, rows);
  Eigen::Index row = 0;
  const auto add = [&](const auto& port) {
    U.middleRows<2>(row) = port.U, B.middleCols<2>(row) = port.B;
    row += 2;
  };
  for (const ReducedFilm& film : system.films()) add(film);
  for (const ReducedContact& contact : contacts) add(contact);
  HeldRotor held;
  held.ports = independent_rows(U);
  const auto ports = std::ssize(held.ports.chosen);
  const double largest = system.K().cwiseAbs().maxCoeff();
  const double s = largest > 0.0 ? largest : 1.0;
  Mat A = Mat::Zero(n + ports, n + ports), wanted = Mat::Zero(n + ports, 1 + ports);
  Vec size = Vec::Ones(ports);  // of a column of B
  A.topLeftCorner(n, n) = system.K();
  for (Eigen::Index k = 0; k < ports; ++k) {
    const Eigen::Index own = held.ports.chosen[static_cast<std::size_t>(k)];
    size(k) = B.col(own).cwiseAbs().maxCoeff();
    A.col(n + k).head(n) = s / size(k) * B.col(own);
    A.row(n + k).head(n) = s * U.row(own);
    wanted(n + k, 1 + k) = s;
  }
  wanted.col(0).head(n) = system.constant_load();
  const DenseLu<Mat> lu(A);
  if (!(lu.rcond() > lightest)) return std::nullopt;
  Mat found = lu.solve(wanted);
  found += lu.solve(wanted - A * found);  // rotors of all their coordinates are stiff
  held.rest = found.col(0).head(n);
  held.shapes = found.topRightCorner(n, ports);
  const Vec force = -s * size.cwiseInverse();
  held.R = force.cwiseProduct(found.col(0).tail(ports));
  held.K = force.asDiagonal() * found.bottomRightCorner(ports, ports);
  return held;
}

/// Elements of rolling bearings, which carry a rotor as films do.
std::vector<ReducedContact> elements_of(const ContactSystem& system) {
  std::vector<ReducedContact> elements;
  for (const ReducedContact& c : system.contacts()) {
    if (rolling_elements(c.geometry)) elements.push_back(c);
  }
  return elements;
}

/// Whether any contact with a stator is reached at a place.
bool any_pushes(const ContactSystem& system, const Vec& eta) {
  Vec y = Vec::Zero(system.size());
  system.layout().eta(y) = eta;
  return std::any_of(system.contacts().begin(), system.contacts().end(), [&](const auto& c) {
    return !rolling_elements(c.geometry) &&
           kinematics(c, 0.0, y.data(), system.layout()).depth > 0.0;
  });
}

/// Displacements of the independent ports of films and all contacts at a place.
Vec ports_at(const ContactSystem& system, const HeldRotor& held, const Vec& eta) {
  std::vector<Vec2> all;
  for (const ReducedFilm& film : system.films()) all.push_back(film.U * eta);
  for (const ReducedContact& contact : system.contacts()) all.push_back(contact.U * eta);
  Vec w(std::ssize(held.ports.chosen));
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    const Eigen::Index own = held.ports.chosen[static_cast<std::size_t>(k)];
    w(k) = all[static_cast<std::size_t>(own / 2)](own % 2);
  }
  return w;
}

}  // namespace

Vec equilibrium(const ContactSystem& system) {
  const std::vector<ReducedContact> elements = elements_of(system);
  const bool has_bearings = !system.films().empty() || !elements.empty();
  const std::vector<FilmAtSpeed> films(system.films().begin(), system.films().end());
  const auto held = held_rotor(system, elements);
  if (!held) {
    throw NumericalError(has_bearings
                             ? "the rotor has no equilibrium: it is not held, even where oil films "
                               "and rolling bearings hold its journals"
                             : "the rotor has no equilibrium: it is not held");
  }
  std::optional<Vec> eta;  // as if there were no contacts
  if (const auto place = PortBalance(*held, films, elements).find()) {
    eta = held->rest + held->shapes * place->w;
    if (!any_pushes(system, *eta)) return *eta;
  }
  const auto with_contacts = system.contacts().size() == elements.size()
                                 ? std::nullopt
                                 : held_rotor(system, system.contacts());
  if (with_contacts) {
    const PortBalance balance(*with_contacts, films, system.contacts());
    const auto place = eta ? balance.find(ports_at(system, *with_contacts, *eta)) : balance.find();
    if (place) return with_contacts->rest + with_contacts->shapes * place->w;
  }
  if (eta) throw NumericalError("the equilibrium of the rotor in its stators was not found");
  throw NumericalError(not_found_on_films(system.Omega()) +
                       "; start.from = \"rest\" starts in the middles of the bearings");
}

}  // namespace whirl::inline dyn

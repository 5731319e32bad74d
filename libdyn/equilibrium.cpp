#include "libdyn/equilibrium.hpp"

#include <algorithm>

#include "libdyn/methods/kinsol.hpp"
#include "libfe/base/error.hpp"
#include "libfe/eigen/dense.hpp"

namespace whirl {

namespace {

/// What is left over of the balance, as accelerations; returns whether a contact pushes.
bool imbalance(const ContactSystem& system, const Vec& eta, Vec& left) {
  const int n = system.coordinates();
  Vec y = Vec::Zero(2 * n);
  y.head(n) = eta;
  left = system.constant_load() - system.K() * eta;
  bool pushes = false;
  for (const ReducedContact& c : system.contacts()) {
    const ContactForces f = kinematics(c, 0.0, y.data(), n);
    if (f.depth <= 0.0) continue;
    pushes = true;
    left -= c.B * (f.normal * f.n);
  }
  for (const ReducedFilm& film : system.films()) left += film.B * film_force(film, y.data(), n);
  return pushes;
}

constexpr double lightest = 1e-16;  ///< reciprocal condition number of what holds a rotor

/// Where the journals come to rest in their films.
Vec equilibrium_on_films(const ContactSystem& system) {
  const int n = system.coordinates();
  const Vec scale = system.state_scale().head(n);
  const auto f = [&](const Vec& eta, Vec& left) { imbalance(system, eta, left); };
  const auto is_inside = [&](const Vec& eta) {
    Vec y = Vec::Zero(2 * n);
    y.head(n) = eta;
    return system.left_bearing(y.data()) == nullptr;
  };
  bool is_held = false;
  // springs on which one journal alone would move so far under all the load, over the clearance
  for (double sag = 0.1; sag < 1e3; sag *= 2.0) {
    Mat K = system.K();
    Vec pull = system.constant_load();
    for (const ReducedFilm& film : system.films()) {
      const double load = least_squares(film.B, system.constant_load()).norm();
      const double stiffness = load / (sag * film.clearance);
      K += stiffness * film.B * film.U;
      pull += stiffness * film.B * film.offset;
    }
    const DenseLu<Mat> held(K);
    if (!(held.rcond() > lightest)) continue;
    is_held = true;
    const Vec guess = held.solve(pull);
    double farthest = 0.0;
    Vec y = Vec::Zero(2 * n);
    y.head(n) = guess;
    for (const ReducedFilm& film : system.films()) {
      farthest = std::max(farthest, eccentricity(film, y.data(), n));
    }
    if (farthest >= 0.99) break;
    const auto found = find_root(f, guess, scale, system.constant_load().cwiseAbs().maxCoeff());
    if (found && is_inside(*found)) return *found;
  }
  throw NumericalError(
      is_held ? "the equilibrium of the rotor on its oil films was not found: without speed a film "
                "carries nothing, and at speed there may be none; start.from = \"rest\" starts in "
                "the bearings' centers"
              : "the rotor has no equilibrium: it is not held, not even by its oil films");
}

}  // namespace

Vec equilibrium(const ContactSystem& system) {
  if (!system.films().empty()) return equilibrium_on_films(system);
  const DenseLu<Mat> K(system.K());
  if (!(K.rcond() > lightest)) throw NumericalError("the rotor has no equilibrium: it is not held");
  const Vec sag = K.solve(system.constant_load());
  Vec left;
  if (!imbalance(system, sag, left)) return sag;
  const auto found =
      find_root([&](const Vec& eta, Vec& f) { imbalance(system, eta, f); }, sag,
                system.state_scale().head(system.coordinates()), left.cwiseAbs().maxCoeff());
  if (!found) throw NumericalError("the equilibrium of the rotor in its stators was not found");
  return *found;
}

}  // namespace whirl

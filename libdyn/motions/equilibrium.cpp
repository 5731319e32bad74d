#include "libdyn/motions/equilibrium.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "libbase/dense.hpp"
#include "libbase/error.hpp"
#include "libdyn/methods/kinsol.hpp"

namespace whirl::inline dyn {

namespace {

/// What is left over of the balance, as accelerations, with oil that is so many times as thick;
/// returns whether a contact pushes.
bool imbalance(const ContactSystem& system, const Vec& eta, Vec& left, double thickness = 1.0) {
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
  for (const ReducedFilm& film : system.films())
    left += film.B * (thickness * film_force(film, y.data(), n));
  return pushes;
}

constexpr double lightest = 1e-16;  ///< reciprocal condition number of what holds a rotor

/// Where the rotor would lie if springs stood in for its films, from stiff springs to soft ones, as
/// long as the journals are 0.05 to 0.99 of their clearance off; nothing if it were not held.
std::vector<Vec> guesses(const ContactSystem& system) {
  const int n = system.coordinates();
  std::vector<Vec> all;
  for (double sag = 1e-6; sag < 1e6; sag *= 1.7) {  // of one journal under the load on it alone
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
    Vec y = Vec::Zero(2 * n);
    y.head(n) = held.solve(pull);
    double farthest = 0.0;
    for (const ReducedFilm& film : system.films()) {
      farthest = std::max(farthest, eccentricity(film, y.data(), n));
    }
    if (farthest >= 0.99) break;
    if (farthest >= 0.05) all.push_back(y.head(n));
  }
  return all;
}

/// Where the journals come to rest in their films. Where Newton's method does not get there at once,
/// it starts with oil so thick that it does, and thins it step by step.
Vec equilibrium_on_films(const ContactSystem& system) {
  constexpr double thinning = 0.8;
  const int n = system.coordinates();
  const Vec scale = system.state_scale().head(n);
  const double size = system.constant_load().cwiseAbs().maxCoeff();
  const auto solve = [&](const Vec& guess, double thickness) -> std::optional<Vec> {
    const auto f = [&](const Vec& eta, Vec& left) { imbalance(system, eta, left, thickness); };
    const auto found = find_root(f, guess, scale, size);
    if (!found) return std::nullopt;
    Vec y = Vec::Zero(2 * n);
    y.head(n) = *found;
    return system.left_bearing(y.data()) ? std::nullopt : found;
  };
  const std::vector<Vec> starts = guesses(system);
  for (const double thickest : {1.0, 10.0, 100.0, 1000.0}) {
    for (const Vec& guess : starts) {
      std::optional<Vec> found = solve(guess, thickest);
      for (double thickness = thickest; found && thickness > 1.0;) {
        thickness = std::max(1.0, thinning * thickness);
        found = solve(*found, thickness);
      }
      if (found) return *found;
    }
  }
  throw NumericalError(
      starts.empty() ? "the rotor has no equilibrium: it is not held, not even by its oil films"
                     : "the equilibrium of the rotor on its oil films was not found: without speed "
                       "a film carries nothing; start.from = \"rest\" starts in the centers");
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

}  // namespace whirl::inline dyn

#pragma once
/// The equilibrium of a linear rotor in its oil films and on its stators, and its one solver.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// Linearly independent rows of a matrix, and all rows as combinations of these.
struct IndependentRows {
  std::vector<Eigen::Index> chosen;  ///< ascending
  Mat of;                            ///< all rows = of * chosen rows
};
IndependentRows independent_rows(const Mat& rows);

/// A linear rotor as films and contacts feel it. Its ports are the displacements [m] on which these
/// act, two for each film, then two for each contact; w are independent ports, at which the rotor
/// is held.
struct HeldRotor {
  IndependentRows ports;
  Vec rest;    ///< coordinates at w = 0
  Mat shapes;  ///< derivative of the coordinates by w
  Vec R;       ///< force that holds the rotor at w = 0 [N]
  Mat K;       ///< derivative of that force by w [N/m]
};

/// The balance of a rotor that films and the normal forces of contacts carry, without friction:
///
///   R + K w = sum_i P_i^T F_i(P_i w)
///
/// All other forces on the rotor are linear and stand in R and K, so that stiff shafts cost no
/// digits. Newton's method with exact slopes starts where each film and each rolling bearing alone
/// carries its share of the load; where that leads nowhere, the load is put on little by little.
class PortBalance {
 public:
  /// @param rotor     must live as long as the balance
  /// @param contacts  turning ones at phase 0
  PortBalance(const HeldRotor& rotor, std::vector<FilmAtSpeed> films,
              std::vector<ReducedContact> contacts = {});

  /// A place of equilibrium.
  struct Place {
    Vec w;
    std::vector<Vec2> journals;  ///< displacements from the middles of their bearings [m]
  };

  /// @return  nothing: not found
  std::optional<Place> find() const;
  /// Finds the equilibrium from a place nearby, or by loading slowly.
  std::optional<Place> find(const Vec& w) const;

 private:
  struct At;
  Vec2 port(std::size_t i, const Vec& x) const;
  Place place(const Vec& x) const;
  std::optional<Vec> shared() const;
  std::optional<Vec> solve(const Vec& from, double share) const;
  std::optional<Vec> loaded_slowly() const;
  At look(const Vec& x, double share) const;
  void add(At& at, std::size_t port, const Vec2& force, const Mat2& by_u) const;

  const HeldRotor& rotor_;
  Mat ports_;                       ///< all ports by w
  std::vector<FilmAtSpeed> films_;  ///< without offset, which would cost digits near the wall
  std::vector<ReducedContact> contacts_;
  Vec scale_, middle_, load_;
  Vec away_;  ///< ports at w = middle from the middles of their clearances
  double size_ = 1.0;
};

/// Why a rotor is nowhere at rest on its films or rolling bearings at a speed [rad/s], in words.
std::string not_found_on_films(double Omega);

}  // namespace whirl::inline dyn

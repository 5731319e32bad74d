#pragma once
/// Exact motion of the linear part of a contact system under loads and given contact forces.

#include <span>
#include <vector>

#include "libbase/numerics/legendre.hpp"
#include "libdyn/system/abilities.hpp"

namespace whirl::inline dyn {

/// y' = A y + F (1, cos phase, sin phase) - B f(t), with f a polynomial on each step. Loads of
/// other frequencies than that of the phase are not part of this flow.
///
///   y(t + h) = (I + X) y(t) + L (1, cos phase(t), sin phase(t)) + G a
///
/// a: Legendre coefficients of f on the step, ordered by contact, component (x, y), degree.
/// Matrices belong to step sizes longest / 2^level. Where |A| h <= 1/4 the matrices are Taylor
/// series, else they follow from those of half the step:
///
///   X <- 2 X + X X,   L <- L + X L + L R,   G <- (I + X) G Q_1 + G Q_2
///
/// R turns the loads by h, Q_1 and Q_2 restrict polynomials to the halves of a step. No eigenvector
/// is involved: defective, overdamped and rigid-body modes are as exact as others. Keeping X in
/// place of the exponential keeps the digits of slow modes beside fast ones.
///
/// @source [MolerVanLoan2003], method 3 (scaling and squaring)
class LinearFlow {
 public:
  static constexpr std::array cannot{Need::other_orders, Need::own_frequencies};
  static constexpr Abilities abilities{"exact linear flow", cannot};

  /// Number of step sizes; levels count from 0.
  static constexpr int levels = 64;

  /// @param longest  size at level 0 [s]
  /// @param terms    of the polynomials f
  /// @throws NumericalError  where the fastest motion of the system is too fast beside `longest`:
  ///                         the Taylor series asks for a step shorter than all levels
  LinearFlow(const ContactSystem& system, double longest, int terms);

  /// Matrices of one step size.
  struct Table {
    double h = 0.0;  ///< [s]
    Mat X;           ///< 2 n x 2 n
    Mat L;           ///< 2 n x 3
    Mat G;           ///< 2 n x (2 contacts terms)
    Eigen::Matrix3d R;
  };
  const Table& table(int level);

  double size(int level) const;

  /// Moves y on by a fraction (0 to 1) of a step, with forces of the given contacts.
  ///
  /// @param load  (1, cos phase, sin phase) at the start of the step
  /// @param a     coefficients of the forces on the whole step
  void advance(int level, double fraction, const Eigen::Vector3d& load, const Vec& a,
               std::span<const int> touching, Vec& y);

  /// Rows r of the same motion, r y = y_rows y(0) + load_rows load + force_rows a.
  struct Rows {
    Mat y, load, force;
  };
  enum class Forces { none, all };  ///< none: force_rows stays empty
  Rows rows(int level, double fraction, const Mat& r, Forces forces = Forces::all);

  /// Coefficients of the first or second half of a step from those of the whole; in place.
  void restrict_to_half(bool second, std::span<const int> touching, Vec& a) const;

 private:
  void build_by_series(Table& t) const;
  void build_by_doubling(Table& t, const Table& half) const;
  /// rows() for a time d by Taylor series; forces of so many columns of B are powers of t / d.
  Rows rows_by_series(double d, const Mat& r, int columns) const;
  Eigen::Matrix3d rotation(double t) const;
  bool is_small(int level) const { return norm_ * size(level) <= 0.25; }

  StateLayout layout_;
  int terms_, contacts_;
  double longest_, rate_, norm_;
  Mat A_, F_, B_;  ///< B: 2 n x 2 contacts
  Eigen::Matrix3d W_;
  GaussRule rule_;
  Mat first_half_, second_half_, to_powers_;
  std::vector<Table> tables_;
  Vec work_, term_, a_, whole_;  ///< workspace of advance()
};

/// (1, cos phase, sin phase).
Eigen::Vector3d load_at(double phase);

/// Norm of A in units that make this norm small: a bound of the eigenvalues of A [rad/s].
///
/// @source [ParlettReinsch1969], balancing by powers of two
double balanced_norm(Mat A);

/// A of y' = A y + ..., for y = (eta, eta').
Mat first_order_matrix(const ContactSystem& system);

/// Largest acceleration along a contact by a unit of force in this contact: |U B| [1/kg].
double contact_gain(const ReducedContact& contact);

/// Frequency of the rotor in its contacts, w_c = (sum over contacts of k |U B|)^(1/2) [rad/s], k
/// the stiffness of the law at a hundredth of the clearance.
double contact_frequency(const ContactSystem& system);

/// Largest |lambda| of the linear part [rad/s].
double fastest_mode(const ContactSystem& system);

}  // namespace whirl::inline dyn

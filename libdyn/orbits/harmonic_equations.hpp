#pragma once
/// The equations of harmonic balance, with the forces' places as unknowns.

#include <functional>
#include <optional>
#include <vector>

#include "libbase/numerics/dense.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/port_forces.hpp"

namespace whirl::inline dyn {

/// Equations of motion, forces of few displacements apart.
///
///   eta'' + D eta' + K eta = sum_l f_l(order_l phase) + sum_j B_j g_j(phase, U_j eta, U_j eta')
struct HarmonicProblem {
  Mat K, D;
  /// cosine cos(order phase) + sine sin(order phase); order 0: constant.
  struct Load {
    double order = 0.0;
    Vec cosine, sine;
  };
  std::vector<Load> loads{};
  double rate = 1.0;          ///< of the phase [rad/s]
  double length_scale = 1.0;  ///< of displacements at the forces [m]
  Vec scale;                  ///< of the state (eta, eta'), size 2 n
  std::vector<PortForces> forces;
  /// What contacts do on a motion of eta; empty: there are none.
  std::function<std::vector<ContactMeasure>(const Periodic& motion)> measures;

  Eigen::Index coordinates() const { return K.rows(); }
  /// Number of the highest harmonic of a motion that a load has.
  /// @throws OptionError  where one of them does not repeat with such a period
  int highest_load(int period) const;
};

/// Forces and slopes at displacements of the ports.
struct HarmonicEvaluation {
  bool has_force = false;  ///< else nothing of this is known
  Mat g;                   ///< Fourier coefficients of the forces, springs included
  Mat residual;            ///< [m]
  Mat by_u, by_rate;       ///< of g by the coefficients of u and u'; columns of matrices follow one
                           ///< another; empty: not wanted
};

/// The equations for so many harmonics, everything linear eliminated.
///
///   r = u - u_0 - H g(u),   H_k = U Z_k^-1 B,   Z_k = K + i w_k D - w_k^2,   w_k = k rate / period
///
/// The unknowns are the Fourier coefficients of the displacements u where forces act, ports x
/// (2 H + 1), whatever the number of coordinates. Where the linear part alone does not hold the
/// rotor, or resonates without damping, springs are added to it and taken off the forces, which
/// changes nothing.
///
/// @source [KrackGross2019], ch. 2 and 3.3
class HarmonicEquations {
 public:
  /// @param problem  must live as long as the equations
  /// @throws NumericalError  at an undamped resonance with a harmonic, or where a load is none of
  ///                         them
  HarmonicEquations(const HarmonicProblem& problem, int period, int harmonics);

  Eigen::Index ports() const { return U_.rows(); }
  int harmonics() const { return harmonics_; }
  int period() const { return period_; }
  double frequency() const { return problem_.rate / period_; }
  const HarmonicProblem& problem() const { return problem_; }
  const Mat& U() const { return U_; }
  const Mat& B() const { return B_; }
  /// K with the springs.
  const Mat& stiffness() const { return K_; }

  /// Forces and slopes at displacements u (ports x (2 H + 1)).
  HarmonicEvaluation evaluate(const Mat& u, bool slopes) const;
  /// dr / du, of size ports (2 H + 1).
  Mat jacobian(const HarmonicEvaluation& at) const;
  /// dr / dp at displacements u that are held, p a parameter of the problem.
  ///
  ///   dr = -dU x - U dx,   Z dx = df + dB g + B dg - dZ x,   x = Z^-1 (f + B g)
  ///
  /// @param g   forces on them, as evaluated
  /// @param by  the problem with its derivative by p in place of each number, of its forces those
  ///            at displacements that are held
  /// @return    nothing where a force has none
  std::optional<Mat> slope(const Mat& u, const Mat& g, const HarmonicProblem& by) const;

  /// Motion of all coordinates under forces: eta_k = Z_k^-1 (f_k + B g_k).
  Mat motion(const Mat& g) const;
  /// Z_k^-1 (b_k + B q_k) of any coefficients b (n x (2 H + 1)) and q (ports x (2 H + 1)).
  Mat respond(const Mat& b, const Mat& q) const;
  /// H q.
  Mat receptance(const Mat& q) const;
  /// Loads f, n x (2 H + 1).
  const Mat& loads() const { return loads_; }

 private:
  /// Dynamic stiffnesses of all harmonics; the first that is singular, or -1.
  int factorize();

  const HarmonicProblem& problem_;
  int period_, harmonics_;
  Mat U_, B_;  ///< of all forces
  Mat K_;
  Vec springs_;  ///< of the ports
  std::vector<DenseLu<CMat>> Z_;
  std::vector<CMat> H_;
  Mat loads_, free_;  ///< u_0
};

}  // namespace whirl::inline dyn

#pragma once
/// Dynamic stiffness of supports from what is known of them: coefficients, poles and residues.

#include <array>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/field.hpp"
#include "libfe/parts/support.hpp"

namespace whirl::inline fe {

/// What a transfer function of a support is, with force F, displacement U.
enum class TransferForm {
  dynamic_stiffness,  ///< F / U [N/m]
  impedance,          ///< F / (s U) [N.s/m]
  receptance,         ///< U / F [m/N]
  mobility            ///< s U / F [m/(N.s)]
};
constexpr auto choices(TransferForm) {
  return std::array{Choice<TransferForm>{"dynamic stiffness", TransferForm::dynamic_stiffness},
                    Choice<TransferForm>{"impedance", TransferForm::impedance},
                    Choice<TransferForm>{"receptance", TransferForm::receptance},
                    Choice<TransferForm>{"mobility", TransferForm::mobility}};
}

/// A rational function of s, coefficients of the highest power first.
struct TransferFunction {
  std::vector<double> numerator, denominator;
};

/// Of polynomials, highest power first.
std::vector<double> polynomial_product(const std::vector<double>& p, const std::vector<double>& q);
std::vector<double> polynomial_sum(std::vector<double> p, std::vector<double> q);

/// The dynamic stiffness F / U that a function of some form makes.
TransferFunction dynamic_stiffness_of(const TransferFunction& function, TransferForm form);

/// The law of one displacement and one force with a dynamic stiffness. What the numerator has
/// beyond the denominator, up to two powers, is a spring, a damper and a mass.
///
/// @throws NumericalError  if the numerator has more, the denominator is zero or a coefficient is
///                         not finite
StateSpace state_space(const TransferFunction& dynamic_stiffness);

/// A part residue / (s - pole) of a function; one with an imaginary part stands for its conjugate,
/// too.
struct PoleResidue {
  Complex pole;  ///< [rad/s]
  CMat residue;  ///< m x p [N/(m.s)]
};

/// The sum of the parts of one displacement and one force.
TransferFunction function_of(const std::vector<PoleResidue>& parts);

/// The law F(s) = sum of residue / (s - pole) + D, residues of rank r take r states (2 r, if the
/// pole is complex).
StateSpace state_space(const std::vector<PoleResidue>& parts, const Mat& D);

}  // namespace whirl::inline fe

#pragma once
/// Cross sections of shafts: circular, solid or hollow.

#include <array>
#include <numbers>

#include "libbase/structs/field.hpp"

namespace whirl::inline fe {

/// A circular section, solid (inner = 0) or hollow.
struct Section {
  double outer = 0.0;  ///< outer diameter [m]
  double inner = 0.0;  ///< inner diameter [m], 0 <= inner < outer

  /// Area [m^2].
  constexpr double A() const { return std::numbers::pi / 4.0 * (outer * outer - inner * inner); }
  /// Second moment of area about a diameter [m^4].
  constexpr double I() const {
    const double o2 = outer * outer, i2 = inner * inner;
    return std::numbers::pi / 64.0 * (o2 * o2 - i2 * i2);
  }
  bool operator==(const Section&) const = default;
};

/// Section at a fraction s of the way from one to another, diameters linear between.
constexpr Section between(const Section& left, const Section& right, double s) {
  return {left.outer + s * (right.outer - left.outer), left.inner + s * (right.inner - left.inner)};
}

/// What a beam element takes into account.
enum class Theory {
  timoshenko,      ///< bending, shear, rotary inertia, gyroscopics
  rayleigh,        ///< no shear
  euler_bernoulli  ///< no shear, no rotary inertia, no gyroscopics
};
constexpr auto choices(Theory) {
  return std::array{Choice<Theory>{"timoshenko", Theory::timoshenko},
                    Choice<Theory>{"rayleigh", Theory::rayleigh},
                    Choice<Theory>{"euler-bernoulli", Theory::euler_bernoulli}};
}

/// Formula of the shear coefficient kappa in the shear stiffness kappa G A.
enum class ShearFormula { cowper, hutchinson, given };
constexpr auto choices(ShearFormula) {
  return std::array{Choice<ShearFormula>{"cowper", ShearFormula::cowper},
                    Choice<ShearFormula>{"hutchinson", ShearFormula::hutchinson}};
}

struct ShearCoefficient {
  ShearFormula formula = ShearFormula::cowper;
  double value = 0.0;  ///< used if formula is `given`
  bool operator==(const ShearCoefficient&) const = default;
};

/// Shear coefficient of a circular section.
///
///   Cowper:      6 (1+nu) (1+r^2)^2 / ((7+6nu) (1+r^2)^2 + (20+12nu) r^2),  r = inner / outer
///   Hutchinson:  6 (1+nu)^2 (1+r^2)^2 / (7 + 34 r^2 + 7 r^4 + nu (12 + 48 r^2 + 12 r^4)
///                                        + nu^2 (4 + 16 r^2 + 4 r^4))
///
/// @source [Cowper1966], table 1; [Hutchinson2001], eq. (46)
constexpr double shear_coefficient(const ShearCoefficient& how, const Section& section, double nu) {
  const double r2 = section.inner * section.inner / (section.outer * section.outer);
  const double s = (1.0 + r2) * (1.0 + r2);
  switch (how.formula) {
    case ShearFormula::cowper:
      return 6.0 * (1.0 + nu) * s / ((7.0 + 6.0 * nu) * s + (20.0 + 12.0 * nu) * r2);
    case ShearFormula::hutchinson:
      return 6.0 * (1.0 + nu) * (1.0 + nu) * s /
             (7.0 + 34.0 * r2 + 7.0 * r2 * r2 + nu * (12.0 + 48.0 * r2 + 12.0 * r2 * r2) +
              nu * nu * (4.0 + 16.0 * r2 + 4.0 * r2 * r2));
    case ShearFormula::given:
      break;
  }
  return how.value;
}

}  // namespace whirl::inline fe

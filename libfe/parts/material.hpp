#pragma once

#include <string>
#include <tuple>

#include "libbase/structs/field.hpp"

namespace whirl::inline fe {

/// An isotropic, linear elastic material.
struct Material {
  std::string name;
  double rho = 0.0;  ///< density [kg/m^3]; 0 makes massless shafts
  double E = 0.0;    ///< Young's modulus [Pa]
  double G = 0.0;    ///< shear modulus [Pa]
  double nu = 0.0;   ///< Poisson's ratio, nu = E / (2 G) - 1
  double eta =
      0.0;  ///< internal (rotating, viscous) damping: stress = E (strain + eta strain') [s]

  bool operator==(const Material&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("density", &Material::rho, "kg/m^3", nonnegative, "mass per volume; 0: massless"),
        required("youngs_modulus", &Material::E, "Pa", positive, "Young's modulus E"),
        alternative("shear_modulus", &Material::G, "Pa", positive, "shear modulus G, or ..."),
        alternative("poisson_ratio", &Material::nu, "", any, "... Poisson's ratio, -1 to 0.5"),
        optional("internal_damping", &Material::eta, "s", nonnegative,
                 "viscous damping that rotates with the shaft: stress E (strain + eta rate)")};
  }
};

}  // namespace whirl::inline fe

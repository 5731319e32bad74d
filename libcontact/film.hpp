#pragma once
/// What a law of an oil film states.
///
/// A law is a struct with
///
///   static constexpr std::string_view name;      the word in the model file
///   static constexpr bool is_dragged;            whether the journal's spin drags the oil along
///   static constexpr auto fields();              keys of its own, units, ranges, meanings
///   int formula();                               number of the formula, if the fields choose one
///   double factor(bearing);                      of the force [N.s]
///   auto force(x, y, a, b);                      the force over the factor [1/s], a pair
///
/// where (x, y) is the displacement of the journal from the bearing's center over the clearance,
/// and (a, b) says how the film is squeezed and dragged [1/s]:
///
///   a = Omega x - 2 y',   b = Omega y + 2 x'
///
/// and Omega is zero if the oil is not dragged. Rates have a dimension, so that nothing is singular
/// without spin. `force` grows in proportion to (a, b), is written once for any number type
/// (doubles, packs, Taylor series; `sqrt` and `arc_cotangent` are found by their arguments) and is
/// no number where x^2 + y^2 >= 1.

#include <cmath>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact {

/// A plain cylindrical journal bearing.
struct JournalBearing {
  double radius = 0.0;     ///< of the journal [m]
  double length = 0.0;     ///< along the axis [m]
  double clearance = 0.0;  ///< radial [m]
  double viscosity = 0.0;  ///< dynamic [Pa.s]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("radius", &JournalBearing::radius, "m", positive, "of the journal"),
        required("length", &JournalBearing::length, "m", positive, "of the film along the axis"),
        required("clearance", &JournalBearing::clearance, "m", positive, "radial"),
        required("viscosity", &JournalBearing::viscosity, "Pa.s", positive, "dynamic, of the oil")};
  }
};

/// The angle from 0 to pi whose cotangent is v; exact to rounding where v is large.
WHIRL_INLINE double arc_cotangent(double v) {
  return std::atan2(1.0, v);
}

}  // namespace whirl::inline contact

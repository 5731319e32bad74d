#pragma once
/// Equations of periodic orbits along a parameter: what branches are followed on.

#include <functional>
#include <string>
#include <vector>

#include "libdyn/shooting.hpp"

namespace whirl {

/// The flow at a value of the parameter; its states are the same throughout.
/// May throw NumericalError where there is none.
using FlowAt = std::function<Flow(double value)>;

/// Equations of orbits, r(x) = 0 at a value of the parameter.
struct OrbitEquations {
  struct Evaluation {
    Vec residual;                          ///< [scales]; empty: there is none
    Mat jacobian;                          ///< dr / dx, if wanted
    std::string failure;                   ///< why there is no residual
    std::vector<ContactMeasure> contacts;  ///< shares of the period
    std::function<CVec()> multipliers;     ///< of the whole period, the largest first; where r = 0
  };
  std::function<Evaluation(const Vec& x, double value, Tangents wanted)> at;
};

/// Those of shooting: x are the states of all segments, r their gaps.
OrbitEquations shooting_equations(FlowAt flow_at, const Vec& scale);

}  // namespace whirl

#pragma once
/// What `whirl torus` says.

#include <string>

#include "libdyn/studies/torus_branch.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/text/record.hpp"

namespace whirl {

/// Why there is no circle, and the ratio near which the motion turns.
std::string failure_text(const TorusBranch& torus);

/// Entries of the circle, and of those along a parameter.
/// @param speed  at the first value [rad/s]
void add_circle(Record& record, const InvariantCircle& circle, double speed);
void add_walks(Record& record, const TorusBranch& torus, const ParameterAxis& axis);

/// The same for people.
std::string circle_text(const InvariantCircle& circle, double speed);
std::string walks_text(const TorusBranch& torus, const ParameterAxis& axis);

}  // namespace whirl

#pragma once
/// What `whirl torus` says.

#include <string>

#include "apps/verbs/torus_call.hpp"

namespace whirl::inline cli {

/// Why there is no circle, and the ratio near which the motion turns.
std::string failure_text(const TorusBranch& torus);

/// What was found, as JSON and for people.
/// @param resumed  circles that an earlier run had found
void say_torus(Report& report, const Invocation& call, const Model& model, const TorusCall& asked,
               const TorusBranch& torus, std::size_t resumed);

}  // namespace whirl::inline cli

#pragma once
/// Quasi-periodic motions for people.

#include <string>

#include "libdyn/studies/torus_result.hpp"

namespace whirl::inline io {

/// The circle, and those along a parameter; empty where there is none.
std::string text_of(const TorusResult& result);

}  // namespace whirl::inline io

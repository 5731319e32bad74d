#pragma once
/// What is wrong with a model, for people.

#include <string>

#include "apps/invocation.hpp"
#include "libbase/error.hpp"

namespace whirl::inline cli {

/// Prints every problem on standard error, with the line it is in and a mark below the place.
/// @param speed  value of --speed, under whose name a problem of the speed is told; null: not given
void print_problems(const ModelError& error, const Invocation& call, const std::string* speed);

}  // namespace whirl::inline cli

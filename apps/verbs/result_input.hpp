#pragma once

#include <string>

#include "apps/invocation.hpp"

namespace whirl::inline cli {

/// Says what to do first where a result is asked and a model is given.
/// @param kind  of the figure that is wanted; empty: any
/// @throws FileError  if the call's file is TOML by its name, and no HDF5 file
void require_result(const Invocation& call, const std::string& kind);

}  // namespace whirl::inline cli

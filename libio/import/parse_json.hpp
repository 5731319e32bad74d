#pragma once
/// JSON as a tree with places, the same kind of tree that TOML is read into.

#include <string>

#include "libio/model/config.hpp"

namespace whirl::inline io {

/// Parses JSON; null becomes a value of Kind::other. Lines are those where values end.
/// @param file  name for messages
/// @throws ModelError  with the place of a syntax error, for a key that a table has twice, for a
///                     number that no double holds, and for what is nested more than 32 deep
ConfigNode parse_json(const std::string& text, const std::string& file);

}  // namespace whirl::inline io

#pragma once
/// What is meant by a key whose table is left out.

#include <string>

#include "libio/model/config.hpp"

namespace whirl::inline io {

/// Knows what is meant by a key alone, without the tables that it is in.
/// @param root   of a model
/// @param asked  the path that begins with the key
/// @throws ModelError  that says the path of the value, or several; it returns where nobody knows
void throw_if_meant(const ConfigNode& root, const std::string& key, const std::string& asked,
                    const Where& where);

}  // namespace whirl::inline io

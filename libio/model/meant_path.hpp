#pragma once
/// Which value is meant by a key without its table.

#include <string>

#include "libio/model/config.hpp"

namespace whirl::inline io {

/// Throws if a key alone, without the tables that it is in, means a value of a model.
/// @param root   of a model
/// @param asked  the path that begins with the key
/// @throws ModelError  that says the path of the value, or several paths that may be meant
void throw_if_meant(const ConfigNode& root, const std::string& key, const std::string& asked,
                    const Where& where);

}  // namespace whirl::inline io

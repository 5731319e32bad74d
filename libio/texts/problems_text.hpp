#pragma once
/// What is wrong with a model, for people.

#include <string>

#include "libbase/error.hpp"

namespace whirl::inline io {

/// What a problem is told of: the input of a command.
struct ProblemSource {
  std::string file;         ///< its name, also of problems that name no file
  std::string stored_text;  ///< its lines, where they are not those of the file; else empty
};

/// Every problem, with the line it is in and a mark below the place; a line's end behind each line.
std::string problems_text(const ModelError& error, const ProblemSource& source);

/// Problems of an input of one name told under another one, which says all of the place.
ModelError renamed(const ModelError& error, const std::string& from, const std::string& to);

}  // namespace whirl::inline io

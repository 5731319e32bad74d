#pragma once
/// What is wrong with a model, for people.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/text/record.hpp"

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

/// Problems of values that a study set in the model, told under the --over that they come from.
/// @param over  as given: PATH=values
/// @param sets  as given: what is wrong in these stays a problem of --set
ModelError under_over(const ModelError& error, const std::vector<std::string>& over,
                      const std::vector<std::string>& sets);

/// Of a model that is read, and what in it is seldom meant; without doubts: that it is in order.
std::string warnings_text(const std::vector<Problem>& doubts);
/// The same for JSON.
Record record_of_problems(const std::vector<Problem>& problems);

}  // namespace whirl::inline io

#pragma once
/// What is wrong with a model, for people.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io {

/// The input of a command, of which problems are told.
struct ProblemSource {
  std::string file;         ///< its name, also for problems that name no file
  std::string stored_text;  ///< its lines, if not those of the file; else empty
};

/// Every problem, with the line it is in and a mark below the place; a line's end behind each line.
std::string problems_text(const ModelError& error, const ProblemSource& source);

/// The problems of an input named `from`, told under the name `to`, which says the whole place, so
/// that keys are left out.
ModelError renamed(const ModelError& error, const std::string& from, const std::string& to);

/// Problems of values that a study set in the model, told under the --over that they come from.
/// @param over  as given: PATH=values
/// @param sets  as given: a problem of a value in these stays one of --set
ModelError under_over(const ModelError& error, const std::vector<std::string>& over,
                      const std::vector<std::string>& sets);

/// Says what in a model that can be read is seldom meant; without doubts, that the model is in
/// order.
std::string warnings_text(const std::vector<Problem>& doubts);
/// Problems for JSON.
Record record_of_problems(const std::vector<Problem>& problems);

}  // namespace whirl::inline io

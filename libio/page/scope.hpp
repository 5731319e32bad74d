#pragma once
/// What a report rests on, and what it says nothing about.

#include <string>
#include <vector>

#include "libio/figures/figures.hpp"

namespace whirl::inline io {

/// Sentences for people.
struct Scope {
  std::vector<std::string> assumptions, unchecked;
};

/// Assumptions of the model and of its analyses, and what none of these checked.
/// @param results  analyses of one model or of several
Scope scope_of(const std::vector<const ResultView*>& results);

/// What the program remarked when a result was computed.
std::vector<std::string> remarks_in(const ResultView& result);

}  // namespace whirl::inline io

#pragma once

#include <string>

namespace whirl {

/// A script that completes verbs, options and file names in bash, from the list of verbs.
std::string bash_completion();

}  // namespace whirl

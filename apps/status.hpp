#pragma once
/// How the program ends.

#include "libio/results/replace_file.hpp"

namespace whirl::inline cli {

/// Exit statuses that verbs do not decide.
namespace exit_status {
constexpr int done = 0, wrong_input = 2, failed = 3;
}

/// A status, unless what was printed did not arrive, on a full disk for instance.
int after_printing(int status);

/// Says that a place holds what whirl did not write; the status.
int refused(const TakenPlace& error);
/// Says what is wrong with a file; the status.
int refused(const FileError& error);

}  // namespace whirl::inline cli

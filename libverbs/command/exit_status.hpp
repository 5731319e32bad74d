#pragma once
/// How a program ends that runs a verb.

#include "libio/results/replace_file.hpp"

namespace whirl::inline cli {

/// Exit statuses.
namespace exit_status {
constexpr int done = 0, wrong_input = 2, failed = 3, stopped = 130;
}

/// A status; wrong_input, with a message, if what was printed did not arrive, on a full disk for
/// instance.
int after_printing(int status);

/// Says what is wrong with a file, or that a place holds what whirl did not write; returns the exit
/// status.
int refused(const FileError& error);

}  // namespace whirl::inline cli

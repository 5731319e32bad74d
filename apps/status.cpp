#include "apps/status.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace whirl::inline cli {

int after_printing(int status) {
  if (std::fflush(stdout) == 0) return status;
  fmt::print(stderr, "whirl: cannot write to standard output\n");
  return exit_status::wrong_input;
}

int refused(const TakenPlace& error) {
  fmt::print(stderr, "whirl: {}; take another name, or --force to replace it\n", error.what());
  return exit_status::wrong_input;
}

int refused(const FileError& error) {
  fmt::print(stderr, "whirl: {}\n", error.what());
  return exit_status::wrong_input;
}

}  // namespace whirl::inline cli

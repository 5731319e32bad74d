#include "libverbs/command/exit_status.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "libio/text/terminal.hpp"

namespace whirl::inline cli {

int after_printing(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  say(stderr, "whirl: cannot write to standard output\n");
  return exit_status::wrong_input;
}

int refused(const FileError& error) {
  const bool is_taken = dynamic_cast<const TakenPlace*>(&error) != nullptr;
  say(stderr, fmt::format("whirl: {}{}\n", error.what(),
                          is_taken ? "; take another name, or --force to replace it" : ""));
  return exit_status::wrong_input;
}

}  // namespace whirl::inline cli

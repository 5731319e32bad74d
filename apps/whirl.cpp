// The program of one process.

#include "apps/run_program.hpp"
#include "libio/text/passing_file.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/exit_status.hpp"

int main(int argc, char** argv) {
  whirl::fill_standard_streams();
  whirl::remove_passing_files_at_signals(whirl::exit_status::stopped);
  return whirl::run_program({argv, argv + argc});
}

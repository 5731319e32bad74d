// The program of one process.

#include "apps/run_program.hpp"
#include "libio/text/terminal.hpp"

int main(int argc, char** argv) {
  whirl::fill_standard_streams();
  return whirl::run_program({argv, argv + argc});
}

// The list of verbs, in the order of the help. A new verb is a file in verbs/ and a line here.

#include "libverbs/command/verb.hpp"

// clang-format off
#define VERBS        \
  check_verb(),      \
  import_verb(),     \
  static_verb(),     \
  modes_verb(),      \
  campbell_verb(),   \
  resonances_verb(), \
  critical_verb(),   \
  unbalance_verb(),  \
  frf_verb(),        \
  sensitivity_verb(), \
  lateral_verb(),    \
  balance_verb(),    \
  simulate_verb(),   \
  identify_verb(),   \
  fit_verb(),        \
  classify_verb(),   \
  orbit_verb(),      \
  continue_verb(),   \
  torus_verb(),      \
  sweep_verb(),      \
  map_verb(),        \
  basins_verb(),     \
  bench_verb(),      \
  export_verb(),     \
  animate_verb(),    \
  report_verb(),     \
  plot_verb(),       \
  rerun_verb(),      \
  status_verb(),     \
  merge_verb(),      \
  completion_verb(), \
  schema_verb()
// clang-format on

namespace whirl::inline cli {

// The list twice: as declarations of functions, each in the file of its verb, and as their calls.
Verb VERBS;

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all{VERBS};
  return all;
}

}  // namespace whirl::inline cli

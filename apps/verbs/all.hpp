#pragma once
/// The functions behind the verbs; each is in the file of its name.

#include "apps/verb.hpp"

namespace whirl {

Report run_check(const Invocation& call);
Report run_static(const Invocation& call);
Report run_modes(const Invocation& call);
Report run_campbell(const Invocation& call);
Report run_resonances(const Invocation& call);
Report run_critical(const Invocation& call);
Report run_unbalance(const Invocation& call);
Report run_simulate(const Invocation& call);
Report run_identify(const Invocation& call);
Report run_classify(const Invocation& call);
Report run_orbit(const Invocation& call);
Report run_torus(const Invocation& call);
Report run_continue(const Invocation& call);
Report run_sweep(const Invocation& call);
Report run_map(const Invocation& call);
Report run_basins(const Invocation& call);
Report run_bench(const Invocation& call);
Report run_animate(const Invocation& call);
Report run_export(const Invocation& call);
Report run_plot(const Invocation& call);
Report run_report(const Invocation& call);

}  // namespace whirl

#include "apps/verbs/orbits.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"

namespace whirl::inline cli {

namespace {

constexpr long most_harmonics = 10000;

}  // namespace

OrbitFrame orbit_frame(const Invocation& call) {
  return call.parsed("frame", parse_choice<OrbitFrame>);
}

OrbitMethod orbit_method(const Invocation& call) {
  const OrbitMethod method = call.parsed("method", parse_choice<OrbitMethod>);
  for (const std::string option : {"harmonics", "verify"}) {
    if (method == OrbitMethod::harmonic_balance || !call.has(option)) continue;
    throw ModelError({"--" + option}, "", "goes with --method harmonic-balance");
  }
  return method;
}

int harmonics_of(const Invocation& call, int period) {
  if (!call.has("harmonics")) return 0;
  const long harmonics = call.integer("harmonics");
  if (harmonics < period || harmonics > most_harmonics) {
    throw call.wrong("harmonics",
                     fmt::format("expected {} to {}: the speed is harmonic {} of the orbit", period,
                                 most_harmonics, period));
  }
  return static_cast<int>(harmonics);
}

BranchParameters asked_parameters(const Invocation& call, const Model& model) {
  return branch_parameters(model, call.over, call.text("at"),
                           static_cast<int>(call.integer("points", 2)));
}

Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene) {
  const long discard = call.has("from") && !call.has("discard") ? 0 : call.integer("discard", 0);
  const double tolerance = call.parsed("tolerance", parse_tolerance);
  install_interrupt_handler();
  return run_transient(scene, starting_state(call, model, scene),
                       {.revolutions = discard,
                        .tolerance = tolerance,
                        .progress = progress_of(call, "going through the transient"),
                        .is_stopped = is_interrupted});
}

Report orbit_report(const Invocation& call, const Model& model, const std::string& what) {
  Report report = begin_report(call, model);
  report.text = headline(what, model);
  note_tables(call, model, report);
  return report;
}

void add_kept(const Invocation& call, const std::string& points, long resumed, Report& report) {
  if (resumed > 0) report.text += fmt::format("\n  {} {} were there already\n", resumed, points);
  if (report.status == 130) {
    report.text +=
        fmt::format("\n  stopped{}\n", call.has("out") ? "; the same line goes on from there" : "");
  }
  tell_result(call, report);
}

}  // namespace whirl::inline cli

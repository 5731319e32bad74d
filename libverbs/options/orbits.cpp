#include "libverbs/options/orbits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libio/results/columns.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libio/texts/motion_text.hpp"

namespace whirl::inline cli {

namespace {

constexpr long most_harmonics = 10000;

}  // namespace

MotionLoads add_loads(Report& report, const Model& model, const Scene& scene, const Vec& state,
                      double period) {
  const long revolutions = std::max<long>(noted_revolutions, std::lround(std::ceil(period)));
  const SupportLoads supports(model, scene);
  const Recording motion = recorded_from(scene, {.y = state}, revolutions, &supports);
  MotionLoads loads = motion_loads(supports.parts(), motion);
  report.record.set("loads", record_of(loads));
  report.text += text_of(loads);
  report.add_notes(motion_notes(model, scene, motion));
  return loads;
}

void require_balance(OrbitMethod method, bool is_given, const char* option) {
  if (method == OrbitMethod::harmonic_balance || !is_given) return;
  throw ModelError({option}, "", "goes with --method harmonic-balance");
}

int checked_harmonics(const Option<long>& harmonics, int period) {
  if (!harmonics) return 0;
  if (*harmonics < period || *harmonics > most_harmonics) {
    throw harmonics.wrong(fmt::format("expected {} to {}: the speed is harmonic {} of the orbit",
                                      period, most_harmonics, period));
  }
  return static_cast<int>(*harmonics);
}

BranchParameters asked_parameters(const AlongVerbOptions& options, const Model& model) {
  return branch_parameters(model, options.over.values, options.at.value_or(""), *options.points);
}

Trajectory after_transient(const Invocation& call, const SettledVerbOptions& options,
                           const Option<std::string>& from, const Model& model,
                           const Scene& scene) {
  const bool goes_on = from && !options.discard.is_given;
  return run_transient(scene, starting_state(from, model, scene),
                       {.revolutions = goes_on ? 0 : *options.discard,
                        .tolerance = *options.tolerance,
                        .progress = progress_of(call, "going through the transient"),
                        .is_stopped = call.stop_asked()});
}

Report orbit_report(const Invocation& call, const Model& model, const std::string& what) {
  Report report = begin_report(call, model);
  report.text = headline(what, model);
  note_model(call, model, report);
  return report;
}

void add_kept(const Invocation& call, const std::string& points, long resumed, Report& report) {
  if (resumed > 0) report.text += fmt::format("\n  {} {} were there already\n", resumed, points);
  if (report.status == exit_status::stopped) {
    report.text +=
        fmt::format("\n  stopped{}\n", call.output.out ? "; the same line goes on from there" : "");
  }
  tell_result(call, report);
}

}  // namespace whirl::inline cli

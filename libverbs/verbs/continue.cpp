#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/kept_branches.hpp"
#include "libio/texts/branches_text.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libverbs/options/orbits.hpp"

namespace whirl::inline cli {

namespace {

struct ContinueVerbOptions {
  AlongVerbOptions along{
      .over = {"over", "PATH=A:B:STEP",
               "a value of the model, from where to where, and the largest step; first:last: a "
               "hundredth; a second one: bifurcation curves in the plane of both"},
      .at = {"at", "VALUE[,VALUE]",
             "where the first orbit is looked for, between first and last; left out: first"}};
  Option<int> period{"period", "N", "revolutions after which the first orbit repeats", 1,
                     period_range};
  Option<OrbitFrame> frame = frame_option();
  OrbitMethodVerbOptions how{};
  Option<int> generations{"switch", "N",
                          "generations of branches that begin at period doublings and pitchforks",
                          0, Whole{0, 100}};
  Option<int> most{"most", "N", "points of a branch at most", 2000, Whole{1, 1'000'000}};
  Option<std::string> stations{
      "stations", "NAME,...",
      "whose amplitude is said: names, node numbers, all; left out: as sweep"};
  SettledVerbOptions settled{};
  KeptVerbOptions kept{};
  auto fields() {
    return std::tie(along, period, frame, how, generations, most, stations, settled, kept);
  }
};

/// @throws ModelError  for options that do not go together
BranchSetup asked_branches(const ContinueVerbOptions& asked, const Model& model) {
  const auto refuse = [](const char* option, const char* why) {
    throw ModelError({option}, "", why);
  };
  const bool is_rotating = *asked.frame == OrbitFrame::rotating;
  if (is_rotating && (asked.generations.is_given || asked.period.is_given)) {
    refuse("--frame rotating", "expected neither --period nor --switch beside it");
  }
  const BranchParameters parameters = asked_parameters(asked.along, model);
  const bool has_curves = parameters.across.has_value();
  if (is_rotating && has_curves) refuse("--frame rotating", "expected one --over beside it");
  const OrbitMethod method = *asked.how.method;
  require_balance(method, asked.how.harmonics.is_given, "--harmonics");
  if (method == OrbitMethod::harmonic_balance) {
    constexpr auto only_shooting = "goes with --method shooting only";
    if (*asked.generations > 0) refuse("--switch", only_shooting);
    if (is_rotating) refuse("--frame rotating", only_shooting);
    if (has_curves) refuse("--over", only_shooting);
  }
  const int period = *asked.period;
  return branch_setup(parameters,
                      {.method = method,
                       .frame = *asked.frame,
                       .period = period,
                       .harmonics = checked_harmonics(asked.how.harmonics, period),
                       .generations = *asked.generations,
                       .most_points = *asked.most},
                      asked.stations.value_or(""));
}

Report run_continue(const Invocation& call, const ContinueVerbOptions& asked) {
  const Model model = call.model();
  BranchSetup setup = asked_branches(asked, model);
  setup.threads = study_threads(call);
  Report report =
      orbit_report(call, model, "Periodic orbits along " + setup.parameters.along.axis.path);
  const auto settled = [&] {
    return settled_state(
        after_transient(call, asked.settled, asked.kept.from, setup.at_first, *setup.scene));
  };
  const auto [found, resumed] = keep_branches(
      setup, study_keeping(call, model, asked.kept, "points of branches", report.notes), settled);
  report.status = found.is_complete() ? exit_status::done : exit_status::stopped;
  const BranchResult branches = setup.result(found.tree);
  report.record.merge(record_of(branches)).set("resumed", resumed);
  report.text += text_of(branches);
  const auto value_at = [&](std::size_t k) { return branches.points[k].value; };
  report.add_notes(touch_notes(
      hardest_touches(branches), [&](std::size_t k) { return setup.parameters.model(value_at(k)); },
      [&](std::size_t k) {
        const ParameterName& name = branches.parameter;
        return fmt::format("{} = {:.10g} {}", name.path, value_at(k), name.unit);
      }));
  if (setup.has_curves()) {
    const CurveResult curves = setup.result(found.curves);
    report.record.merge(record_of(curves));
    report.text += text_of(curves);
  }
  add_kept(call, "points", resumed, report);
  return report;
}

}  // namespace

Verb continue_verb() {
  return {
      .name = "continue",
      .group = "Contact",
      .summary =
          "a branch of periodic orbits along a parameter, round its folds, with its bifurcations",
      .example =
          "whirl continue models/jeffcott_stator.toml --speed 138.4rad/s --set "
          "contact.ring.stiffness=64e6 --over contact.ring.friction=0.1:0.15:0.002 --at 0.15",
      .run = run_continue,
      .shares_work = true,
  };
}

}  // namespace whirl::inline cli

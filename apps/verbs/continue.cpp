#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "libbase/error.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/kept_branches.hpp"
#include "libio/texts/branches_text.hpp"

namespace whirl::inline cli {

namespace {

/// @throws ModelError  for options that are wrong, or do not go together
BranchSetup asked_branches(const Invocation& call, const Model& model) {
  const auto refuse = [](const char* option, const char* why) {
    throw ModelError({option}, "", why);
  };
  BranchTreeOptions tree{.frame = orbit_frame(call)};
  const bool is_rotating = tree.frame == OrbitFrame::rotating;
  if (is_rotating && (call.has("switch") || call.has("period"))) {
    refuse("--frame rotating", "expected neither --period nor --switch beside it");
  }
  const BranchParameters parameters = asked_parameters(call, model);
  const bool has_curves = parameters.across.has_value();
  if (is_rotating && has_curves) refuse("--frame rotating", "expected one --over beside it");
  tree.period = static_cast<int>(call.integer("period"));
  tree.most_points = static_cast<int>(call.integer("most"));
  tree.generations = static_cast<int>(call.integer("switch", 0));
  tree.method = orbit_method(call);
  if (tree.method == OrbitMethod::harmonic_balance) {
    constexpr auto only_shooting = "goes with --method shooting only";
    if (tree.generations > 0) refuse("--switch", only_shooting);
    if (is_rotating) refuse("--frame rotating", only_shooting);
    if (has_curves) refuse("--over", only_shooting);
  }
  tree.harmonics = harmonics_of(call, tree.period);
  return branch_setup(parameters, tree, call.text("stations"));
}

Report run_continue(const Invocation& call) {
  const Model model = call.model();
  const BranchSetup asked = asked_branches(call, model);
  Report report =
      orbit_report(call, model, "Periodic orbits along " + asked.parameters.along.axis.path);
  const auto settled = [&] {
    return settled_state(after_transient(call, asked.at_first, *asked.scene));
  };
  const auto [found, resumed] = keep_branches(
      asked,
      study_keeping(call, model, earlier_start(call, model), "points of branches", report.notes),
      settled);
  report.status = found.is_complete() ? 0 : 130;
  const BranchResult branches = asked.result(found.tree);
  report.record.merge(record_of(branches)).set("resumed", resumed);
  report.text += text_of(branches);
  if (asked.has_curves()) {
    const CurveResult curves = asked.result(found.curves);
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
      .options = {{"over", "PATH=A:B:STEP",
                   "a value of the model, from where to where, and the largest step; first:last: a "
                   "hundredth; a second one: bifurcation curves in the plane of both"},
                  branch_points_option,
                  {"at", "VALUE[,VALUE]",
                   "where the first orbit is looked for, between first and last; left out: first"},
                  {"period", "N", "revolutions after which the first orbit repeats", "1"},
                  frame_option,
                  orbit_method_option,
                  harmonics_option,
                  {"switch", "N",
                   "generations of branches that begin at period doublings and pitchforks", "0"},
                  {"most", "N", "points of a branch at most", "2000"},
                  {"stations", "NAME,...",
                   "whose amplitude is said: names, node numbers, all; left out: as sweep"},
                  branch_discard_option,
                  tolerance_option,
                  from_option,
                  restart_option},
      .run = run_continue,
  };
}

}  // namespace whirl::inline cli

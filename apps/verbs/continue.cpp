#include <fmt/format.h>

#include <optional>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/branch_parameters.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/continue_text.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study_file.hpp"
#include "libbase/error.hpp"
#include "libio/results/branch_results.hpp"
#include "libio/results/curve_results.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl {

namespace {

/// What a call asks for.
struct ContinueCall {
  BranchParameters parameters;
  BranchTreeOptions tree;
  Model at_first;  ///< the model at the first value
  std::shared_ptr<const Scene> scene;
  BranchNames names;

  ParameterScenes scenes() const {
    return {scene, [this](double value) { return parameters.scene(value); }};
  }
  PlaneScenes plane() const {
    return {scene, [this](double a, double b) { return parameters.scene(a, b); }};
  }
  /// With a second parameter only.
  BifurcationCurveOptions curve_options() const {
    return {tree.along, parameters.across->range, tree.most_points};
  }
  CurveAxes curve_axes() const {
    return {parameters.along.axis, tree.along, parameters.across->axis};
  }
};

/// @throws ModelError  for options that do not go together
void require_that_fits(const ContinueCall& asked) {
  const bool is_rotating = asked.tree.frame == OrbitFrame::rotating;
  if (is_rotating && asked.parameters.across) {
    throw ModelError({"--frame rotating"}, "", "expected one --over beside it");
  }
  if (asked.tree.method != OrbitMethod::harmonic_balance) return;
  if (asked.tree.generations > 0 || asked.parameters.across || is_rotating) {
    throw ModelError({asked.tree.generations > 0 ? "--switch"
                      : is_rotating              ? "--frame rotating"
                                                 : "--over"},
                     "", "goes with --method shooting only");
  }
}

ContinueCall continue_call(const Invocation& call, const Model& model) {
  ContinueCall asked;
  asked.tree.frame = orbit_frame(call);
  if (asked.tree.frame == OrbitFrame::rotating && (call.has("switch") || call.has("period"))) {
    throw ModelError({"--frame rotating"}, "", "expected neither --period nor --switch beside it");
  }
  asked.parameters = branch_parameters(call, model);
  asked.tree.along = asked.parameters.along.range;
  asked.tree.period = static_cast<int>(call.integer("period"));
  asked.tree.most_points = static_cast<int>(call.integer("most"));
  asked.tree.generations = static_cast<int>(call.integer("switch", 0));
  asked.tree.method = orbit_method(call);
  require_that_fits(asked);
  asked.tree.harmonics = harmonics_of(call, asked.tree.period);
  asked.at_first = asked.parameters.model(asked.tree.along.first);
  asked.scene = std::make_shared<const Scene>(make_scene(asked.at_first));
  const ParameterAxis& axis = asked.parameters.along.axis;
  asked.names = {.path = axis.path, .unit = axis.unit, .stations = {}};
  for (const NamedPoint& p :
       select_points(asked.at_first, asked.scene->assembler, call.text("stations"))) {
    asked.tree.stations.push_back(p.point);
    asked.names.stations.push_back(point_label(p));
  }
  return asked;
}

/// The first branch, from the model's start; nothing: stopped before.
std::optional<BranchTree> first_branch(const Invocation& call, const ContinueCall& asked) {
  const Trajectory transient = after_transient(call, asked.at_first, *asked.scene);
  const int status = status_of(transient.outcome);
  if (status == 130) return std::nullopt;
  if (status == 3) throw NumericalError(transient.diagnosis);
  return begin_tree(asked.scenes(), transient.state.y, asked.tree);
}

/// All that is found, and what of it is in the file already.
struct FollowedBranches {
  BranchTree tree;
  BifurcationCurves curves{};
  long resumed = 0;  ///< points
  int status = 0;
};

/// The study with its file: begun, gone on with, or only read.
FollowedBranches follow_branches(const Invocation& call, const Model& model,
                                 const ContinueCall& asked) {
  FollowedBranches found{.tree = empty_tree(*asked.scene, asked.tree)};
  const BranchTree* tree = &found.tree;
  const BifurcationCurves* curves = &found.curves;
  const std::optional<EarlierEnd> start = earlier_start(call, model);
  StudyFile file(
      call, start,
      [&] {
        auto made = call.result_file(model);
        write_start(*made, start);
        return made;
      },
      [&](ResultWriter& to) {
        write_branches(to, *tree, asked.names);
        write_fixed(to, asked.parameters);
        if (asked.parameters.across) write_curves(to, *curves, asked.curve_axes());
      },
      [&](const ResultReader& earlier) {
        found.tree = read_branches(earlier, found.tree);
        found.curves = read_curves(earlier, found.tree.layout);
      });
  found.resumed = found.tree.points();
  found.status = 130;
  if (found.resumed == 0) {
    const auto begun = first_branch(call, asked);
    if (!begun) return found;
    found.tree = *begun;
  }
  install_interrupt_handler();
  Progress progress("points of branches", asked.tree.most_points, call.shows_progress);
  const auto show = [&](long done, long) { progress.update(done); };
  found.tree = grow_tree(
      asked.scenes(), found.tree, asked.tree,
      {.progress = show, .is_stopped = is_interrupted, .save = [&](const BranchTree& so_far) {
         tree = &so_far;
         file.save();
       }});
  tree = &found.tree;
  if (!found.tree.is_complete()) return found;
  if (asked.parameters.across) {
    found.curves =
        follow_bifurcations(asked.plane(), found.tree, found.curves, asked.curve_options(),
                            {.progress = show,
                             .is_stopped = is_interrupted,
                             .save = [&](const BifurcationCurves& so_far) {
                               curves = &so_far;
                               file.save();
                             }});
  }
  found.status = found.curves.is_complete() ? 0 : 130;
  return found;
}

Report run_continue(const Invocation& call) {
  const Model model = call.model();
  const ContinueCall asked = continue_call(call, model);
  const FollowedBranches found = follow_branches(call, model, asked);
  const BranchTree& tree = found.tree;
  const ParameterAxis& axis = asked.parameters.along.axis;
  Report report{.record = begin_record(call, model), .status = found.status};
  note_tables(call, model, report);
  Record& r = report.record;
  r.set("parameter", axis.path).set("unit", axis.unit).set("method", call.text("method"));
  const bool is_series = asked.tree.method == OrbitMethod::harmonic_balance;
  if (is_series) r.set("harmonics", tree.layout.harmonics);
  r.set("branches", branches_record(tree)).set("points", points_record(tree));
  r.set("bifurcations", bifurcations_record(tree)).set("resumed", found.resumed);
  report.text =
      "Periodic orbits along " + axis.path + (model.title.empty() ? "" : ": " + model.title) + "\n";
  if (is_series) {
    report.text += fmt::format("  by harmonic balance with {} harmonics\n", tree.layout.harmonics);
  }
  report.text += branches_text(tree, axis);
  if (asked.parameters.across) {
    r.set("borders", curves_record(found.curves, asked.tree.along));
    report.text += curves_text(found.curves, asked.curve_axes());
  }
  if (found.resumed > 0) {
    report.text += fmt::format("\n  {} points were there already\n", found.resumed);
  }
  if (found.status == 130) {
    report.text +=
        fmt::format("\n  stopped{}\n", call.has("out") ? "; the same line goes on from there" : "");
  }
  if (call.has("out")) report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
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
                   "hundredth; a second one: borders in the plane of both"},
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

}  // namespace whirl

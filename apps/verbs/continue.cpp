#include <optional>

#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/continue_text.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/study.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline cli {

namespace {

/// The study with its file: begun, gone on with, or only read.
FollowedBranches follow_branches(const Invocation& call, const Model& model,
                                 const ContinueCall& asked) {
  FollowedBranches found{.tree = empty_tree(*asked.scene, asked.tree)};
  const BranchTree* tree = &found.tree;
  const BifurcationCurves* curves = &found.curves;
  StudyFile file(
      study_place(call, model, earlier_start(call, model)), [&] { return call.result_file(model); },
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
    const auto state = settled_state(call, asked.at_first, *asked.scene);
    if (!state) return found;
    found.tree = begin_tree(asked.scenes(), state->y, asked.tree);
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
  return continue_report(call, model, asked, follow_branches(call, model, asked));
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

}  // namespace whirl::inline cli

#include "libdyn/studies/branch_study.hpp"

namespace whirl::inline dyn {

BranchStudy follow_branches(const BranchScenes& scenes, BranchStudy study,
                            const std::function<std::optional<Vec>()>& settled,
                            const BranchStudyOptions& options,
                            const Monitor<BranchStudy>& monitor) {
  if (study.tree.branches.empty()) {
    const std::optional<Vec> start = settled();
    if (!start) return study;
    study.tree = begin_tree(scenes.along, *start, options.tree);
  }
  const auto save = [&] {
    if (monitor.save) monitor.save(study);
  };
  study.tree = grow_tree(scenes.along, study.tree, options.tree,
                         {monitor.progress, monitor.is_stopped, [&](const BranchTree& so_far) {
                            study.tree = so_far;
                            save();
                          }});
  if (!options.curves || !study.tree.is_complete()) return study;
  study.curves =
      follow_bifurcations(scenes.plane, study.tree, study.curves, *options.curves,
                          {monitor.progress, monitor.is_stopped, [&](const BifurcationCurves& c) {
                             study.curves = c;
                             save();
                           }});
  return study;
}

}  // namespace whirl::inline dyn

#include "libio/results/kept_branches.hpp"

#include "libio/results/branch_results.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/results/torus_results.hpp"

namespace whirl::inline io {

KeptBranches keep_branches(const BranchSetup& asked, const StudyKeeping& keeping,
                           const Settled& settled) {
  KeptBranches kept;
  const BranchStudy empty{.tree = empty_tree(*asked.scene, asked.tree)};
  const KeptStudy<BranchStudy> study{
      .write =
          [&](ResultWriter& to, const BranchStudy& found) {
            write_branches(to, found.tree, asked.result(found.tree));
            if (asked.has_curves()) write_curves(to, found.curves, asked.result(found.curves));
          },
      .take =
          [&](BranchStudy& found, const ResultReader& from) {
            found.tree = read_branches(from, empty.tree);
            found.curves = read_curves(from, found.tree.layout);
            kept.resumed = found.tree.points();
          },
      .run =
          [&](const BranchStudy& begun, const Monitor<BranchStudy>& monitor) {
            const auto state = [&]() -> std::optional<Vec> {
              const auto motion = settled();
              return motion ? std::optional(motion->y) : std::nullopt;
            };
            return follow_branches(asked.scenes(), begun, state, asked.options(), monitor);
          }};
  kept.found = run_kept(keeping, study, empty);
  return kept;
}

KeptTorus keep_torus(const TorusSetup& asked, const StudyKeeping& keeping, const Settled& settled) {
  KeptTorus kept;
  const KeptStudy<TorusBranch> study{
      .write =
          [&](ResultWriter& to, const TorusBranch& torus) {
            write_end(to, asked.at_first, *asked.scene, torus.circle.points.col(0));
            write_torus(to, torus, asked.result(torus));
          },
      .take =
          [&](TorusBranch& torus, const ResultReader& from) {
            torus = read_torus(from, asked.scene->contacts.size());
            kept.resumed = std::ssize(torus.points());
          },
      .run =
          [&](TorusBranch begun, const Monitor<TorusBranch>& monitor) {
            return grow_torus(asked.scenes(), std::move(begun), settled, asked.options, monitor);
          }};
  kept.torus = run_kept(keeping, study);
  return kept;
}

}  // namespace whirl::inline io

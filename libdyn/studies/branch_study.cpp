#include "libdyn/studies/branch_study.hpp"

#include <utility>

#include "libbase/system/interruption.hpp"
#include "libdyn/studies/branch_walk.hpp"
#include "libdyn/studies/piece_runner.hpp"

namespace whirl::inline dyn {

namespace {

constexpr std::size_t of_tree = 0, of_curves = 1;  ///< what a piece is a walk of

WalkWork walk_work(const BranchScenes& scenes, const BranchStudyOptions& options,
                   StretchLimits limits) {
  WalkWork work{.threads = options.threads, .keeps_parts = true};
  work.compute = [&, limits = std::move(limits)](const WalkWork::Piece& piece, BegunWalk& begun) {
    return std::vector{piece[0] == of_tree
                           ? walk_branch(scenes.along, options.tree, std::move(begun), limits)
                           : walk_curve(scenes.plane, *options.curves, std::move(begun), limits)};
  };
  return work;
}

/// The walks of a study that are not done.
class WalksLeft {
 public:
  WalksLeft(const BranchScenes& scenes, const BranchStudyOptions& options, BranchStudy& study)
      : scenes_(scenes),
        options_(options),
        study_(study),
        tree_(scenes.along, options.tree, study.tree) {}

  std::optional<OpenPiece<BegunWalk>> next() {
    if (auto walk = tree_.next()) {
      return OpenPiece<BegunWalk>{{of_tree, walk->number}, std::move(walk->begun)};
    }
    if (!options_.curves || !study_.tree.is_complete()) return std::nullopt;
    std::vector<BifurcationCurve>& curves = study_.curves.curves;
    if (curves.empty() && !has_curves_) {
      study_.curves = begin_curves(scenes_.plane, study_.tree, *options_.curves);
    }
    has_curves_ = true;
    curves_.resize(curves.size());
    for (std::size_t i = 0; i < curves.size(); ++i) {
      if (curves_[i].is_away || curves[i].branch.end) continue;
      curves_[i].is_away = true;
      BegunWalk walk = begun_walk(curves[i]);
      walk.by_parameter = curves_[i].by_parameter;
      return OpenPiece<BegunWalk>{{of_curves, i}, std::move(walk)};
    }
    return std::nullopt;
  }

  void keep(const WalkWork::Piece& piece, WalkNews news) {
    if (piece[0] == of_tree) return tree_.keep(piece[1], std::move(news));
    curves_[piece[1]] = {.is_away = false, .by_parameter = std::move(news.by_parameter)};
    add_news(study_.curves.curves[piece[1]].branch, news.branch, {});
  }

 private:
  /// Along a curve.
  struct Walk {
    bool is_away = false;
    Vec by_parameter{};  ///< as of BegunWalk
  };

  const BranchScenes& scenes_;
  const BranchStudyOptions& options_;
  BranchStudy& study_;
  TreeGrowth tree_;
  bool has_curves_ = false;  ///< they are begun, if there are any
  std::vector<Walk> curves_;
};

}  // namespace

BranchStudy follow_branches(const BranchScenes& scenes, BranchStudy study,
                            const std::function<std::optional<Vec>()>& settled,
                            const BranchStudyOptions& options,
                            const Monitor<BranchStudy>& monitor) {
  const bool leads = !monitor.ranks || monitor.ranks->leads();
  const auto stops = [&monitor] { return monitor.stops(); };
  if (leads && study.tree.branches.empty()) {
    const std::optional<Vec> start = settled();
    if (!start) return study;
    const bool has_begun = finishes_unless(
        stops, [&] { study.tree = begin_tree(scenes.along, *start, options.tree); });
    if (!has_begun) return study;
  }
  WalksLeft walks(scenes, options, study);
  SaveTimer timer;
  const auto save = [&] {
    if (monitor.save) monitor.save(study);
  };
  long added = 0;
  const auto keep = [&](FinishedPiece<WalkNews> stretch) {
    WalkNews& news = stretch.rows[0];
    added += std::ssize(news.branch.points);
    walks.keep(stretch.piece, std::move(news));
    monitor.show(added, options.tree.most_points);
    if (timer.is_due()) timer.save(save);
  };
  const WalkWork work = walk_work(scenes, options, {options.stretch, stops});
  run_pieces<WalkNews, BegunWalk>(work, {[&](int) { return walks.next(); }, keep, save}, monitor);
  return study;
}

}  // namespace whirl::inline dyn

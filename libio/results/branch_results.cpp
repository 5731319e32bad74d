#include "libio/results/branch_results.hpp"

#include <fmt/format.h>

#include "libbase/numerics/constants.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/packed_branch.hpp"

namespace whirl::inline io {

namespace {

/// Of a branch of a tree and of a curve alike. The period stands before; ends, contacts of grazings
/// and readings of probes are columns of the result.
void pack_branch(auto& in, auto& branch, auto& measures, auto& starts) {
  auto& [period, points, bifurcations, end] = branch;
  in.size(points);
  in.size(bifurcations);
  in.resize(measures, points.size());
  in.resize(starts, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    pack_point(in, points[i]);
    auto& [radii, work, probe_peak_to_peak, sections] = measures[i];
    in(radii), in(work), in(sections);
    in(starts[i]);
  }
  for (auto& bifurcation : bifurcations) {
    auto& [kind, at, after, contact, change, multiplier] = bifurcation;
    pack_point(in, at);
    in(kind), in(after), in(change), in(multiplier);
  }
}

void pack_traced(auto& in, auto& traced) {
  auto& [branch, parent, generation, direction, measures, starts] = traced;
  auto kind = BifurcationKind::fold;  // only curves have one
  in(branch.period), in(parent), in(generation), in(direction), in(kind);
  pack_branch(in, branch, measures, starts);
}

/// Nothing of a curve is measured.
void pack_curve(auto& in, auto& curve) {
  auto& [kind, contact, branch_number, direction, branch] = curve;
  int generation = 0;
  std::vector<OrbitMeasure> measures(branch.points.size());
  std::vector<Vec> starts(branch.points.size());
  in(branch.period), in(branch_number), in(generation), in(direction), in(kind);
  pack_branch(in, branch, measures, starts);
}

/// Checks the points of a branch against its layout and each other, and names their contacts.
class PointCheck {
 public:
  PointCheck(const Unpacker& walk, const BranchLayout& layout) : walk_(walk), layout_(layout) {}

  /// @param unknowns  with the parameter; 0: of series, as many as the first point has
  void check(Branch& branch, Eigen::Index unknowns) const {
    if (branch.period < 1 || branch.points.empty()) walk_.fail("a branch has no points");
    if (unknowns == 0) unknowns = branch.points.front().z.size();
    for (BranchPoint& p : branch.points) check(p, unknowns);
    if (!branch.end) {  // it goes on along the tangent
      require(branch.points.back().tangent.size(), unknowns, "numbers of its tangent");
    }
    for (Bifurcation& x : branch.bifurcations) {
      check(x.at, unknowns);
      if (x.after >= branch.points.size() || name_of(x.kind) == "?") {
        walk_.fail("a bifurcation is of no kind, or at no point");
      }
    }
  }
  void check(const std::vector<Vec>& starts) const {
    for (const Vec& y : starts) require(y.size(), layout_.states, "states");
  }
  void check(const std::vector<OrbitMeasure>& measures) const {
    for (const OrbitMeasure& m : measures) {
      require(std::ssize(m.radii), std::ssize(measures.front().radii), "radii");
    }
  }

 private:
  void check(BranchPoint& p, Eigen::Index unknowns) const {
    require(p.z.size(), unknowns, "unknowns");
    require(std::ssize(p.contacts), std::ssize(layout_.contacts), "contacts");
    for (std::size_t i = 0; i < p.contacts.size(); ++i) {
      p.contacts[i].name = layout_.contacts[i];
      p.contacts[i].mean_slip = nan;
    }
  }
  void require(Eigen::Index found, Eigen::Index expected, const char* what) const {
    if (found == expected) return;
    walk_.fail(fmt::format("a point has {} {}, expected {}", found, what, expected));
  }

  const Unpacker& walk_;
  const BranchLayout& layout_;
};

}  // namespace

void write_branches(ResultWriter& file, const BranchTree& tree, BranchResult result) {
  Packer walk;
  for (const TracedBranch& b : tree.branches) pack_traced(walk, b);
  result.walk = walk.numbers();
  write_result(file, result);
  write_walk_format(file, BranchResult::group);
}

BranchTree read_branches(const ResultReader& file, BranchTree empty) {
  const auto stored = read_result<BranchResult>(file);
  BranchLayout& layout = empty.layout;
  layout.harmonics = stored.harmonics.value_or(layout.harmonics);
  Unpacker walk = read_walk(file, BranchResult::group, stored.walk);
  const PointCheck points(walk, layout);
  auto grazing = stored.bifurcations.begin();
  auto orbit = stored.points.begin();
  for (const BranchRow& row : stored.branches) {
    TracedBranch& b = empty.branches.emplace_back();
    b.branch.end = row.branch_end();
    pack_traced(walk, b);
    points.check(b.branch, layout.harmonics > 0 ? 0
                           : layout.is_rotating ? layout.states + 2
                                                : layout.states * b.branch.period + 1);
    points.check(b.starts);
    points.check(b.measures);
    for (OrbitMeasure& measure : b.measures) {
      if (orbit != stored.points.end()) {
        measure.probe_peak_to_peak = (orbit++)->probe_peak_to_peak;
      }
    }
    for (Bifurcation& x : b.branch.bifurcations) {
      if (grazing != stored.bifurcations.end()) x.contact = (grazing++)->contact;
    }
  }
  walk.finish();
  return empty;
}

void write_curves(ResultWriter& file, const BifurcationCurves& curves, CurveResult result) {
  if (curves.curves.empty()) return;
  Packer walk;
  for (const BifurcationCurve& c : curves.curves) pack_curve(walk, c);
  result.walk = walk.numbers();
  write_result(file, result);
  write_walk_format(file, CurveResult::group);
}

BifurcationCurves read_curves(const ResultReader& file, const BranchLayout& layout) {
  const auto stored = read_result<CurveResult>(file);
  if (stored.walk.empty()) return {};
  Unpacker walk = read_walk(file, CurveResult::group, stored.walk);
  const PointCheck points(walk, layout);
  BifurcationCurves curves;
  for (const CurveRow& row : stored.curves) {
    BifurcationCurve& c = curves.curves.emplace_back();
    c.branch.end = row.branch_end();
    c.contact = row.contact;
    pack_curve(walk, c);
    points.check(c.branch, layout.states * c.branch.period + 2);
  }
  walk.finish();
  return curves;
}

}  // namespace whirl::inline io

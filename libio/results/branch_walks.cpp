#include "libio/results/branch_walks.hpp"

#include <fmt/format.h>

#include "libbase/constants.hpp"
#include "libio/results/branch_ends.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/packed_branch.hpp"

namespace whirl::inline io {

namespace {

/// What a branch of a tree and a curve have in common.
void pack_branch(auto& in, auto& branch, auto& measures, auto& starts) {
  in.size(branch.points);
  in.size(branch.bifurcations);
  in.resize(measures, branch.points.size());
  in.resize(starts, branch.points.size());
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    pack_point(in, branch.points[i]);
    in(measures[i].radii), in(measures[i].work), in(measures[i].sections);
    in(starts[i]);
  }
  for (auto& x : branch.bifurcations) {
    pack_point(in, x.at);
    in(x.kind), in(x.after), in(x.change), in(x.multiplier);
  }
}

void pack(auto& in, auto& b, auto& number, auto& generation, auto& kind) {
  in(b.branch.period), in(number), in(generation), in(b.direction), in(kind);
}

void pack_traced(auto& in, auto& traced) {
  auto kind = BifurcationKind::fold;  // only curves have one
  pack(in, traced, traced.parent, traced.generation, kind);
  pack_branch(in, traced.branch, traced.measures, traced.starts);
}

/// Nothing of a curve is measured.
void pack_curve(auto& in, auto& curve) {
  int generation = 0;
  std::vector<OrbitMeasure> measures(curve.branch.points.size());
  std::vector<Vec> starts(curve.branch.points.size());
  pack(in, curve, curve.branch_number, generation, curve.kind);
  pack_branch(in, curve.branch, measures, starts);
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

/// As many branches as there are ends.
template <class Traced>
std::vector<Traced> ended_branches(const ResultReader& file, const std::string& group) {
  std::vector<Traced> branches;
  for (auto& end : read_ends(file, group)) branches.emplace_back().branch.end = std::move(end);
  return branches;
}

/// Contacts of the bifurcations, which are texts.
template <class Traced>
void name_contacts(const ResultReader& file, const std::string& group,
                   std::vector<Traced>& branches) {
  std::vector<std::string> grazing;
  if (file.has(group + "/bifurcation_contact")) {
    grazing = file.strings(group + "/bifurcation_contact");
  }
  std::size_t known = 0;
  for (Traced& b : branches) {
    for (Bifurcation& x : b.branch.bifurcations) {
      x.contact = known < grazing.size() ? grazing[known] : "";
      ++known;
    }
  }
}

}  // namespace

void write_branch_walk(ResultWriter& file, const std::string& group,
                       const std::vector<TracedBranch>& branches) {
  Packer walk;
  for (const TracedBranch& b : branches) pack_traced(walk, b);
  write_walk(file, group, walk);
}

void write_curve_walk(ResultWriter& file, const std::string& group,
                      const std::vector<BifurcationCurve>& curves) {
  Packer walk;
  for (const BifurcationCurve& c : curves) pack_curve(walk, c);
  write_walk(file, group, walk);
}

std::vector<TracedBranch> read_branch_walk(const ResultReader& file, const std::string& group,
                                           const BranchLayout& layout) {
  Unpacker walk = read_walk(file, group);
  const PointCheck points(walk, layout);
  auto branches = ended_branches<TracedBranch>(file, group);
  for (TracedBranch& b : branches) {
    pack_traced(walk, b);
    points.check(b.branch, layout.harmonics > 0 ? 0
                           : layout.is_rotating ? layout.states + 2
                                                : layout.states * b.branch.period + 1);
    points.check(b.starts);
    points.check(b.measures);
  }
  walk.finish();
  name_contacts(file, group, branches);
  return branches;
}

std::vector<BifurcationCurve> read_curve_walk(const ResultReader& file, const std::string& group,
                                              const BranchLayout& layout) {
  Unpacker walk = read_walk(file, group);
  const PointCheck points(walk, layout);
  auto curves = ended_branches<BifurcationCurve>(file, group);
  const std::vector<std::string> contacts = file.strings(group + "/contact");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    pack_curve(walk, curves[i]);
    points.check(curves[i].branch, layout.states * curves[i].branch.period + 2);
    curves[i].contact = contacts.at(i);
  }
  walk.finish();
  name_contacts(file, group, curves);
  return curves;
}

}  // namespace whirl::inline io

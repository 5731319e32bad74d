#include "libio/results/branch_results.hpp"

#include <algorithm>

#include "libbase/constants.hpp"
#include "libio/results/branch_ends.hpp"
#include "libio/results/branch_walks.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/row_datasets.hpp"

namespace whirl::inline io {

namespace {

const std::string branch_group = "/branch";

std::string branch_path(const char* name) {
  return branch_group + "/" + name;
}

/// A point of a tree, or a bifurcation.
struct TreePoint {
  int number;  ///< of its branch, from 1
  const TracedBranch* of;
  std::size_t i;  ///< on its branch

  const BranchPoint& point() const { return of->branch.points[i]; }
  const OrbitMeasure& measure() const { return of->measures[i]; }
};
struct TreeBifurcation {
  int number;  ///< of its branch, from 1
  const Bifurcation* at;
};

std::vector<TreePoint> points_of(const BranchTree& tree) {
  std::vector<TreePoint> rows;
  int number = 0;
  for (const TracedBranch& b : tree.branches) {
    ++number;
    for (std::size_t i = 0; i < b.branch.points.size(); ++i) rows.push_back({number, &b, i});
  }
  return rows;
}

std::vector<TreeBifurcation> bifurcations_of(const BranchTree& tree) {
  std::vector<TreeBifurcation> rows;
  int number = 0;
  for (const TracedBranch& b : tree.branches) {
    ++number;
    for (const Bifurcation& x : b.branch.bifurcations) rows.push_back({number, &x});
  }
  return rows;
}

int stability_code(const BranchPoint& p) {
  if (p.multipliers.size() == 0) return -1;
  return p.is_stable() ? 1 : 0;
}

void write_tree_list(ResultWriter& file, const BranchTree& tree) {
  const RowDatasets rows(file, tree.branches, branch_path("number"));
  rows.numbers("branch");
  rows.one(branch_path("period"), {"", "period [revolutions]"},
           [](const TracedBranch& b) { return b.branch.period; });
  rows.one(branch_path("parent"), {"", "branch that it begins on; 0: none"},
           [](const TracedBranch& b) { return b.parent; });
  std::vector<std::optional<BranchEnd>> ends;
  for (const TracedBranch& b : tree.branches) ends.push_back(b.branch.end);
  write_ends(file, branch_group, branch_path("number"), ends);
}

/// Where the stations are once a revolution, as a sweep has it: NaN beyond the period.
void write_sections(const RowDatasets<TreePoint>& points, Eigen::Index stations) {
  Eigen::Index longest = 0;
  for (const TreePoint& r : points.rows()) {
    longest = std::max(longest, r.measure().sections.cols());
  }
  if (longest == 0) return;
  for (const Eigen::Index component : {0, 1}) {
    points.many(
        branch_path(component == 0 ? "poincare_x" : "poincare_y"),
        {"m", component == 0 ? "x at phase 0" : "y at phase 0", {branch_path("station"), ""}},
        {stations, longest}, [&](const TreePoint& r) {
          const Mat& sections = r.measure().sections;
          std::vector<double> values;
          for (Eigen::Index s = 0; s < stations; ++s) {
            for (Eigen::Index k = 0; k < longest; ++k) {
              values.push_back(k < sections.cols() ? sections(2 * s + component, k) : nan);
            }
          }
          return values;
        });
  }
}

void write_stations(ResultWriter& file, const RowDatasets<TreePoint>& points,
                    const std::vector<std::string>& stations) {
  if (stations.empty()) return;
  file.dataset(branch_path("station"), stations, {"", "station", {""}});
  points.many(branch_path("max_radius"),
              {"m", "largest distance from the axis", {branch_path("station")}},
              {std::ssize(stations)}, [](const TreePoint& r) { return r.measure().radii; });
  write_sections(points, std::ssize(stations));
}

void write_contacts(ResultWriter& file, const RowDatasets<TreePoint>& points,
                    const BranchLayout& layout) {
  if (layout.contacts.empty()) return;
  file.dataset(branch_path("contact"), layout.contacts, {"", "contact", {""}});
  const auto put = [&](const char* name, const char* unit, const char* meaning, auto&& number) {
    points.many(branch_path(name), {unit, meaning, {branch_path("contact")}},
                {std::ssize(layout.contacts)}, [&](const TreePoint& r) {
                  std::vector<double> values;
                  for (const ContactMeasure& c : r.point().contacts) values.push_back(number(r, c));
                  return values;
                });
  };
  using Measure = ContactMeasure;
  put("duty", "", "share of time in touch",
      [](const TreePoint&, const Measure& c) { return c.duty; });
  put("impacts_per_rev", "", "impacts per revolution", [&](const TreePoint& r, const Measure& c) {
    return c.impacts / layout.period(r.of->branch, r.point());
  });
  put("max_normal", "N", "largest normal force",
      [](const TreePoint&, const Measure& c) { return c.max_normal; });
  put("max_tangential", "N", "largest friction force",
      [](const TreePoint&, const Measure& c) { return c.max_tangential; });
}

void write_points(ResultWriter& file, const BranchTree& tree, const BranchNames& names) {
  const BranchLayout& layout = tree.layout;
  const RowDatasets points(file, points_of(tree), branch_path("value"));
  points.axis({names.unit, names.path}, [](const TreePoint& r) { return r.point().value; });
  file.attribute(branch_group, "parameter", names.path);
  points.one(branch_path("branch"), {"", "branch of a point"},
             [](const TreePoint& r) { return r.number; });
  points.one(branch_path("stable"), {"", "1 stable, 0 unstable, -1 not known"},
             [](const TreePoint& r) { return stability_code(r.point()); });
  points.one(branch_path("revolutions"), {"", "period [revolutions]"},
             [&](const TreePoint& r) { return layout.period(r.of->branch, r.point()); });
  points.one(branch_path("work"), {"J", "work of the unbalance per revolution"},
             [](const TreePoint& r) { return r.measure().work; });
  points.one(branch_path("residual"), {"", "residual of the orbit [length scales]"},
             [](const TreePoint& r) { return r.point().residual; });
  points.many(branch_path("state"),
              {"", "reduced state at phase 0, in the basis of the first value", {""}},
              {layout.states}, [](const TreePoint& r) { return r.of->starts[r.i]; });
  points.complex(branch_path("multiplier"),
                 {"", "Floquet multipliers of the period, the largest first", {""}}, layout.states,
                 [](const TreePoint& r) { return r.point().multipliers; });
  write_stations(file, points, names.stations);
  write_contacts(file, points, layout);
}

void write_bifurcations(ResultWriter& file, const BranchTree& tree, const BranchNames& names) {
  using Row = TreeBifurcation;
  const RowDatasets rows(file, bifurcations_of(tree), branch_path("bifurcation"));
  if (rows.rows().empty()) return;
  rows.axis({names.unit, names.path}, [](const Row& r) { return r.at->at.value; });
  rows.one(branch_path("bifurcation_kind"), {"", "kind"},
           [](const Row& r) { return std::string(name_of(r.at->kind)); });
  rows.one(branch_path("bifurcation_branch"), {"", "branch"},
           [](const Row& r) { return r.number; });
  rows.one(branch_path("bifurcation_after"), {"", "number of the point before"},
           [](const Row& r) { return static_cast<int>(r.at->after) + 1; });
  rows.one(branch_path("bifurcation_contact"), {"", "contact that grazes"},
           [](const Row& r) { return r.at->contact; });
  rows.one(branch_path("bifurcation_change"), {"", "change of its impacts a period"},
           [](const Row& r) { return r.at->change; });
  rows.complex(branch_path("bifurcation_multiplier"), {"", "critical multiplier"},
               [](const Row& r) { return r.at->multiplier; });
}

}  // namespace

void write_branches(ResultWriter& file, const BranchTree& tree, const BranchNames& names) {
  write_tree_list(file, tree);
  write_points(file, tree, names);
  write_bifurcations(file, tree, names);
  write_branch_walk(file, branch_group, tree.branches);
  file.attribute(branch_group, "complete", tree.is_complete() ? 1 : 0);
  if (tree.layout.harmonics > 0) file.attribute(branch_group, "harmonics", tree.layout.harmonics);
}

BranchTree read_branches(const ResultReader& file, BranchTree empty) {
  if (file.has_attribute(branch_group, "harmonics")) {
    empty.layout.harmonics = static_cast<int>(file.number_attribute(branch_group, "harmonics"));
  }
  empty.branches = read_branch_walk(file, branch_group, empty.layout);
  return empty;
}

}  // namespace whirl::inline io

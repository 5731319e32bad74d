// Branches and curves in result files: the same again, and damage told with its place.

#include "libio/results/branch_results.hpp"

#include <cmath>

#include "libio/results/columns.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::branch_results_test {

using test::problem_of;

class BranchResults : public test::InResultFolder {};

BranchPoint point(double value, Eigen::Index unknowns) {
  BranchPoint p{.value = value};
  p.z = Vec::LinSpaced(unknowns, -0.5, value);
  p.tangent = Vec::Unit(unknowns, 0);
  p.multipliers = CVec{{Complex(0.5, 0.25), Complex(0.5, -0.25)}};
  p.contacts = {{.name = "ring", .duty = 0.25, .impacts = 7.0 * value}};
  return p;
}

/// Two branches, the second one of twice the period and not at its end.
BranchTree example() {
  BranchTree tree{.layout = {.states = 2, .scale = Vec::Ones(2), .contacts = {"ring"}}};
  tree.layout.probes = ProbeLabels({{.name = "1X", .angle = 0.5}});
  OrbitMeasure measure{.radii = {1e-3}, .work = 2.0, .probe_peak_to_peak = {3e-3}};
  measure.sections = Mat{{0.1, 0.2}, {0.3, 0.4}};
  TracedBranch first{.branch = {.period = 1, .points = {point(0.1, 3), point(0.2, 3)}}};
  first.branch.bifurcations = {
      {.kind = BifurcationKind::grazing, .at = point(0.15, 3), .contact = "ring", .change = 1.0}};
  first.branch.end = BranchEnd{EndKind::range, "the end of the range"};
  first.measures = {measure, measure};
  first.starts = {Vec::Ones(2), Vec::Zero(2)};
  TracedBranch second{.branch = {.period = 2, .points = {point(0.15, 5)}},
                      .parent = 1,
                      .generation = 1,
                      .direction = -1.0,
                      .measures = {measure},
                      .starts = {Vec::Ones(2)}};
  tree.branches = {first, second};
  return tree;
}

void write(const std::filesystem::path& path, const BranchTree& tree) {
  ResultWriter out(path, Replaces::anything);
  write_branches(out, tree, branch_result(tree, {"bearing.left.stiffness", "N/m"}, {"rotor"}));
  out.commit();
}

TEST_F(BranchResults, AreTheSameAgain) {
  const BranchTree tree = example();
  write(path, tree);
  const ResultReader in(path);
  EXPECT_EQ(in.number_attribute("/branch", "complete"), 0.0);
  EXPECT_EQ(in.shape("/branch/poincare_x"), (std::vector<Eigen::Index>{3, 1, 2}));
  const BranchTree again = read_branches(in, {.layout = tree.layout});
  ASSERT_EQ(again.branches.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const TracedBranch &x = again.branches[k], &y = tree.branches[k];
    EXPECT_EQ(x.branch.period, y.branch.period);
    EXPECT_EQ(x.parent, y.parent);
    EXPECT_EQ(x.generation, y.generation);
    EXPECT_EQ(x.direction, y.direction);
    EXPECT_EQ(x.branch.end_text(), y.branch.end_text());
    ASSERT_EQ(x.branch.points.size(), y.branch.points.size());
    for (std::size_t i = 0; i < x.branch.points.size(); ++i) {
      EXPECT_EQ(x.branch.points[i].z, y.branch.points[i].z);
      EXPECT_EQ(x.branch.points[i].multipliers, y.branch.points[i].multipliers);
      EXPECT_EQ(x.branch.points[i].contacts[0].name, "ring");
      EXPECT_EQ(x.measures[i].sections, y.measures[i].sections);
      EXPECT_EQ(x.measures[i].probe_peak_to_peak, y.measures[i].probe_peak_to_peak);
      EXPECT_EQ(x.starts[i], y.starts[i]);
    }
  }
  EXPECT_TRUE(again.branches[0].branch.ends_as(EndKind::range));
  EXPECT_FALSE(again.branches[1].branch.end);
  const Bifurcation& b = again.branches[0].branch.bifurcations.at(0);
  EXPECT_EQ(b.kind, BifurcationKind::grazing);
  EXPECT_EQ(b.contact, "ring");
}

TEST_F(BranchResults, CurvesAreTheSameAgain) {
  BifurcationCurves curves;
  curves.curves = {{.kind = BifurcationKind::fold,
                    .branch_number = 3,
                    .direction = -1.0,
                    .branch = {.period = 1, .points = {point(5.0, 4)}}}};
  ResultWriter out(path, Replaces::anything);
  write_curves(out, curves, curve_result(curves, {"a", "N"}, {.low = 0.0, .high = 2.0}, {"b", ""}));
  out.commit();
  const ResultReader in(path);
  EXPECT_EQ(in.numbers("/border/first")[0], 2.0 * point(5.0, 4).z(2));
  EXPECT_EQ(in.numbers("/border/second")[0], 5.0);
  const BifurcationCurves again = read_curves(in, example().layout);
  ASSERT_EQ(again.curves.size(), 1u);
  EXPECT_EQ(again.curves[0].kind, BifurcationKind::fold);
  EXPECT_EQ(again.curves[0].branch_number, 3);
  EXPECT_EQ(again.curves[0].direction, -1.0);
  EXPECT_EQ(again.curves[0].branch.points[0].z, curves.curves[0].branch.points[0].z);
}

// What the parameter is and its unit are those of the call, and come back; so does what a row says.
TEST_F(BranchResults, KnowTheirParameters) {
  write(path, example());
  const ResultReader in(path);
  EXPECT_EQ(in.string_attribute("/branch/value", "units"), "N/m");
  EXPECT_EQ(in.string_attribute("/branch/value", "long_name"), "bearing.left.stiffness");
  EXPECT_EQ(in.string_attribute("/branch/bifurcation", "units"), "N/m");
  EXPECT_EQ(in.axes("/branch/max_radius"),
            (std::vector<std::string>{"/branch/value", "/branch/station"}));
  EXPECT_FALSE(in.has_attribute("/branch", "harmonics"));
  const auto again = read_result<BranchResult>(in);
  EXPECT_EQ(again.parameter.path, "bearing.left.stiffness");
  EXPECT_EQ(again.parameter.unit, "N/m");
  EXPECT_FALSE(again.harmonics);
  ASSERT_EQ(again.points.size(), 3u);
  EXPECT_EQ(again.points[1].sections_y, (Mat{{0.3, 0.4}}));
  EXPECT_EQ(again.points[2].known_multipliers(),
            example().branches[0].branch.points[0].multipliers);
  EXPECT_EQ(again.points[0].impacts, std::vector<double>{7.0 * 0.1});
  EXPECT_EQ(record_of(again.branches[1]).json(),
            "{\"period_revs\": 2, \"parent\": 1, \"end\": \"\", \"end_kind\": null}\n");
}

// Files of before say nothing of probes; what is walked on from them says it of new points.
TEST_F(BranchResults, GoOnWithoutReadingsOfProbes) {
  BranchTree tree = example();
  tree.layout.probes = {};
  for (TracedBranch& traced : tree.branches) {
    for (OrbitMeasure& m : traced.measures) m.probe_peak_to_peak.clear();
  }
  write(path, tree);
  EXPECT_FALSE(ResultReader(path).has("/branch/probe_peak_to_peak"));
  BranchTree again = read_branches(ResultReader(path), {.layout = example().layout});
  again.branches[1].branch.points.push_back(point(0.16, 5));
  again.branches[1].measures.push_back(example().branches[0].measures[0]);
  again.branches[1].starts.emplace_back(Vec::Ones(2));
  write(path, again);
  const auto result = read_result<BranchResult>(ResultReader(path));
  EXPECT_EQ(result.probes.names, std::vector<std::string>{"1X"});
  ASSERT_EQ(result.points.size(), 4u);
  EXPECT_TRUE(std::isnan(result.points[2].probe_peak_to_peak[0]));
  EXPECT_EQ(result.points[3].probe_peak_to_peak[0], 3e-3);
}

// Rows of bifurcations, of which there may be none, say it too.
TEST_F(BranchResults, KnowTheirParametersWithoutABifurcation) {
  BranchTree tree = example();
  for (TracedBranch& traced : tree.branches) traced.branch.bifurcations.clear();
  write(path, tree);
  const auto again = read_result<BranchResult>(ResultReader(path));
  EXPECT_TRUE(again.bifurcations.empty());
  EXPECT_EQ(again.parameter.path, "bearing.left.stiffness");
  EXPECT_EQ(again.parameter.unit, "N/m");
}

// A walk of other sizes than the model has, or of a later version, is refused.
TEST_F(BranchResults, TellWhatDoesNotFit) {
  const auto problem = [&](const BranchTree& written, const BranchLayout& asked) {
    write(path, written);
    return problem_of([&] { read_branches(ResultReader(path), {.layout = asked}); });
  };
  const BranchTree tree = example();
  EXPECT_EQ(problem(tree, tree.layout), "none");
  BranchLayout other = tree.layout;
  other.states = 4;
  EXPECT_EQ(
      problem(tree, other),
      "/branch/walk: a point has 3 unknowns, expected 5: it is damaged, or of another version "
      "or study");
  other = tree.layout;
  other.contacts = {};
  EXPECT_NE(problem(tree, other).find("a point has 1 contacts, expected 0"), std::string::npos);
  BranchTree damaged = tree;
  damaged.branches[0].branch.bifurcations[0].after = 7;
  EXPECT_NE(problem(damaged, tree.layout).find("a bifurcation is of no kind"), std::string::npos);
  damaged = tree;
  damaged.branches[1].branch.points[0].tangent = Vec();
  EXPECT_NE(problem(damaged, tree.layout).find("0 numbers of its tangent"), std::string::npos);
}

}  // namespace whirl::branch_results_test

// Balancing: influence coefficients from runs, correction weights and what they leave, weights in
// holes, grades, and how sure all of them are.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdata/balancing/confidence.hpp"
#include "libdata/balancing/correction.hpp"
#include "libdata/balancing/holes.hpp"
#include "libdata/balancing/influence.hpp"
#include "libdata/balancing/quality_grade.hpp"

namespace whirl::balancing_test {

Complex at(double size, double angle_in_degrees) {
  return std::polar(size, angle_in_degrees * degree);
}
CVec list(std::initializer_list<Complex> values) {
  CVec v(std::ssize(values));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}
/// A difference of angles, in degrees, that knows no whole turns.
double apart(Complex value, double angle_in_degrees) {
  return std::arg(value * at(1.0, -angle_in_degrees)) / degree;
}
CorrectionProblem problem_of(const CMat& A, const CVec& V,
                             BalancingCriterion criterion = BalancingCriterion::least_squares) {
  return {A, V, Vec::Ones(V.size()), Vec::Constant(A.cols(), INFINITY), criterion};
}

// ---- influence coefficients ---------------------------------------------------------------------

// One plane, V0 5 at 40 deg, a trial weight 10 at 30 deg gives 7 at 100 deg: (V1 - V0) / w by hand.
TEST(Influence, OfOnePlaneIsTheChangeOverTheWeight) {
  const auto lines = influence_lines({{"first", list({0.0}), list({at(5, 40)})},
                                      {"trial", list({at(10, 30)}), list({at(7, 100)})}},
                                     {"one"});
  ASSERT_EQ(lines.size(), 1u);
  const Complex a = lines[0].coefficients(0);
  EXPECT_NEAR(std::abs(a), 0.6244998, 1e-7);
  EXPECT_NEAR(apart(a, 113.89789), 0.0, 1e-5);
  const Correction found = correct(problem_of(list({a}), list({lines[0].start})), {"one"});
  EXPECT_NEAR(std::abs(found.weights(0)), 8.006408, 1e-6);
  EXPECT_NEAR(apart(found.weights(0), 106.10211), 0.0, 1e-5);
  EXPECT_NEAR(found.objective, 0.0, 1e-14);
}

// Two planes and two probes: the runs and angles of the example in the manual of hsbalance 0.9,
// in the notation of [Goodman1964]; coefficients and weights by an independent program.
const std::vector<BalancingRun> two_planes{
    {"first", list({0.0, 0.0}), list({at(170, 112), at(53, 78)})},
    {"A", list({at(1.15, 0), 0.0}), list({at(235, 94), at(58, 68)})},
    {"B", list({0.0, at(1.15, 0)}), list({at(185, 115), at(77, 104)})}};

TEST(Influence, OfTwoPlanesIsThatOfAnIndependentProgram) {
  const auto lines = influence_lines(two_planes, {"A", "B"});
  constexpr double digits = 2e-6;  // that are printed
  EXPECT_NEAR(std::abs(lines[0].coefficients(0) - at(78.432586, 58.37901)), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(lines[0].coefficients(1) - at(15.339935, 145.28788)), 0.0, 2 * digits);
  EXPECT_NEAR(std::abs(lines[1].coefficients(0) - at(9.461970, 10.24245)), 0.0, digits);
  EXPECT_NEAR(std::abs(lines[1].coefficients(1) - at(32.559882, 142.35217)), 0.0, 4 * digits);
  CMat A(2, 2);
  A << lines[0].coefficients.transpose(), lines[1].coefficients.transpose();
  const Correction found =
      correct(problem_of(A, list({lines[0].start, lines[1].start})), {"A", "B"});
  EXPECT_NEAR(std::abs(found.weights(0)), 1.979468, 1e-6);
  EXPECT_NEAR(apart(found.weights(0), 236.17037), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(found.weights(1)), 1.070509, 1e-6);
  EXPECT_NEAR(apart(found.weights(1), 121.84390), 0.0, 1e-5);
  EXPECT_NEAR(found.left.norm(), 0.0, 1e-12);
}

// Trial weights that stay, several at once, and further runs change nothing of a linear rotor.
TEST(Influence, IsTheSameWhetherTrialWeightsStayOrNot) {
  CMat A(3, 2);
  A << Complex(2, 1), Complex(.5, -1), Complex(1, -2), Complex(3, .5), Complex(-1, 1),
      Complex(2, -2);
  const CVec V = list({Complex(10, 5), Complex(-4, 12), Complex(6, -3)});
  std::vector<BalancingRun> runs;
  for (const CVec& w : {list({0.0, 0.0}), list({at(2, 30), 0.0}), list({at(2, 30), at(1, -70)}),
                        list({at(1, 80), at(3, 10)})}) {
    runs.push_back({"run", w, V + A * w});
  }
  const auto lines = influence_lines(runs, {"A", "B"});
  for (Eigen::Index j = 0; j < 3; ++j) {
    const InfluenceLine& line = lines[static_cast<std::size_t>(j)];
    EXPECT_NEAR((line.coefficients - A.row(j).transpose()).norm(), 0.0, 1e-13);
    EXPECT_NEAR(std::abs(line.start - V(j)), 0.0, 1e-13);
    EXPECT_EQ(line.spare, 1);
  }
  EXPECT_NEAR(nonlinearity(lines, runs, Vec::Ones(3)), 0.0, 1e-14);
  runs.back().readings(1) += 3.0;
  EXPECT_GT(nonlinearity(influence_lines(runs, {"A", "B"}), runs, Vec::Ones(3)), 0.01);
}

TEST(Influence, SaysWhichPlaneHasNoRun) {
  const auto message = [](const std::vector<BalancingRun>& runs) {
    try {
      influence_lines(runs, {"fan", "pump"});
    } catch (const OptionError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const BalancingRun first{"first", list({0.0, 0.0}), list({1.0})};
  const BalancingRun fan{"fan", list({1.0, 0.0}), list({2.0})};
  const BalancingRun both{"both", list({1.0, 1.0}), list({3.0})};
  const BalancingRun more{"more", list({2.0, 2.0}), list({5.0})};
  EXPECT_NE(message({first, fan}).find("no run has a trial weight in plane pump"),
            std::string::npos);
  EXPECT_NE(message({first, both, more}).find("do not tell what a weight in plane"),
            std::string::npos);
  EXPECT_EQ(message({first, fan, both}), "nothing");
}

// ---- corrections --------------------------------------------------------------------------------

// Three readings, two planes: weights by an independent program, by numpy and by SLSQP.
CorrectionProblem three_readings(BalancingCriterion criterion) {
  CMat A(3, 2);
  A << Complex(2, 1), Complex(.5, -1), Complex(1, -2), Complex(3, .5), Complex(-1, 1),
      Complex(2, -2);
  return problem_of(A, list({Complex(10, 5), Complex(-4, 12), Complex(6, -3)}), criterion);
}

TEST(Correction, OfLeastSquaresIsThatOfAnIndependentProgram) {
  const Correction found = correct(three_readings(BalancingCriterion::least_squares), {"A", "B"});
  EXPECT_NEAR(std::abs(found.weights(0)), .435988, 1e-6);
  EXPECT_NEAR(apart(found.weights(0), 251.46219), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(found.weights(1)), 3.180977, 1e-6);
  EXPECT_NEAR(apart(found.weights(1), 259.59945), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(found.left(0)), 7.377784, 1e-6);
  EXPECT_NEAR(std::abs(found.left(1)), 5.572400, 1e-6);
  EXPECT_NEAR(std::abs(found.left(2)), 7.880564, 1e-6);
  EXPECT_NEAR(found.objective / std::sqrt(3.0), 7.013953561, 1e-9);
}

TEST(Correction, OfMinMaxLeavesThreeEqualReadings) {
  const Correction found = correct(three_readings(BalancingCriterion::min_max), {"A", "B"});
  constexpr double digits = 1e-9;
  for (Eigen::Index j = 0; j < 3; ++j)
    EXPECT_NEAR(std::abs(found.left(j)), 7.085037483, 2 * digits);
  EXPECT_NEAR(found.objective, 7.085037483, digits);
  EXPECT_NEAR(found.bound, 7.085037483, digits);
  EXPECT_LE(found.bound, found.objective);
  EXPECT_NEAR(std::abs(found.weights(0)), .647867, 1e-5);
  EXPECT_NEAR(apart(found.weights(0), 237.78472), 0.0, 1e-3);
  EXPECT_NEAR(std::abs(found.weights(1)), 3.096853, 1e-5);
  EXPECT_NEAR(apart(found.weights(1), 253.99633), 0.0, 1e-3);
}

// One plane that all readings follow alike: the best weight within a limit points along the best
// one without it, V + a w = (V_0 - |a| limit) in size.
TEST(Correction, StopsAtALimitInTheDirectionOfTheBestWeight) {
  for (const auto criterion : {BalancingCriterion::least_squares, BalancingCriterion::min_max}) {
    CorrectionProblem p =
        problem_of(list({at(2, 20), at(2, 20)}), list({at(10, 50), at(10, 50)}), criterion);
    p.limit(0) = 3.0;
    const Correction found = correct(p, {"one"});
    EXPECT_NEAR(std::abs(found.weights(0) - at(3.0, 210)), 0.0, 1e-6);
    EXPECT_LE(std::abs(found.weights(0)), 3.0);
    EXPECT_NEAR(std::abs(found.left(0)), 4.0, 1e-9);
    EXPECT_NEAR(found.bound, found.objective, 1e-9 * found.objective);
    p.limit(0) = 5.5;  // beyond the best weight, which leaves nothing
    EXPECT_NEAR(correct(p, {"one"}).objective, 0.0, 1e-13);
  }
}

// Random problems: what is left is never more than what nearby weights within the limits leave, is
// proven, and a weighted problem is that of weighted rows.
TEST(Correction, OfRandomProblemsIsProvenToBeTheBest) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Complex(normal(random), normal(random)); };
  for (int number = 0; number < 40; ++number) {
    const Eigen::Index n = 1 + number % 4, m = n + 1 + number % 5;
    CorrectionProblem p = problem_of(CMat(m, n), CVec(m));
    for (Eigen::Index j = 0; j < m; ++j) {
      p.V(j) = 1e-5 * draw();
      p.weight(j) = 0.5 + std::abs(normal(random));
      for (Eigen::Index k = 0; k < n; ++k) p.A(j, k) = 1e-3 * draw();
    }
    if (number % 3 == 1) p.limit(0) = 2e-3;
    if (number % 3 == 2) p.limit.setConstant(1e-3);
    p.criterion = number % 2 ? BalancingCriterion::min_max : BalancingCriterion::least_squares;
    const std::vector<std::string> planes(static_cast<std::size_t>(n), "plane");
    const Correction found = correct(p, planes);
    EXPECT_LE(found.objective - found.bound, 1e-8 * found.objective) << number;
    EXPECT_TRUE((found.weights.cwiseAbs().array() <= p.limit.array() * (1 + 1e-12)).all());
    for (int other = 0; other < 50; ++other) {
      CVec w = found.weights;
      for (Eigen::Index k = 0; k < n; ++k) {
        w(k) += 1e-4 * draw();
        if (std::abs(w(k)) > p.limit(k)) w(k) *= p.limit(k) / std::abs(w(k));
      }
      const Vec left = p.weight.cwiseProduct((p.V + p.A * w).cwiseAbs());
      EXPECT_GE(number % 2 ? left.maxCoeff() : left.norm(), found.bound);
    }
  }
}

TEST(Correction, SaysWhichPlanesDoTheSame) {
  CMat A(3, 2);
  A << 1.0, 2.0, Complex(0, 1), Complex(0, 2), 3.0, 6.0;
  EXPECT_THROW(correct(problem_of(A, list({1.0, 2.0, 3.0})), {"fan", "pump"}), OptionError);
  EXPECT_THROW(correct(problem_of(A.topRows(1), list({1.0})), {"fan", "pump"}), OptionError);
}

// ---- holes --------------------------------------------------------------------------------------

Vec degrees(std::initializer_list<double> values) {
  Vec v(std::ssize(values));
  std::copy(values.begin(), values.end(), v.begin());
  return v * degree;
}
Complex sum_in(const BalancingHoles& holes, const Vec& masses) {
  Complex sum = 0.0;
  for (Eigen::Index i = 0; i < masses.size(); ++i) sum += std::polar(masses(i), holes.angles(i));
  return sum;
}

// The sine rule: m_1 = m sin(17.5 deg) / sin(22.5 deg), m_2 = m sin(5 deg) / sin(22.5 deg).
TEST(Holes, TwoNeighborsShareAWeightAfterTheSineRule) {
  BalancingHoles holes;
  holes.angles = Vec::LinSpaced(16, 0.0, 337.5) * degree;
  const Vec masses = split_over_holes(holes, at(10, 50));
  EXPECT_NEAR(masses(2), 7.85782122, 1e-8);
  EXPECT_NEAR(masses(3), 2.27748931, 1e-8);
  EXPECT_NEAR(masses.sum(), 7.85782122 + 2.27748931, 2e-8);
}

// Holes that carry 4 at most: their neighbors take the rest, and the total is that of a linear
// programme over all of them, here by symmetry: 4 at 0 deg and m at +-30 deg each.
TEST(Holes, NeighborsTakeWhatAHoleCannotCarry) {
  BalancingHoles holes{.angles = degrees({0, 30, 60, 90, 180, 270, 300, 330}), .most = 4.0};
  const Vec masses = split_over_holes(holes, at(10, 0));
  const double m = 6.0 / (2.0 * std::cos(30 * degree));
  EXPECT_NEAR(masses(0), 4.0, 1e-12);
  EXPECT_NEAR(masses(1), m, 1e-12);
  EXPECT_NEAR(masses(7), m, 1e-12);
  // more than all of them can carry: those on its side are full
  EXPECT_NEAR(std::abs(sum_in(holes, split_over_holes(holes, at(100, 0)))),
              4.0 * (1.0 + std::sqrt(3.0) + 1.0), 1e-12);
  // none on its side
  holes = {.angles = degrees({80, 100})};
  EXPECT_EQ(split_over_holes(holes, at(5, 270)).sum(), 0.0);
}

// Three holes, pieces of 1, 2 and 5, two to a hole, and all 729 ways to fill them: the fewest holes
// that come nearer than half of a piece, and where none do the nearest way.
TEST(Holes, PiecesGoIntoTheFewestHolesThatComeNear) {
  const BalancingHoles holes{
      .angles = degrees({10, 95, 200}), .pieces = {1, 2, 5}, .pieces_per_hole = 2};
  const std::vector<double> sums{0, 1, 2, 3, 4, 5, 6, 7, 10};
  for (const Complex weight :
       {at(8.3, 40), at(6.1, 155), at(11.7, 250), at(0.4, 20), at(5.2, 12)}) {
    double best = INFINITY;
    std::ptrdiff_t fewest = 4;
    for (const double a : sums)
      for (const double b : sums)
        for (const double c : sums) {
          const Eigen::Vector3d way(a, b, c);
          const double left = std::abs(weight - sum_in(holes, way));
          best = std::min(best, left);
          if (left <= 0.5) fewest = std::min(fewest, (way.array() > 0.0).count());
        }
    const Vec masses = split_over_holes(holes, weight);
    const double left = std::abs(weight - sum_in(holes, masses));
    if (fewest < 4) {
      EXPECT_LE(left, 0.5) << weight;
      EXPECT_EQ((masses.array() > 0.0).count(), fewest) << weight;
    } else {
      EXPECT_NEAR(left, best, 1e-12) << weight;
    }
  }
}

// 24 holes, 15 g in each at most: no weights that cancel each other.
TEST(Holes, PiecesAreLittleHeavierThanTheWeight) {
  BalancingHoles holes{.pieces = {1, 2, 5}, .pieces_per_hole = 3};
  holes.angles = Vec::LinSpaced(24, 0.0, 345.0) * degree;
  for (double angle = 0.0; angle < 360.0; angle += 7.0) {
    for (const double size : {0.7, 5.7, 22.8, 60.0}) {
      const Complex weight = at(size, angle);
      const Vec masses = split_over_holes(holes, weight);
      EXPECT_LE(std::abs(weight - sum_in(holes, masses)), 0.5) << weight;
      EXPECT_LE(masses.sum(), 1.25 * size + 1.0) << weight;
      EXPECT_LE((masses.array() > 0.0).count(), size > 50.0 ? 7 : 3) << weight;
    }
  }
}

// ---- grades -------------------------------------------------------------------------------------

// U = 1000 G m / Omega [g mm] of G2.5, 40 kg, 3000 rpm.
TEST(QualityGrade, IsTheFormulaOfTheStandard) {
  EXPECT_NEAR(permissible_unbalance(2.5e-3, 40.0, 3000.0 * rpm), 318.309886e-6, 1e-12);
  const auto shares = plane_shares(0.1, 0.9, 0.3);
  ASSERT_TRUE(shares);
  EXPECT_NEAR((*shares)[0], 0.7, 1e-12);  // 0.75, and no more than 0.7
  EXPECT_NEAR((*shares)[1], 0.3, 1e-12);
  EXPECT_NEAR((*plane_shares(0.0, 1.0, 0.4))[0], 0.6, 1e-12);
  EXPECT_FALSE(plane_shares(0.1, 0.9, 1.0));
}

// ---- how sure -----------------------------------------------------------------------------------

// Runs of a rotor with noise on every reading, many times: weights are as far from the true ones as
// is told in 95 % of them, with variances that are given and with those of a few spare runs, and a
// run with the weights reads what is predicted as often.
TEST(BalancingConfidence, HoldsNinetyFivePercent) {
  const CorrectionProblem truth = three_readings(BalancingCriterion::least_squares);
  const CVec best = correct(truth, {"A", "B"}).weights;
  std::mt19937 random(11);
  constexpr double sigma = 0.05;  // a small part of the vibration, as first order has it
  std::normal_distribution<double> normal(0.0, sigma / std::sqrt(2.0));
  const auto noise = [&] { return Complex(normal(random), normal(random)); };
  const std::vector<std::size_t> probes{0, 1, 2};
  for (const bool is_given : {true, false}) {
    const Vec given = Vec::Constant(3, is_given ? sigma * std::sqrt(std::log(20.0)) : 0.0);
    int weights_inside = 0, readings_inside = 0;
    constexpr int times = 1000;
    for (int time = 0; time < times; ++time) {
      std::vector<BalancingRun> runs;
      for (const CVec& w : {list({0.0, 0.0}), list({at(4, 30), 0.0}), list({0.0, at(3, -70)}),
                            list({0.0, 0.0}), list({at(4, 30), 0.0}), list({0.0, at(3, -70)})}) {
        if (is_given && runs.size() == 3) break;
        CVec read = truth.V + truth.A * w;
        for (Complex& v : read) v += noise();
        runs.push_back({"run", w, read});
      }
      const auto lines = influence_lines(runs, {"A", "B"});
      CorrectionProblem p = truth;
      for (Eigen::Index j = 0; j < 3; ++j) {
        p.V(j) = lines[static_cast<std::size_t>(j)].start;
        p.A.row(j) = lines[static_cast<std::size_t>(j)].coefficients.transpose();
      }
      const Correction found = correct(p, {"A", "B"});
      const auto variance = reading_variance(lines, probes, given);
      ASSERT_TRUE(variance);
      EXPECT_EQ(variance->spare.has_value(), !is_given);
      const BalancingConfidence sure = confidence_of(lines, *variance, p.weight, found.weights);
      weights_inside += std::abs(found.weights(0) - best(0)) < sure.weights(0);
      const Complex read = truth.V(1) + (truth.A.row(1) * found.weights)(0) + noise();
      readings_inside += std::abs(found.left(1) - read) < sure.readings(1);
    }
    constexpr double chance = 0.025;  // more than three deviations of such a count
    // the least known of three variances counts for all: of spare runs rather more are inside
    EXPECT_GE(weights_inside / double(times), 0.95 - chance) << is_given;
    EXPECT_GE(readings_inside / double(times), 0.95 - chance) << is_given;
    if (is_given) {
      EXPECT_LE(weights_inside / double(times), 0.95 + chance);
    }
    EXPECT_LE(readings_inside / double(times), 0.95 + chance) << is_given;
  }
}

TEST(BalancingConfidence, IsNotToldWithoutSpareRuns) {
  const auto lines = influence_lines(two_planes, {"A", "B"});
  EXPECT_FALSE(reading_variance(lines, {0, 1}, Vec::Zero(2)));
  EXPECT_NEAR(radius_of_95_percent(std::nullopt), 1.7308, 1e-4);
  EXPECT_NEAR(radius_of_95_percent(1), std::sqrt(19.0), 1e-12);
  EXPECT_NEAR(radius_of_95_percent(100'000), radius_of_95_percent(std::nullopt), 1e-4);
}

}  // namespace whirl::balancing_test

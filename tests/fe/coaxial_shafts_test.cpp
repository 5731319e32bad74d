// Two shafts of different speeds, one within the other.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libfe/assembly/excitations.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::coaxial_shafts_test {

using test::at;
using test::pi;

constexpr double Omega = 500.0;  ///< [rad/s]

Material made_of() {
  constexpr double E = 2.1e11, nu = 0.3;
  return {.name = "steel", .rho = 7800.0, .E = E, .G = 0.5 * E / (1.0 + nu), .nu = nu};
}

Station outer(double z) {
  return {.kind = Station::Kind::position, .z = z, .rotor = "outer"};
}

/// An inner shaft of 1 m with two disks, around it an outer one from 0.3 to 0.8 m with two more, a
/// bearing between them at 0.8 m. An independent program, of elements of the same kind assembled
/// with numpy, found the numbers below.
struct Coaxial {
  double ratio = 1.5;  ///< of the speed of the outer shaft
  int halvings = 0;    ///< of elements of 50 mm
  bool is_coupled = true;

  Segment inner_shaft() const {
    return {.material = made_of(),
            .length = 1.0,
            .left = {.outer = 0.04},
            .right = {.outer = 0.04},
            .elements = 20 << halvings};
  }
  Segment outer_shaft() const {
    return {.material = made_of(),
            .length = 0.5,
            .left = {.outer = 0.08, .inner = 0.06},
            .right = {.outer = 0.08, .inner = 0.06},
            .elements = 10 << halvings};
  }
  Structure structure() const {
    Structure s;
    s.shaft = {inner_shaft()};
    s.rotors = {{.name = "outer", .ratio = ratio, .z = 0.3, .shaft = {outer_shaft()}}};
    s.disks = {{.at = at(0.1), .m = 6.0, .Id = 0.02, .Ip = 0.04},
               {.at = at(0.9), .m = 8.0, .Id = 0.03, .Ip = 0.06},
               {.at = outer(0.4), .m = 5.0, .Id = 0.015, .Ip = 0.03},
               {.at = outer(0.7), .m = 4.0, .Id = 0.01, .Ip = 0.02}};
    s.bearings = {test::bearing(at(0.0), test::isotropic(2e7, 100.0)),
                  test::bearing(at(1.0), test::isotropic(1.5e7, 100.0)),
                  test::bearing(outer(0.3), test::isotropic(3e7, 100.0))};
    if (is_coupled) s.bearings.push_back(test::connect(at(0.8), outer(0.8), test::isotropic(2e7)));
    return s;
  }
  /// One of the shafts alone, from z = 0.
  Structure alone(bool is_outer) const {
    Structure all = structure(), s;
    s.shaft = {is_outer ? outer_shaft() : inner_shaft()};
    const double start = is_outer ? 0.3 : 0.0;
    for (Disk d : all.disks) {
      if (d.at.rotor.empty() == is_outer) continue;
      d.at = at(d.at.z - start);
      s.disks.push_back(d);
    }
    for (Connection b : all.bearings) {
      if (b.from.rotor.empty() == is_outer || b.to.kind != Station::Kind::ground) continue;
      b.from = at(b.from.z - start);
      s.bearings.push_back(b);
    }
    return s;
  }
};

std::vector<double> frequencies(const Structure& s, double speed, int count) {
  std::vector<double> all;
  const Modes modes = complex_modes(Assembler(s), speed, count);
  for (const Mode& mode : modes.oscillatory) all.push_back(mode.frequency() / (2.0 * pi));
  return all;
}

// Frequencies of an independent program with the same elements, in Hz.
TEST(CoaxialShafts, HaveTheFrequenciesOfAnotherProgram) {
  const std::vector<double> along{53.164145,  61.059634,  148.227680, 153.363304, 286.259985,
                                  287.266400, 295.685804, 307.018827, 403.882903, 429.080345};
  const std::vector<double> against{54.409762,  59.639794,  148.975969, 152.674981, 286.349590,
                                    287.150054, 295.727320, 307.007357, 411.023240, 418.065996};
  for (const auto& [ratio, expected] : {std::pair(1.5, along), {-1.5, against}}) {
    const auto found = frequencies(Coaxial{ratio}.structure(), Omega, 10);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], 6e-7) << ratio << ", " << i;
    }
  }
  const std::vector<double> fine{53.164098,  61.059553,  148.226886, 153.362402, 286.253992,
                                 287.260210, 295.680594, 307.012221, 403.867858, 429.059557};
  const auto found = frequencies(Coaxial{1.5, 2}.structure(), Omega, 10);
  for (std::size_t i = 0; i < fine.size(); ++i) EXPECT_NEAR(found[i], fine[i], 6e-7) << i;
}

// Matrices are those of each shaft alone, side by side, with the bearing between them added.
TEST(CoaxialShafts, AreAssembledOfEachShaftAlone) {
  const Coaxial rotor{-1.5};
  const auto whole = Assembler(rotor.structure()).full(Omega, Omega);
  const auto inner = Assembler(rotor.alone(false)).full(Omega, Omega),
             outer_one = Assembler(rotor.alone(true)).full(Omega, Omega);
  const Eigen::Index n = inner.M.rows(), m = outer_one.M.rows();
  ASSERT_EQ(whole.M.rows(), n + m);
  const auto side_by_side = [&](const Sparse& a, const Sparse& b) {
    Mat both = Mat::Zero(n + m, n + m);
    both.topLeftCorner(n, n) = a;
    both.bottomRightCorner(m, m) = b;
    return both;
  };
  Mat K = side_by_side(inner.K, outer_one.K);
  for (const int c : {X, Y}) {
    const Eigen::Index i = 4 * 16 + c, o = n + 4 * 10 + c;  // at 0.8 m
    K(i, i) += 2e7, K(o, o) += 2e7, K(i, o) -= 2e7, K(o, i) -= 2e7;
  }
  const auto expect_same = [](const Sparse& a, const Mat& b) {
    EXPECT_LE((Mat(a) - b).cwiseAbs().maxCoeff(), 1e-14 * b.cwiseAbs().maxCoeff());
  };
  expect_same(whole.M, side_by_side(inner.M, outer_one.M));
  expect_same(whole.C, side_by_side(inner.C, outer_one.C));
  expect_same(whole.K, K);
  expect_same(whole.G(), side_by_side(inner.G(), Sparse(-1.5 * outer_one.G())));
}

// Without the bearing between them each has its own modes.
TEST(CoaxialShafts, WithoutACouplingAreEachForItself) {
  Coaxial rotor;
  rotor.is_coupled = false;
  auto apart = frequencies(rotor.alone(false), Omega, 6);
  // the outer shaft on one bearing tips: a motion without stiffness, but for its damping
  for (const double f : frequencies(rotor.alone(true), 1.5 * Omega, 4)) apart.push_back(f);
  for (const double f : frequencies(rotor.structure(), Omega, 6)) {
    EXPECT_TRUE(std::ranges::any_of(apart, [&](double a) { return std::abs(a - f) < 1e-6 * f; }))
        << f;
  }
}

// At one speed and with a stiff tie at every node both are one shaft with a layer around it.
TEST(CoaxialShafts, TiedAtEqualSpeedAreOneShaftWithALayer) {
  Structure two, one;
  const Segment solid = test::cylinder(1.0, 0.04, 10);
  Segment tube = solid;
  tube.left = tube.right = {.outer = 0.06, .inner = 0.04};
  two.shaft = one.shaft = {solid};
  two.rotors = {{.name = "outer", .ratio = 1.0, .shaft = {tube}}};
  one.layers = {{.name = "sleeve",
                 .from = at(0.0),
                 .to = at(1.0),
                 .material = tube.material,
                 .left = tube.left,
                 .right = tube.right}};
  for (Structure* s : {&two, &one}) {
    s->bearings = {test::bearing(at(0.0), test::isotropic(1e7)),
                   test::bearing(at(1.0), test::isotropic(2e7))};
  }
  for (int i = 0; i <= 10; ++i) two.links.push_back(test::clamped(at(0.1 * i), outer(0.1 * i)));
  const auto both = frequencies(two, Omega, 6), layered = frequencies(one, Omega, 6);
  ASSERT_EQ(both.size(), layered.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_NEAR(both[i], layered[i], 1e-9 * layered[i]);
  }
}

// Two shafts one behind the other whose ends are clamped together, a rigid coupling, are one shaft.
TEST(CoaxialShafts, OneBehindTheOtherAndClampedAreOneShaft) {
  const Segment whole = test::cylinder(1.0, 0.04, 20), half = test::cylinder(0.5, 0.04, 10);
  Structure one, train;
  one.shaft = {whole};
  train.shaft = {half};
  train.rotors = {{.name = "outer", .ratio = 1.0, .z = 0.5, .shaft = {half}}};
  train.links = {test::clamped(at(0.5), outer(0.5))};
  one.disks = train.disks = {{.at = at(0.2), .m = 3.0, .Id = 0.01, .Ip = 0.02}};
  for (Structure* s : {&one, &train}) {
    const bool is_train = s == &train;
    s->bearings = {test::bearing(at(0.0), test::isotropic(1e7, 50.0)),
                   test::bearing(is_train ? outer(1.0) : at(1.0), test::isotropic(2e7, 50.0))};
  }
  const auto of_one = frequencies(one, Omega, 6), of_train = frequencies(train, Omega, 6);
  ASSERT_EQ(of_one.size(), of_train.size());
  for (std::size_t i = 0; i < of_one.size(); ++i) {
    EXPECT_NEAR(of_train[i], of_one[i], 1e-9 * of_one[i]);
  }
}

// 10 g.mm on a disk of either shaft at 500 rad/s, along x, by the independent program [m].
TEST(CoaxialShafts, RespondToTheUnbalanceOfEachAtItsOwnFrequency) {
  Structure s = Coaxial{}.structure();
  const std::vector<double> speeds{Omega};
  s.unbalances = {{.at = outer(0.7), .moment = 1e-5}};
  const Assembler of_outer(s);
  const std::vector<Point> points{of_outer.point(at(0.9)), of_outer.point(outer(0.7))};
  EXPECT_FALSE(acts_at(synchronous_excitations(of_outer), Omega) &&
               of_outer.unbalance().norm() > 0.0);
  const std::vector<Excitation> others = other_excitations(of_outer);
  ASSERT_EQ(others.size(), 1u);
  EXPECT_DOUBLE_EQ(others[0].order, 1.5);
  EXPECT_EQ(others[0].names, "unbalance of outer");
  const UnbalanceResponse fast = oscillating_response(of_outer, others[0], speeds, points);
  EXPECT_NEAR(std::abs(fast.x(0, 0)), 7.81668570e-8, 1e-16);
  EXPECT_NEAR(std::abs(fast.x(1, 0)), 2.53272710e-8, 1e-16);
  EXPECT_DOUBLE_EQ(highest_frequency(s, Omega), 750.0);

  s.unbalances = {{.at = at(0.9), .moment = 1e-5}};
  const Assembler of_inner(s);
  EXPECT_TRUE(other_excitations(of_inner).empty());
  const UnbalanceResponse slow = unbalance_response(of_inner, speeds, points);
  EXPECT_NEAR(std::abs(slow.x(0, 0)), 2.95961774e-7, 1e-15);
  EXPECT_NEAR(std::abs(slow.x(1, 0)), 5.22484471e-7, 1e-15);
}

// A shaft that turns against the first one at its speed has its unbalance at the same frequency:
// mirrored, the rotor is the same with both turned round.
TEST(CoaxialShafts, UnbalanceOfAShaftThatTurnsAgainstItIsMirrored) {
  const auto response = [](double ratio, bool is_on_outer) {
    Structure s = Coaxial{ratio}.structure();
    s.unbalances = {{.at = is_on_outer ? outer(0.7) : at(0.9), .moment = 1e-5, .phase = 0.3}};
    const Assembler assembler(s);
    EXPECT_TRUE(other_excitations(assembler).empty());
    return unbalance_response(assembler, {Omega}, {assembler.point(at(0.9))});
  };
  const UnbalanceResponse mirrored = response(-1.0, true);
  // r = x + i y whirls backward: x - i y turns with e^(-i Omega t)
  EXPECT_LT(std::abs(mirrored.x(0, 0) + Complex(0, 1) * mirrored.y(0, 0)),
            1e-9 * std::abs(mirrored.x(0, 0)));
  const UnbalanceResponse along = response(1.0, true);
  EXPECT_LT(std::abs(along.x(0, 0) - Complex(0, 1) * along.y(0, 0)),
            1e-9 * std::abs(along.x(0, 0)));
}

// Undamped critical speeds of forward whirl, by the unbalance of either shaft [rad/s].
const std::vector<double> by_inner{377.430252, 977.577269, 1812.232121},
    by_outer{247.237054, 645.298661, 1205.964892};

Structure undamped(Structure s) {
  for (Connection& b : s.bearings) {
    BearingCoefficients c = coefficients(b.coefficients, 0.0);
    c.C.setZero();
    b.coefficients = constant_bearing(c);
  }
  return s;
}

TEST(CoaxialShafts, HaveCriticalSpeedsByTheUnbalanceOfEach) {
  const Structure s = undamped(Coaxial{1.5, 1}.structure());
  for (const auto& [order, expected] : {std::pair(1.0, by_inner), {1.5, by_outer}}) {
    std::vector<double> forward;
    for (const Critical& c :
         critical_speeds(Assembler(s), {.count = 8, .order = order, .has_damped = false})) {
      if (c.whirl == Whirl::forward) forward.push_back(c.speed);
    }
    ASSERT_GE(forward.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(forward[i], expected[i], 6e-7) << order << ", " << i;
    }
  }
}

Structure with_own_speed(std::vector<double> lead, std::vector<double> own,
                         const Coaxial& rotor = {}) {
  Structure s = rotor.structure();
  s.rotors[0].lead = std::move(lead);
  s.rotors[0].own = std::move(own);
  return s;
}

// A speed of its own, or one by a table, makes the matrices of the ratio that it is at each speed
// of the first shaft; also where that stands.
TEST(CoaxialShafts, TurnAtSpeedsOfTheirOwn) {
  const auto difference = [](const Sparse& a, const Sparse& b) {
    return Mat(a - b).norm() / Mat(b).norm();
  };
  const Assembler by_table(with_own_speed({0.0, 1000.0}, {0.0, 1500.0}));
  const Assembler by_ratio(Coaxial{1.5}.structure());
  EXPECT_TRUE(by_table.tables_depend_on_speed());
  for (const double speed : {0.0, 300.0, 1000.0}) {
    const System found = by_table.at(speed), wanted = by_ratio.at(speed);
    EXPECT_LT(difference(found.D(), wanted.D()), 1e-15) << speed;
    EXPECT_LT(difference(found.stiffness(), wanted.stiffness()), 1e-15) << speed;
  }
  EXPECT_LT(
      difference(by_table.at(2000.0).D(), Assembler(Coaxial{0.75}.structure()).at(2000.0).D()),
      1e-15);
  const Assembler constant(with_own_speed({0.0}, {750.0})), inner(Coaxial{0.0}.structure());
  EXPECT_FALSE(constant.tables_depend_on_speed());
  EXPECT_LT(difference(constant.at(Omega).D(), by_ratio.at(Omega).D()), 1e-15);
  const Sparse alone = inner.at(Omega).D() - inner.at(0.0).D();
  EXPECT_LT(difference(constant.at(0.0).D(), by_ratio.at(Omega).D() - alone), 1e-14);
}

// A table that is a line through zero is a ratio: critical speeds by either shaft are those of it,
// and the printed ones.
TEST(CoaxialShafts, HaveTheCriticalSpeedsOfTheRatioThatATableMakes) {
  const Coaxial fine{1.5, 1};
  const Assembler by_ratio(undamped(fine.structure()));
  const Assembler by_table(
      undamped(with_own_speed({0.0, 700.0, 6000.0}, {0.0, 1050.0, 9000.0}, fine)));
  for (const std::string by : {"", "outer"}) {
    const CriticalOptions options{.count = 8, .has_damped = false, .by = by};
    const auto wanted = critical_speeds(by_ratio, options);
    const auto found = critical_speeds(by_table, options);
    ASSERT_EQ(found.size(), wanted.size()) << by;
    std::vector<double> forward;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].speed, wanted[i].speed, 1e-9 * wanted[i].speed) << by << i;
      EXPECT_EQ(found[i].whirl, wanted[i].whirl);
      EXPECT_EQ(found[i].shaft, by.empty() ? "shaft" : "outer");
      if (found[i].whirl == Whirl::forward) forward.push_back(found[i].speed);
    }
    EXPECT_EQ(found[0].excitation(), by.empty() ? "1x" : "speed of outer");
    EXPECT_EQ(wanted[0].excitation(), by.empty() ? "1x" : "1.5x");
    const std::vector<double>& printed = by.empty() ? by_inner : by_outer;
    ASSERT_GE(forward.size(), printed.size());
    for (std::size_t i = 0; i < printed.size(); ++i) EXPECT_NEAR(forward[i], printed[i], 6e-7);
  }
}

// At every critical speed of a rotor whose outer shaft keeps its speed the excitation is one of its
// natural frequencies there, as the modes have them, and no crossing of modes over speed is missed.
TEST(CoaxialShafts, AreCriticalWhereTheirModesMeetASpeedThatStays) {
  constexpr double own = 963.0;  // within what gyroscopics split
  const Assembler rotor(undamped(with_own_speed({0.0}, {own})));
  const auto by_first = critical_speeds(rotor, {.count = 4, .has_damped = false});
  const auto by_outer_one =
      critical_speeds(rotor, {.count = 4, .has_damped = false, .by = "outer"});
  ASSERT_EQ(by_first.size(), 4u);
  ASSERT_GE(by_outer_one.size(), 1u);
  const auto meets = [&](const Critical& c, double excitation) {
    const Modes modes = complex_modes(rotor, c.speed, 5);
    double nearest = 1e9;
    for (const Mode& mode : modes.oscillatory) {
      nearest = std::min(nearest, std::abs(mode.frequency() - excitation));
    }
    EXPECT_LT(nearest, 1e-9 * excitation) << c.speed;
  };
  for (const Critical& c : {by_first[0], by_first[3]}) meets(c, c.speed);
  for (const Critical& c : by_outer_one) meets(c, own);
  const auto below = [&](double speed, double excitation) {
    int number = 0;
    for (const double f : frequencies(rotor.structure(), speed, 8)) {
      if (2.0 * pi * f < excitation) ++number;
    }
    return number;
  };
  const double top = 1.0001 * by_first.back().speed;
  EXPECT_EQ(below(top, top), 4);
  int crossings = 0;
  for (int i = 1, last = below(0.0, own); i <= 4; ++i) {
    const int now = below(top * i / 4, own);
    crossings += std::abs(now - std::exchange(last, now));
  }
  EXPECT_EQ(std::ssize(by_outer_one), crossings);
  EXPECT_THROW(critical_speeds(rotor, {.by = "middle"}), ModelError);
}

// Unbalance of such a shaft has its frequency: the response is that of the order 1.5.
TEST(CoaxialShafts, UnbalanceGoesWithASpeedOfItsOwn) {
  for (const double sense : {1.0, -1.0}) {
    Structure s = Coaxial{1.5 * sense}.structure();
    s.unbalances = {{.at = outer(0.7), .moment = 1e-5, .phase = 0.3}};
    const Assembler by_ratio(s);
    s.rotors[0].lead = {0.0};
    s.rotors[0].own = {750.0 * sense};
    const Assembler own(s);
    s.rotors[0].lead = {0.0, 600.0};  // of one sense, although it begins where the shaft stands
    s.rotors[0].own = {0.0, 900.0 * sense};
    const Assembler by_table(s);
    const auto response = [&](const Assembler& a) {
      const std::vector<Excitation> loads = other_excitations(a);
      EXPECT_EQ(loads.size(), 1u);
      EXPECT_DOUBLE_EQ(loads.at(0).frequency_at(Omega), 750.0);
      return oscillating_response(a, loads.at(0), {Omega}, {a.point(at(0.9))});
    };
    const UnbalanceResponse wanted = response(by_ratio);
    for (const Assembler* a : {&own, &by_table}) {
      const UnbalanceResponse found = response(*a);
      EXPECT_LT(std::abs(found.x(0, 0) - wanted.x(0, 0)), 1e-12 * std::abs(wanted.x(0, 0)));
      EXPECT_LT(std::abs(found.y(0, 0) - wanted.y(0, 0)), 1e-12 * std::abs(wanted.y(0, 0)));
      EXPECT_EQ(acts_at(synchronous_excitations(*a), Omega), true);
      EXPECT_TRUE(synchronous_excitations(*a).at(0).amplitude.isZero(0.0));
    }
  }
}

// Nodes of the first shaft keep their numbers; stations ask for the shaft that they name.
TEST(CoaxialShafts, StationsNameTheirShaft) {
  const Coaxial rotor;
  const Structure s = rotor.structure();
  const Mesh mesh = make_mesh(s), first = make_mesh(rotor.alone(false));
  ASSERT_EQ(mesh.lines().size(), 2u);
  for (int i = 0; i < first.nodes(); ++i) {
    EXPECT_EQ(mesh.z[static_cast<std::size_t>(i)], first.z[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(resolve(outer(0.3), s, mesh).index, 21);
  EXPECT_EQ(resolve(at(0.3), s, mesh).index, 6);
  EXPECT_DOUBLE_EQ(diameter_at(s, mesh, 21), 0.08);
  EXPECT_DOUBLE_EQ(diameter_at(s, mesh, 6), 0.04);
  EXPECT_EQ(spin_ratio({Point::Kind::node, 21}, s, mesh), 1.5);
  EXPECT_EQ(spin_ratio({}, s, mesh), 0.0);
  for (const Station& wrong :
       {outer(0.2), Station{.kind = Station::Kind::position, .z = 0.4, .rotor = "middle"}}) {
    EXPECT_THROW(resolve(wrong, s, mesh), ModelError);
  }
}

}  // namespace whirl::coaxial_shafts_test

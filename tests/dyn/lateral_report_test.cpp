// The lateral analysis of a rotor that is nearly a Jeffcott rotor, beside its closed forms.

#include "libdyn/linear/lateral_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "libbase/error.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/model.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::lateral_report_test {

using std::numbers::pi;
using test::node;
using test::rpm;

/// A disk amid a massless shaft, very stiff beside its bearings: a mass m on 2 k, 2 c.
struct StiffRotor {
  static constexpr double m = 200.0, k = 2e7, zeta = 0.06, g = 9.81;
  double c = 2.0 * zeta * std::sqrt(2.0 * k * m) / 2.0;
  double clearance = 0.4e-3;

  double omega() const { return std::sqrt(2.0 * k / m); }

  Model model() const {
    Model model;
    Structure& s = model.structure;
    s.shaft = {test::massless_cylinder(0.6, 0.8, 4)};
    s.disks = {{.name = "wheel", .at = node(3), .m = m}};
    s.bearings = {test::bearing(node(1), test::isotropic(k, c)),
                  test::bearing(node(5), test::isotropic(k, c))};
    s.bearings[0].name = "left";
    s.bearings[1].name = "right";
    s.gravity = g;
    model.contacts = {
        {.name = "seal", .at = node(3), .clearance = clearance, .law = Radial<>{.k = 1e8}}};
    model.speed = 9000.0 * rpm;
    model.has_speed = true;
    return model;
  }
};

constexpr double stiff = 2e-4;  // relative: 2 k of the bearings over the stiffness of the shaft
                                // is 4e-5

LateralOptions options(double minimum, double maximum) {
  return {.range = {minimum * rpm, maximum * rpm, 1.05 * maximum * rpm}};
}

const LateralCheck& check_of(const LateralReport& report, LateralRule rule) {
  const auto found = std::find_if(report.checks.begin(), report.checks.end(),
                                  [&](const LateralCheck& c) { return c.rule == rule; });
  EXPECT_NE(found, report.checks.end());
  return *found;
}

// One mode, one antinode: all of the weight at the wheel, U = 2 * 6350 m / N. Highest at
// w = (1 - 2 zeta^2)^(-1/2), half the power at 1 / w^2 = 1 - 2 zeta^2 +- 2 zeta (1 - zeta^2)^(1/2).
TEST(LateralReport, HasThePeakOfAJeffcottRotorAndItsMargin) {
  const StiffRotor rotor;
  const LateralReport r = lateral_report(rotor.model(), options(8000.0, 9000.0)).report;
  ASSERT_EQ(r.cases.size(), 1u);
  ASSERT_EQ(r.planes.size(), 1u);
  EXPECT_EQ(r.planes[0].station, "3 wheel + seal");
  const double U = 2.0 * 6350e-6 * rotor.m / 9000.0;
  EXPECT_NEAR(r.planes[0].moment, U, stiff * U);
  ASSERT_EQ(r.journals.size(), 2u);
  EXPECT_NEAR(r.journals[0].mass, 0.5 * rotor.m, stiff * rotor.m);

  const double zeta = rotor.zeta, root = std::sqrt(1.0 - zeta * zeta);
  const double middle = 1.0 - 2.0 * zeta * zeta, peak = rotor.omega() / std::sqrt(middle);
  const double width = rotor.omega() * (1.0 / std::sqrt(middle - 2.0 * zeta * root) -
                                        1.0 / std::sqrt(middle + 2.0 * zeta * root));
  ASSERT_EQ(r.peaks.size(), 1u);
  EXPECT_NEAR(r.peaks[0].speed, peak, stiff * peak);
  const double AF = peak / width;
  EXPECT_NEAR(r.peaks[0].amplification(), AF, stiff * AF);
  const LateralCheck& margin = check_of(r, LateralRule::separation_margin);
  EXPECT_NEAR(margin.found, (8000.0 * rpm - peak) / (8000.0 * rpm), stiff);
  EXPECT_NEAR(margin.limit, 0.17 * (1.0 - 1.0 / (AF - 1.5)), stiff);
  EXPECT_EQ(margin.verdict, Verdict::passed);
}

// At a speed w times the critical one bearings move by e w^2 / ((1 - w^2)^2 + (2 zeta w)^2)^(1/2),
// peak to peak twice as far; scaled to the limit, the wheel takes this share of what its sag m g /
// (2 k) leaves.
TEST(LateralReport, ScalesTheResponseToTheLimitForClearances) {
  const StiffRotor rotor;
  const LateralReport r = lateral_report(rotor.model(), options(8000.0, 9000.0)).report;
  const auto response = [&](double Omega) {
    const double w = Omega / rotor.omega(), e = r.planes[0].moment / rotor.m;
    return e * w * w / std::hypot(1.0 - w * w, 2.0 * rotor.zeta * w);
  };
  const double slowest = 8000.0 * rpm;  // above the peak: the larger response
  const LateralCheck& vibration = check_of(r, LateralRule::vibration);
  EXPECT_NEAR(vibration.found, 2.0 * response(slowest), stiff * vibration.found);
  EXPECT_NEAR(vibration.speed, slowest, 1e-9 * slowest);
  EXPECT_EQ(vibration.limit, 25.4e-6);  // at 9000 rpm, below 12 000

  const double scaling = std::min(6.0, vibration.limit / vibration.found);
  EXPECT_NEAR(r.cases[0].scaling, scaling, stiff * scaling);
  const double sag = rotor.m * rotor.g / (2.0 * rotor.k), left = rotor.clearance - sag;
  ASSERT_EQ(r.clearances.size(), 1u);
  EXPECT_EQ(r.clearances[0].name, "contact seal");
  EXPECT_NEAR(r.clearances[0].left, left, stiff * left);
  const double peak = r.peaks[0].speed;
  const double largest = scaling * response(peak);
  EXPECT_NEAR(r.clearances[0].largest, largest, 2.0 * stiff * largest);
  const LateralCheck& share = check_of(r, LateralRule::running_clearance);
  EXPECT_NEAR(share.found, largest / left, 3.0 * stiff * share.found);
  EXPECT_EQ(share.limit, 0.75);
}

// Q_0 = 2 c omega_n; without cross-coupling delta = 2 pi zeta / (1 - zeta^2)^(1/2).
TEST(LateralReport, KnowsWhatCrossCouplingItBears) {
  const StiffRotor rotor;
  LateralOptions how = options(8000.0, 9000.0);
  const double limit = 2.0 * rotor.c * rotor.omega();
  const LateralReport alone = lateral_report(rotor.model(), how).report;
  EXPECT_NEAR(alone.limit, limit, 2.0 * stiff * limit);
  EXPECT_EQ(alone.coupled_station, "3 wheel + seal");
  EXPECT_TRUE(std::isnan(alone.anticipated));
  const double delta = 2.0 * pi * rotor.zeta / std::sqrt(1.0 - rotor.zeta * rotor.zeta);
  EXPECT_NEAR(alone.log_decrement, delta, 2.0 * stiff * delta);
  const LateralCheck& unchecked = check_of(alone, LateralRule::coupling_ratio);
  EXPECT_EQ(unchecked.verdict, Verdict::unknown);
  EXPECT_EQ(unchecked.missing, "--cross-coupling");
  EXPECT_EQ(unchecked.limit, 2.0);
  EXPECT_TRUE(check_of(alone, LateralRule::log_decrement).missing.empty());

  how.anticipated = 0.6 * limit;
  how.has_anticipated = true;
  const LateralReport r = lateral_report(rotor.model(), how).report;
  const LateralCheck& ratio = check_of(r, LateralRule::coupling_ratio);
  EXPECT_NEAR(ratio.found, 1.0 / 0.6, 3.0 * stiff);
  EXPECT_EQ(ratio.verdict, Verdict::failed);
  EXPECT_FALSE(r.is_passed());
  EXPECT_NEAR(r.log_decrement, 0.4 * delta, 0.01 * delta);  // lambda is linear in Q but for Q^2
}

/// The same disk on a shaft that bends: on rigid supports it is critical at (48 E I / (L^3
/// m))^(1/2).
struct BendingRotor : StiffRotor {
  Model model() const {
    Model model = StiffRotor::model();
    model.structure.shaft = {test::massless_cylinder(0.6, 0.16, 4)};
    return model;
  }
  double critical() const {
    return std::sqrt(48.0 * test::EI(test::massless_cylinder(0.6, 0.16, 4)) / (0.216 * m));
  }
};

// Q_0 / Q_A of 2 in region A, of 10 in B: where the speed ratio is above 2.69 - 0.0115 rho, or the
// gas denser than 60 kg/m^3. Without a density it is told that it is missing.
TEST(LateralReport, AsksForMoreInRegionB) {
  const BendingRotor rotor;
  const double maximum = 2.2 * rotor.critical() / rpm;
  LateralOptions how = options(0.5 * maximum, maximum);
  const LateralReport untold = lateral_report(rotor.model(), how).report;
  constexpr double exact = 1e-9;  // relative, of a massless shaft
  EXPECT_NEAR(untold.rigid_critical_speed, rotor.critical(), exact * rotor.critical());
  EXPECT_NEAR(untold.critical_speed_ratio(), 2.2, 2.2 * exact);
  EXPECT_EQ(check_of(untold, LateralRule::stability_region).missing, "--gas-density");
  EXPECT_EQ(check_of(untold, LateralRule::stability_region).verdict, Verdict::unknown);
  how.anticipated = untold.limit / 5.0;
  how.has_anticipated = true;
  const auto in_gas = [&](double density) {
    how.gas_density = density;
    return check_of(lateral_report(rotor.model(), how).report, LateralRule::stability_region);
  };
  const LateralCheck light = in_gas(42.0);  // 2.207
  EXPECT_EQ(light.limit, 2.0);
  EXPECT_NEAR(light.found, 5.0, 1e-6);
  EXPECT_EQ(light.verdict, Verdict::passed);
  const LateralCheck dense = in_gas(43.0);  // 2.1955
  EXPECT_EQ(dense.limit, 10.0);
  EXPECT_EQ(dense.verdict, Verdict::failed);
  EXPECT_TRUE(dense.missing.empty());
  EXPECT_EQ(in_gas(61.0).limit, 10.0);
}

// With zeta = 0.4 the response to unbalance is highest at w = 1.213 and stays above 0.707 of that
// beyond, where it goes to 1; below, at w_1 with 1 / w_1^2 = 1 - 2 zeta^2 + 2 zeta (1 -
// zeta^2)^(1/2). The width is twice that side's, and the peak no critical speed.
TEST(LateralReport, TellsAPeakOfOneSideAndOneThatIsCriticallyDamped) {
  StiffRotor rotor;
  const double zeta = 0.4;
  rotor.c *= zeta / rotor.zeta;
  const LateralReport r = lateral_report(rotor.model(), options(8000.0, 9000.0)).report;
  ASSERT_EQ(r.peaks.size(), 1u);
  const LateralPeak& peak = r.peaks[0];
  EXPECT_EQ(peak.sides, PeakSides::below);
  EXPECT_TRUE(peak.is_one_sided());
  EXPECT_EQ(peak.kind(), PeakKind::critically_damped);
  const double middle = 1.0 - 2.0 * zeta * zeta, top = 1.0 / std::sqrt(middle);
  const double below = 1.0 / std::sqrt(middle + 2.0 * zeta * std::sqrt(1.0 - zeta * zeta));
  const double AF = top / (2.0 * (top - below));
  EXPECT_NEAR(peak.amplification(), AF, 10.0 * stiff * AF);
  EXPECT_EQ(peak.margin.required, 0.0);
  // lightly damped both sides are there
  const LateralReport light = lateral_report(StiffRotor{}.model(), options(8000.0, 9000.0)).report;
  EXPECT_EQ(light.peaks.at(0).sides, PeakSides::both);
  EXPECT_EQ(light.peaks.at(0).kind(), PeakKind::critical_speed);
}

// A seal and a bearing with a clearance are checked as a contact there is.
TEST(LateralReport, ChecksTheClearancesOfSealsAndBearings) {
  const StiffRotor rotor;
  Model model = rotor.model();
  model.structure.seals = {test::bearing(node(3), test::isotropic(0.0))};
  model.structure.seals[0].name = "eye";
  model.structure.seals[0].clearance = rotor.clearance;
  const LateralReport r = lateral_report(model, options(8000.0, 9000.0)).report;
  ASSERT_EQ(r.clearances.size(), 2u);
  EXPECT_EQ(r.clearances[0].name, "contact seal");
  EXPECT_EQ(r.clearances[1].name, "seal eye");
  EXPECT_EQ(r.clearances[1].left, r.clearances[0].left);
  EXPECT_EQ(r.clearances[1].largest, r.clearances[0].largest);
  EXPECT_EQ(
      std::count_if(r.checks.begin(), r.checks.end(),
                    [](const LateralCheck& c) { return c.rule == LateralRule::running_clearance; }),
      2);
  model.contacts.clear();
  model.structure.bearings[0].clearance = 2.0 * rotor.clearance;
  const LateralReport alone = lateral_report(model, options(8000.0, 9000.0)).report;
  ASSERT_EQ(alone.clearances.size(), 2u);
  EXPECT_EQ(alone.clearances[0].name, "bearing left");
  EXPECT_NEAR(alone.clearances[0].left - alone.clearances[1].left, rotor.clearance,
              stiff * rotor.clearance);
}

// A seal whose clearance the weight uses up, m g / (2 k) = 49 um, fails whatever the response is.
TEST(LateralReport, FailsWhereARotorAtRestTouches) {
  StiffRotor rotor;
  rotor.clearance = 40e-6;
  const LateralReport r = lateral_report(rotor.model(), options(8000.0, 9000.0)).report;
  const LateralCheck& touching = check_of(r, LateralRule::running_clearance);
  EXPECT_EQ(touching.verdict, Verdict::failed);
  EXPECT_EQ(touching.found, INFINITY);
  EXPECT_FALSE(r.is_passed());
  rotor.clearance = 400e-6;
  const LateralReport wide = lateral_report(rotor.model(), options(8000.0, 9000.0)).report;
  EXPECT_EQ(check_of(wide, LateralRule::running_clearance).verdict, Verdict::passed);
}

// Bearings whose own cross-coupled stiffness is 1.2 times 2 c omega: the rotor is unstable without
// Q. It fails, with nothing to spare, whether or not it is told what to expect.
TEST(LateralReport, FailsARotorThatIsUnstableWithoutQ) {
  const StiffRotor rotor;
  Model model = rotor.model();
  BearingCoefficients oil = test::isotropic(StiffRotor::k, rotor.c);
  oil.K(0, 1) = 1.2 * rotor.c * rotor.omega();
  oil.K(1, 0) = -oil.K(0, 1);
  model.structure.bearings = {test::bearing(node(1), oil), test::bearing(node(5), oil)};
  LateralOptions how = options(8000.0, 9000.0);
  const LateralReport alone = lateral_report(model, how).report;
  EXPECT_EQ(alone.limit, 0.0);
  EXPECT_LT(alone.log_decrement, 0.0);
  EXPECT_EQ(check_of(alone, LateralRule::log_decrement).verdict, Verdict::failed);
  EXPECT_FALSE(alone.is_passed());
  how.anticipated = 1e3, how.has_anticipated = true;
  const LateralReport r = lateral_report(model, how).report;
  EXPECT_EQ(check_of(r, LateralRule::coupling_ratio).found, 0.0);
  EXPECT_EQ(check_of(r, LateralRule::coupling_ratio).verdict, Verdict::failed);
}

// Oil films keep the coefficients that they have without Q: with these frozen and Q_0 an eigenvalue
// is on the axis. Q_0 as a link of the model bends the rotor at rest, too: its journals run
// elsewhere then, and it is not at its border.
TEST(LateralReport, LeavesJournalsWhereTheyRunWithoutQ) {
  Model model = StiffRotor().model();
  model.structure.bearings.clear();
  model.contacts.clear();
  for (const int end : {1, 5}) {
    model.films.push_back(
        {.name = std::to_string(end),
         .at = node(end),
         .bearing = {.radius = 0.05, .length = 0.05, .clearance = 1e-4, .viscosity = 0.02}});
  }
  model.speed = 3000.0 * rpm;
  const LateralReport r = lateral_report(model, options(3000.0, 3000.0)).report;
  ASSERT_GT(r.limit, 0.0);
  BearingCoefficients Q;
  Q.K << 0.0, r.limit, -r.limit, 0.0;
  const auto growth = [&](const Structure& s) {
    double most = -INFINITY;
    for (const Mode& m : complex_modes(Assembler(s), model.speed, 8).oscillatory) {
      most = std::max(most, m.lambda.real() / std::abs(m.lambda));
    }
    return most;
  };
  Structure frozen = linear_structure(model);
  frozen.links.push_back(test::bearing(node(3), Q));
  EXPECT_NEAR(growth(frozen), 0.0, 1e-8);
  Model moved = model;
  moved.structure.links.push_back(test::bearing(node(3), Q));
  EXPECT_GT(std::abs(growth(linear_structure(moved))), 1e-3);
}

// Speeds that the model tells; a maximum that is asked for wins over all of them.
TEST(LateralReport, GoesByTheSpeedsOfTheModel) {
  Model model;
  EXPECT_EQ(operating_range(model).maximum, 0.0);
  model.speed = 100.0;
  const OperatingRange alone = operating_range(model);
  EXPECT_EQ(alone.minimum, 100.0);
  EXPECT_EQ(alone.maximum, 100.0);
  EXPECT_EQ(alone.trip, 105.0);
  model.machine = {.minimum = 80.0, .maximum = 120.0, .trip = 140.0};
  const OperatingRange told = operating_range(model);
  EXPECT_EQ(told.minimum, 80.0);
  EXPECT_EQ(told.maximum, 120.0);
  EXPECT_EQ(told.trip, 140.0);
  const OperatingRange faster = operating_range(model, 200.0);
  EXPECT_EQ(faster.minimum, 80.0);
  EXPECT_EQ(faster.trip, 210.0);
  EXPECT_EQ(operating_range(model, 60.0).minimum, 60.0);
}

// A critical speed among the operating speeds has no margin, however far from either end.
TEST(LateralReport, FailsWhereThePeakIsAmongOperatingSpeeds) {
  const StiffRotor rotor;
  const LateralReport r = lateral_report(rotor.model(), options(3000.0, 9000.0)).report;
  const LateralCheck& margin = check_of(r, LateralRule::separation_margin);
  EXPECT_EQ(margin.found, 0.0);
  EXPECT_EQ(margin.verdict, Verdict::failed);
  const LateralCheck& vibration = check_of(r, LateralRule::vibration);
  EXPECT_NEAR(vibration.found, 2.0 * r.peaks[0].amplitude, 1e-9 * vibration.found);
  EXPECT_NEAR(vibration.speed, r.peaks[0].speed, 1e-9 * vibration.speed);
}

// Without damping the peak has no end: it asks for the largest margin, and there is no other one.
TEST(LateralReport, KeepsFarthestFromAnUndampedResonance) {
  StiffRotor rotor;
  rotor.c = 0.0;
  const LateralReport r = lateral_report(rotor.model(), options(5200.0, 9000.0)).report;
  EXPECT_TRUE(r.peaks.empty());
  ASSERT_EQ(r.unbounded.size(), 1u);
  const LateralCheck& margin = check_of(r, LateralRule::separation_margin);
  EXPECT_NEAR(margin.speed, rotor.omega(), stiff * rotor.omega());
  EXPECT_EQ(margin.limit, 0.16);
  EXPECT_EQ(margin.verdict, Verdict::passed);
  // 4271 rpm is 14.6 % below 5000 rpm
  const LateralReport near = lateral_report(rotor.model(), options(5000.0, 9000.0)).report;
  EXPECT_EQ(check_of(near, LateralRule::separation_margin).verdict, Verdict::failed);
}

// With probes of its own vibration is that of their stations, each once, along the major axis.
TEST(LateralReport, LooksAtTheProbesOfTheModel) {
  Model model = StiffRotor{}.model();
  model.structure.probes = {{.name = "x", .at = node(4)},
                            {.name = "y", .at = node(4), .angle = 0.5 * pi}};
  const LateralReport r = lateral_report(model, options(8000.0, 9000.0)).report;
  ASSERT_EQ(r.probes.size(), 1u);
  EXPECT_TRUE(r.probes[0].station.starts_with("4")) << r.probes[0].station;
  EXPECT_EQ(r.responses.size(), 1u);
}

// Two antinodes against each other have the load of their own journal each; one beyond the journals
// has that of the nearest one.
TEST(LateralUnbalance, IsWhatTheJournalsCarryNextToEachAntinode) {
  Mesh mesh;
  mesh.z = {0.0, 1.0, 2.0, 3.0, 4.0};
  const std::vector<Journal> journals{{"left", 0, 0.0, 60.0}, {"right", 3, 3.0, 100.0}};
  const double N = 10000.0 * rpm;
  const auto unit = [](double mass) { return 2.0 * 6350e-6 * mass / 10000.0; };
  const auto both = unbalance_planes({{1, 1.0}, {2, -0.8}}, journals, mesh, N);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0].moment, unit(60.0), 1e-15);
  EXPECT_EQ(both[0].phase, 0.0);
  EXPECT_NEAR(both[1].moment, unit(100.0), 1e-15);
  EXPECT_EQ(both[1].phase, pi);
  const auto amid = unbalance_planes({{2, 1.0}}, journals, mesh, N);
  ASSERT_EQ(amid.size(), 1u);
  EXPECT_NEAR(amid[0].moment, unit(160.0), 1e-15);
  const auto beyond = unbalance_planes({{4, 1.0}}, journals, mesh, N);
  ASSERT_EQ(beyond.size(), 1u);
  EXPECT_NEAR(beyond[0].moment, unit(100.0), 1e-15);
}

/// A wheel between bearings at 0.2 and 1.0 m of a shaft with a coupling at its right end, 1.2 m.
Model machine_with_coupling(double wheel, double coupling) {
  Model model;
  Structure& s = model.structure;
  s.shaft = {test::cylinder(1.2, 0.08, 12)};
  s.disks = {{.name = "wheel", .at = node(7), .m = wheel},
             {.name = "coupling", .at = node(13), .m = coupling}};
  s.bearings = {test::bearing(node(3), test::isotropic(1e8, 1e4)),
                test::bearing(node(11), test::isotropic(1e8, 1e4))};
  s.bearings[0].name = "left";
  s.bearings[1].name = "right";
  model.speed = 6000.0 * rpm;
  model.has_speed = true;
  return model;
}

// The coupling has twice 6350 W / N of what hangs over beside the journal, itself and 0.2 m of the
// shaft; the left end, without a disk, has no case. The mode is the one that moves the end most.
TEST(LateralUnbalance, IsAtCouplingsToo) {
  const Model model = machine_with_coupling(60.0, 4.0);
  const LateralReport r = lateral_report(model, options(5000.0, 6000.0)).report;
  ASSERT_GE(r.cases.size(), 2u);
  for (std::size_t i = 0; i + 1 < r.cases.size(); ++i) {
    EXPECT_EQ(r.cases[i].places, UnbalancePlaces::antinodes);
  }
  EXPECT_EQ(r.cases.back().places, UnbalancePlaces::overhung_end);
  const LateralPlane& plane = r.planes.back();
  EXPECT_EQ(plane.of_case, static_cast<int>(r.cases.size()) - 1);
  EXPECT_EQ(plane.station, "13 coupling");
  const double hanging = 4.0 + 7810.0 * pi / 4.0 * 0.08 * 0.08 * 0.2;
  EXPECT_NEAR(plane.moment, 2.0 * 6350e-6 * hanging / 6000.0, 1e-12);
  EXPECT_EQ(plane.phase, 0.0);
}

// An overhung wheel at which a mode has its only antinode has a case already, with more unbalance.
TEST(LateralUnbalance, IsAtAnOverhungWheelOnce) {
  const Model model = machine_with_coupling(1.0, 80.0);
  const LateralReport r = lateral_report(model, options(5000.0, 6000.0)).report;
  for (const LateralCase& c : r.cases) EXPECT_EQ(c.places, UnbalancePlaces::antinodes);
  EXPECT_TRUE(std::ranges::any_of(
      r.planes, [](const LateralPlane& p) { return p.station == "13 coupling"; }));
}

/// Checks of a machine, less those that depend on the speeds of other machines.
std::vector<LateralCheck> checks_of(const LateralReport& report, const std::string& variant) {
  std::vector<LateralCheck> all;
  for (const LateralCheck& c : report.checks) {
    if (c.variant == variant && c.rule != LateralRule::vibration &&
        c.rule != LateralRule::running_clearance) {
      all.push_back(c);
    }
  }
  return all;
}

// A machine has the checks that it has alone, whatever others are analyzed beside it.
TEST(LateralReport, AnalyzesVariantsBesideTheModel) {
  const Model model = StiffRotor{}.model();
  StiffRotor light;
  light.c /= 2.0;
  const LateralOptions how = options(8000.0, 9000.0);
  const LateralReport both = lateral_report(model, how, {{"worn", light.model()}}).report;
  for (const auto& [variant, of] : {std::pair("", model), {"worn", light.model()}}) {
    const auto alone = checks_of(lateral_report(of, how).report, ""),
               beside = checks_of(both, variant);
    ASSERT_EQ(beside.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(beside[i].rule, alone[i].rule);
      EXPECT_EQ(beside[i].verdict, alone[i].verdict);
      if (std::isfinite(alone[i].found)) {
        EXPECT_DOUBLE_EQ(beside[i].found, alone[i].found);
      }
    }
  }
  EXPECT_LT(both.log_decrement, lateral_report(model, how).report.log_decrement);
}

/// A seal whose cross-coupled stiffness rises to q between two speeds.
Connection rising_seal(double from, double to, double q) {
  BearingCoefficients none = test::isotropic(0.0), crossed = none;
  crossed.K << 0.0, q, -q, 0.0;
  Connection seal = test::bearing(
      node(3), TableBearing{{.speed = {from * rpm, to * rpm}, .rows = {none, crossed}}});
  seal.name = "eye";
  return seal;
}

// Stable at the maximum speed, unstable below the trip speed: only a threshold tells.
TEST(LateralReport, FailsAVariantThatIsUnstableBeforeTheTripSpeed) {
  const StiffRotor rotor;
  const double bears = 2.0 * rotor.c * rotor.omega();  // q = c omega
  Model worn = rotor.model();
  worn.structure.seals = {rising_seal(9010.0, 9300.0, 4.0 * bears)};
  const LateralReport r =
      lateral_report(rotor.model(), options(8000.0, 9000.0), {{"worn", worn}}).report;
  const auto threshold = std::find_if(r.checks.begin(), r.checks.end(), [](const auto& c) {
    return c.place == "threshold of instability";
  });
  ASSERT_NE(threshold, r.checks.end());
  EXPECT_EQ(threshold->variant, "worn");
  EXPECT_EQ(threshold->verdict, Verdict::failed);
  EXPECT_GT(threshold->speed, 9010.0 * rpm);
  EXPECT_LT(threshold->speed, 9300.0 * rpm);
  EXPECT_FALSE(r.is_passed());
}

// Without seals and with all of them: the decrement that level I has there at Q = 0.
TEST(LateralReport, PutsSealsInOneByOne) {
  const StiffRotor rotor;
  Model model = rotor.model();
  const double without = lateral_report(model, options(8000.0, 9000.0)).report.log_decrement;
  model.structure.seals = {rising_seal(8000.0, 9000.0, 0.5 * 2.0 * rotor.c * rotor.omega())};
  const LateralStudy study = lateral_report(model, options(8000.0, 9000.0));
  const std::vector<LevelTwoStep>& steps = study.parts.level_two;
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[1].parts, "with seal eye");
  EXPECT_NEAR(steps[0].log_decrement, without, 1e-9);
  EXPECT_NEAR(steps[1].log_decrement, study.report.log_decrement, 1e-9);
  EXPECT_LT(steps[1].log_decrement, 0.6 * without);  // half of what it bears
  const LateralCheck& check = check_of(study.report, LateralRule::level_two);
  EXPECT_EQ(check.found, steps[1].log_decrement);
}

TEST(LateralReport, RefusesVariantsWithOtherProbes) {
  const Model model = StiffRotor{}.model();
  Model other = model;
  other.structure.probes = {{.name = "p", .at = node(2)}};
  EXPECT_THROW(lateral_report(model, options(8000.0, 9000.0), {{"other", other}}), ModelError);
}

TEST(LateralReport, SaysWhatItNeeds) {
  Model model = StiffRotor{}.model();
  model.structure.bearings.clear();
  EXPECT_THROW(lateral_report(model, options(8000.0, 9000.0)), ModelError);
  Model bodies;
  bodies.structure.bodies = {{.name = "rotor", .m = 1.0, .spins = true}};
  bodies.structure.bearings = {test::bearing(test::body("rotor"), test::isotropic(1e6))};
  EXPECT_THROW(lateral_report(bodies, options(8000.0, 9000.0)), ModelError);
}

}  // namespace whirl::lateral_report_test

// The lateral analysis of machines with several shafts: each is looked at by its own speed.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/system/model.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::lateral_shafts_test {

using std::numbers::pi;
using test::at;
using test::rpm;

Station on_other(double z) {
  return {.kind = Station::Kind::position, .z = z, .rotor = "other"};
}

constexpr double start = 0.2;  ///< left end of the other shaft [m]

/// Two shafts beside each other, each with bearings, a wheel, an overhung coupling, a seal and a
/// clearance; nothing links them.
struct TwoShafts {
  double ratio = 1.5;

  static Segment first_shaft() { return test::cylinder(1.2, 0.08, 6); }
  static Segment other_shaft() { return test::cylinder(0.8, 0.075, 4); }

  /// Adds the parts of a shaft, at places on it.
  template <class Place>
  static void add_first(Model& model, const Place& place) {
    Structure& s = model.structure;
    s.disks.push_back({.name = "wheel", .at = place(0.6), .m = 80.0, .Id = 1.0, .Ip = 1.8});
    s.disks.push_back({.name = "hub", .at = place(1.2), .m = 6.0, .Id = 0.02, .Ip = 0.03});
    add_bearings(s, {place(0.2), place(1.0)}, {"left", "right"}, 3e7, 2e4);
    s.seals.push_back(test::bearing(place(0.8), swirling(2e6)));
    s.seals.back().name = "eye";
    add_contact(model, "ring", place(0.4));
  }
  template <class Place>
  static void add_other(Model& model, const Place& place, double sense) {
    Structure& s = model.structure;
    s.disks.push_back({.name = "pinion", .at = place(0.4), .m = 30.0, .Id = 0.1, .Ip = 0.18});
    s.disks.push_back({.name = "coupling", .at = place(0.0), .m = 2.0, .Id = 0.002, .Ip = 0.003});
    add_bearings(s, {place(0.2), place(0.6)}, {"de", "nde"}, 2e7, 1.2e4);
    s.seals.push_back(test::bearing(place(0.4), swirling(sense * 1e6)));
    s.seals.back().name = "balance piston";
    add_contact(model, "labyrinth", place(0.4));
  }
  static BearingCoefficients swirling(double q) {
    BearingCoefficients c = test::isotropic(1e6, 2e3);
    c.K(0, 1) = q, c.K(1, 0) = -q;
    return c;
  }
  static void add_bearings(Structure& s, const std::vector<Station>& places,
                           const std::vector<std::string>& names, double k, double c) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      s.bearings.push_back(test::bearing(places[i], test::isotropic(k, c)));
      s.bearings.back().name = names[i];
    }
  }
  static void add_contact(Model& model, const std::string& name, const Station& at) {
    model.contacts.push_back(
        {.name = name, .at = at, .clearance = 1e-3, .law = Radial<>{.k = 1e8}});
  }
  static void run_at(Model& model, double speed) {
    model.structure.gravity = 9.81;
    model.speed = speed;
    model.has_speed = true;
  }

  Model both() const {
    Model model;
    model.structure.shaft = {first_shaft()};
    model.structure.rotors = {
        {.name = "other", .ratio = ratio, .z = start, .shaft = {other_shaft()}}};
    add_first(model, [](double z) { return at(z); });
    add_other(
        model, [](double z) { return on_other(start + z); }, ratio < 0.0 ? -1.0 : 1.0);
    run_at(model, maximum);
    return model;
  }
  Model first_alone() const {
    Model model;
    model.structure.shaft = {first_shaft()};
    add_first(model, [](double z) { return at(z); });
    run_at(model, maximum);
    return model;
  }
  Model other_alone() const {
    Model model;
    model.structure.shaft = {other_shaft()};
    add_other(
        model, [](double z) { return at(z); }, 1.0);
    run_at(model, std::abs(ratio) * maximum);
    return model;
  }

  static constexpr double minimum = 6500.0 * rpm, maximum = 7000.0 * rpm, trip = 7350.0 * rpm;
  static LateralOptions options(double times = 1.0) {
    return {.range = {times * minimum, times * maximum, times * trip}};
  }
};

template <class Row>
std::vector<Row> rows_of(const std::vector<Row>& all, const std::string& shaft) {
  std::vector<Row> own;
  std::ranges::copy_if(all, std::back_inserter(own),
                       [&](const Row& r) { return r.shaft == shaft; });
  return own;
}

constexpr double exact = 1e-7;  ///< relative: peaks are found to 1e-8 of their speed
/// Of an amplification factor that follows from one side of a peak: 2 AF times that.
constexpr double by_one_side = 2e-6;
/// Largest of samples, and where it is: a curve has samples at the resonances of the other shaft,
/// too.
constexpr double sampled = 2e-5, sampled_at = 1e-3;

void expect_near(double found, double expected, const char* what, double tolerance = exact) {
  EXPECT_NEAR(found, expected, tolerance * std::abs(expected)) << what;
}

/// Checks that level I asks for of a shaft without expected cross-coupling, and all others.
std::vector<LateralCheck> asked_of_any(std::vector<LateralCheck> checks) {
  std::erase_if(checks, [](const LateralCheck& c) {
    return c.rule == LateralRule::coupling_ratio || c.rule == LateralRule::stability_region;
  });
  return checks;
}

/// The rows of a shaft of a machine are those of the report of this shaft alone.
/// @param order  of its own speeds over those of the rows
void expect_rows(const LateralStudy& study, const std::string& shaft, double order,
                 const LateralStudy& alone) {
  const auto journals = rows_of(study.report.journals, shaft);
  ASSERT_EQ(journals.size(), alone.report.journals.size());
  for (std::size_t i = 0; i < journals.size(); ++i) {
    EXPECT_EQ(journals[i].name, alone.report.journals[i].name);
    expect_near(journals[i].mass, alone.report.journals[i].mass, "journal");
  }
  const auto cases = rows_of(study.report.cases, shaft);
  ASSERT_EQ(cases.size(), alone.report.cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const LateralCase& own = alone.report.cases[i];
    EXPECT_EQ(cases[i].order, order);
    EXPECT_EQ(cases[i].places, own.places);
    expect_near(order * cases[i].mode_speed, own.mode_speed, "mode");
    expect_near(cases[i].vibration, own.vibration, "vibration");
    expect_near(order * cases[i].vibration_speed, own.vibration_speed, "vibration at");
    expect_near(cases[i].scaling, own.scaling, "scaling");
  }
  const auto planes = rows_of(study.report.planes, shaft);
  ASSERT_EQ(planes.size(), alone.report.planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    expect_near(planes[i].moment, alone.report.planes[i].moment, "moment");
    EXPECT_EQ(planes[i].phase, alone.report.planes[i].phase);
  }
  const auto peaks = rows_of(study.report.peaks, shaft);
  ASSERT_EQ(peaks.size(), alone.report.peaks.size());
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    expect_near(order * peaks[i].speed, alone.report.peaks[i].speed, "peak");
    expect_near(peaks[i].amplitude, alone.report.peaks[i].amplitude, "amplitude");
    expect_near(peaks[i].amplification(), alone.report.peaks[i].amplification(), "AF", by_one_side);
  }
  const auto clearances = rows_of(study.report.clearances, shaft);
  ASSERT_EQ(clearances.size(), alone.report.clearances.size());
  for (std::size_t i = 0; i < clearances.size(); ++i) {
    EXPECT_EQ(clearances[i].name, alone.report.clearances[i].name);
    expect_near(clearances[i].share(), alone.report.clearances[i].share(), "share", sampled);
  }
  const auto forces = rows_of(study.parts.forces, shaft);
  ASSERT_EQ(forces.size(), alone.parts.forces.size());
  for (std::size_t i = 0; i < forces.size(); ++i) {
    EXPECT_EQ(forces[i].name, alone.parts.forces[i].name);
    expect_near(forces[i].force, alone.parts.forces[i].force, "force", sampled);
    expect_near(order * forces[i].speed, alone.parts.forces[i].speed, "force at", sampled_at);
  }
  const auto steps = rows_of(study.parts.level_two, shaft);
  ASSERT_EQ(steps.size(), alone.parts.level_two.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].parts, alone.parts.level_two[i].parts);
    expect_near(steps[i].log_decrement, alone.parts.level_two[i].log_decrement, "level II");
  }
  const auto states = rows_of(study.parts.level_one, shaft);
  ASSERT_EQ(states.size(), 1u);
  expect_near(states[0].log_decrement, alone.report.log_decrement, "log decrement");
  expect_near(states[0].limit, alone.report.limit, "Q0");
}

/// Likewise of its checks, and of what the table of shafts tells.
void expect_checks(const LateralStudy& study, const std::string& shaft, double order,
                   const LateralReport& alone) {
  const auto checks = asked_of_any(rows_of(study.report.checks, shaft));
  const auto own = asked_of_any(alone.checks);
  ASSERT_EQ(checks.size(), own.size());
  for (std::size_t i = 0; i < checks.size(); ++i) {
    EXPECT_EQ(checks[i].rule, own[i].rule);
    EXPECT_EQ(checks[i].verdict, own[i].verdict);
    const bool is_sampled = own[i].rule == LateralRule::running_clearance;
    expect_near(order * checks[i].speed, own[i].speed, "check at", is_sampled ? sampled_at : exact);
    expect_near(checks[i].limit, own[i].limit, "limit", by_one_side);
    expect_near(checks[i].found, own[i].found, "found", is_sampled ? sampled : by_one_side);
  }
  const auto found = std::ranges::find(study.parts.shafts, shaft, &LateralShaft::name);
  ASSERT_NE(found, study.parts.shafts.end());
  expect_near(found->maximum_speed, alone.maximum_speed, "maximum");
  expect_near(found->vibration_limit, alone.vibration_limit, "limit of vibration");
  expect_near(found->rigid_critical_speed, alone.rigid_critical_speed, "on rigid supports");
}

// Nothing links them: each has the report that it has alone at its own speeds, in its own sense.
TEST(LateralShafts, WithoutALinkHaveTheReportOfEachAlone) {
  const TwoShafts machine{-1.5};
  const LateralStudy study = lateral_report(machine.both(), TwoShafts::options());
  const LateralStudy first = lateral_report(machine.first_alone(), TwoShafts::options()),
                     other = lateral_report(machine.other_alone(), TwoShafts::options(1.5));
  ASSERT_GE(first.report.peaks.size(), 1u);
  ASSERT_GE(other.report.peaks.size(), 1u);
  expect_rows(study, "shaft", 1.0, first);
  expect_rows(study, "other", 1.5, other);
  expect_checks(study, "shaft", 1.0, first.report);
  expect_checks(study, "other", 1.5, other.report);
  EXPECT_EQ(study.report.log_decrement, rows_of(study.parts.level_one, "shaft")[0].log_decrement);
  EXPECT_TRUE(first.parts.shafts.empty());
  EXPECT_TRUE(first.parts.level_one.empty());
}

// Cross-coupled stiffness is expected on one of them alone.
TEST(LateralShafts, HaveCrossCoupledStiffnessOnOneOfThem) {
  const TwoShafts machine{-1.5};
  LateralOptions how = TwoShafts::options(), alone = TwoShafts::options(1.5);
  how.anticipated = alone.anticipated = 5e5;
  how.has_anticipated = alone.has_anticipated = true;
  how.coupled_shaft = 1;
  const LateralReport found = lateral_report(machine.both(), how).report,
                      expected = lateral_report(machine.other_alone(), alone).report;
  expect_near(found.log_decrement, expected.log_decrement, "log decrement");
  expect_near(found.limit, expected.limit, "Q0");
  expect_near(found.critical_speed_ratio(), expected.critical_speed_ratio(), "ratio");
  const auto is_ratio = [](const LateralCheck& c) { return c.rule == LateralRule::coupling_ratio; };
  const auto check = std::ranges::find_if(found.checks, is_ratio);
  ASSERT_NE(check, found.checks.end());
  EXPECT_EQ(check->shaft, "other");
  EXPECT_EQ(std::ranges::count_if(found.checks, is_ratio), 1);
  how.coupled_shaft = 2;
  EXPECT_THROW(lateral_report(machine.both(), how), ModelError);
}

/// The same with a bearing between the shafts that carries the right end of the other one, in place
/// of one of its own.
Model two_spools(double ratio) {
  Model model = TwoShafts{ratio}.both();
  Structure& s = model.structure;
  std::erase_if(s.bearings, [](const Connection& b) { return b.name == "nde"; });
  s.bearings.push_back(test::connect(at(0.8), on_other(0.8), test::isotropic(2e7, 8e3)));
  s.bearings.back().name = "between";
  s.seals.clear();
  return model;
}

// The responses of every case, beside a solution of the full equations with loads of this test:
// unbalance of a shaft of ratio p turns with p Omega, and all shafts spin.
TEST(LateralShafts, RespondToUnbalanceOfEachAtItsOwnFrequency) {
  for (const double ratio : {1.5, -1.5}) {
    const Model model = two_spools(ratio);
    const LateralReport r = lateral_report(model, TwoShafts::options()).report;
    EXPECT_FALSE(rows_of(r.cases, "shaft").empty());
    EXPECT_FALSE(rows_of(r.cases, "other").empty());
    const Assembler assembler(model.structure);
    const auto points = named_points(model, assembler);
    const auto node_of = [&](const std::string& label) {
      const auto found = std::ranges::find(points, label, &NamedPoint::label);
      return found->point.index;
    };
    for (std::size_t k = 0; k < r.speeds.size(); k += r.speeds.size() / 3) {
      const double Omega = r.speeds[k];
      const auto full = assembler.full(Omega, Omega);
      const Mat M = full.M, C = full.D(), K = full.stiffness();
      for (const LateralResponse& response : r.responses) {
        const LateralCase& of = r.cases[static_cast<std::size_t>(response.of_case)];
        const double w = of.order * Omega, sense = of.shaft == "other" && ratio < 0.0 ? -1.0 : 1.0;
        CVec f = CVec::Zero(M.rows());
        for (const LateralPlane& p : r.planes) {
          if (p.of_case != response.of_case) continue;
          const int node = node_of(p.station);
          const Complex u = w * w * std::polar(p.moment, sense * p.phase);
          f(4 * node) += u, f(4 * node + 1) += Complex(0.0, -sense) * u;
        }
        const CMat Z = (K - w * w * M).cast<Complex>() + Complex(0.0, w) * C.cast<Complex>();
        const CVec q = Eigen::PartialPivLU<CMat>(Z).solve(f);
        const int node = node_of(r.probes[static_cast<std::size_t>(response.probe)].station);
        const double expected = 2.0 * Orbit(q(4 * node), q(4 * node + 1)).major();
        const double found = response.peak_to_peak(static_cast<Eigen::Index>(k));
        EXPECT_NEAR(found, expected, 1e-10 * q.cwiseAbs().maxCoeff()) << of.shaft << Omega;
      }
    }
  }
}

// The bearing between them carries the other shaft, and is a journal of that one.
TEST(LateralShafts, CountABearingBetweenThemForTheOneThatItCarries) {
  const LateralReport r = lateral_report(two_spools(1.5), TwoShafts::options()).report;
  std::vector<std::string> of_first, of_other;
  double on_other_ones = 0.0;
  for (const LateralJournal& j : rows_of(r.journals, "shaft")) of_first.push_back(j.name);
  for (const LateralJournal& j : rows_of(r.journals, "other")) {
    of_other.push_back(j.name);
    on_other_ones += j.mass;
  }
  EXPECT_EQ(of_first, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(of_other, (std::vector<std::string>{"de", "between"}));
  const double mass = 30.0 + 2.0 + 7810.0 * pi / 4.0 * 0.075 * 0.075 * 0.8;
  EXPECT_NEAR(on_other_ones, mass, 1e-9 * mass);
  for (const LateralPlane& p : rows_of(r.planes, "other")) {
    EXPECT_LE(p.moment, 2.0 * 6350e-6 * mass / (1.5 * 7000.0) * (1.0 + 1e-9));
  }
}

TEST(LateralShafts, NeedConstantRatios) {
  Model model = two_spools(1.5);
  model.structure.rotors[0].lead = {0.0};
  model.structure.rotors[0].own = {900.0};
  try {
    lateral_report(model, TwoShafts::options());
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.problems().front().key, "rotor.other");
    EXPECT_NE(error.problems().front().message.find("a speed of its own"), std::string::npos);
  }
}

// A shaft that stands has no unbalance: it is a part of the others' supports.
TEST(LateralShafts, ThatStandHaveNoCases) {
  const LateralStudy study = lateral_report(TwoShafts{0.0}.both(), TwoShafts::options());
  EXPECT_EQ(study.parts.shafts.size(), 1u);
  EXPECT_TRUE(rows_of(study.report.cases, "other").empty());
  EXPECT_FALSE(rows_of(study.report.cases, "shaft").empty());
}

}  // namespace whirl::lateral_shafts_test

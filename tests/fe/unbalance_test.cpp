// Steady response to unbalance against the reference cases and closed forms.

#include "libfe/analyses/unbalance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/critical.hpp"
#include "tests/support/reference_cases.hpp"

namespace whirl::unbalance_test {

using test::at;
using test::Json;

constexpr double solves = 1e-9;  // relative; a small dynamic stiffness away from resonance

Point point_of(const Station& station, const Structure& s) {
  return Assembler(s).point(station);
}

// tests/data/rotors.json: complex displacements, computed by another code and in closed form.
TEST(UnbalanceResponse, IsThatOfTheReferenceCases) {
  int compared = 0;
  for (const Json& c : test::reference_cases()) {
    for (const Json& a : c.at("analyses")) {
      if (a.at("type") != "unbalance_response") continue;
      Structure s = test::structure_of(c);
      s.unbalances = {{.at = test::node_from_zero(a.at("node")),
                       .moment = a.at("unbalance_kg_m"),
                       .phase = a.at("phase_rad")}};
      const Assembler assembler(s);
      const auto compare = [&](const Json& rows, const Json& common_rtol) {
        for (const Json& row : rows) {
          const double Omega = row.at("speed_rad_s");
          const double rtol = row.contains("rtol") ? row.at("rtol") : common_rtol;
          const Point p = assembler.point(test::node_from_zero(row.at("node")));
          const UnbalanceResponse r = unbalance_response(assembler, {Omega}, {p});
          const Complex x(row.at("x")[0], row.at("x")[1]), y(row.at("y")[0], row.at("y")[1]);
          const double size = std::hypot(std::abs(x), std::abs(y));
          SCOPED_TRACE(c.at("id").get<std::string>() + " at " + std::to_string(Omega));
          EXPECT_LT(std::abs(r.x(0, 0) - x), rtol * size);
          EXPECT_LT(std::abs(r.y(0, 0) - y), rtol * size);
          ++compared;
        }
      };
      compare(a.at("expected"), a.at("rtol"));
      if (a.contains("published")) compare(a.at("published"), a.at("rtol"));
    }
  }
  EXPECT_GE(compared, 38);
}

// z = x + i y = U Omega^2 e^(i (Omega t + p)) / (k - m Omega^2 + i c Omega): in phase below,
// opposite far above, a quarter turn behind at resonance. x = Re(X e^(i Omega t)), y = Re(-i X e^(i
// Omega t)).
TEST(UnbalanceResponse, OfAJeffcottRotorHasTheAmplitudeAndPhaseOfItsClosedForm) {
  const test::Jeffcott jeffcott;
  const double U = 2e-4, phase = 0.7, w = jeffcott.omega(), k = jeffcott.k();
  const double c = 0.1 * std::sqrt(k * jeffcott.m);
  Structure s = jeffcott.structure();
  s.bearings.push_back(test::bearing(test::node(2), test::isotropic(0.0, c)));
  s.unbalances = {{.at = test::node(2), .moment = U, .phase = phase}};
  const std::vector<double> speeds{0.0, 0.1 * w, w, 10.0 * w};
  const Point middle = point_of(test::node(2), s);
  const UnbalanceResponse r = unbalance_response(Assembler(s), speeds, {middle});
  EXPECT_EQ(r.speeds, speeds);
  EXPECT_EQ(r.points, std::vector<Point>{middle});
  EXPECT_EQ(r.x(0, 0), Complex(0.0));
  EXPECT_EQ(r.y(0, 0), Complex(0.0));
  for (Eigen::Index i = 1; i < 4; ++i) {
    const double Omega = speeds[static_cast<std::size_t>(i)];
    const Complex X = U * Omega * Omega * std::polar(1.0, phase) /
                      Complex(k - jeffcott.m * Omega * Omega, c * Omega);
    EXPECT_LT(std::abs(r.x(0, i) - X), solves * std::abs(X));
    EXPECT_LT(std::abs(r.y(0, i) - Complex(0.0, -1.0) * X), solves * std::abs(X));
  }
  EXPECT_NEAR(std::arg(r.x(0, 2)), phase - test::pi / 2.0, solves);  // lags by a quarter turn
  EXPECT_NEAR(std::arg(r.x(0, 1)), phase, 0.02);                     // nearly in phase
}

// Unbalances add up with their phases: opposite equal ones at one place cancel, and the response to
// both of two is the sum of the responses to each.
TEST(UnbalanceResponse, IsLinearInTheUnbalances) {
  Structure s = test::two_disk(test::orthotropic(1e6, 8e5, 100.0, 100.0));
  const Unbalance one{.at = at(0.5), .moment = 1e-3, .phase = 0.4};
  const Unbalance other{.at = at(1.0), .moment = 2e-3, .phase = 2.5};
  const auto response = [&](const std::vector<Unbalance>& unbalances) {
    s.unbalances = unbalances;
    return unbalance_response(Assembler(s), {150.0, 400.0},
                              {point_of(at(0.5), s), point_of(at(1.5), s)})
        .x;
  };
  const CMat a = response({one}), b = response({other}), both = response({one, other});
  EXPECT_LT((both - a - b).norm(), solves * both.norm());
  Unbalance opposite = one;
  opposite.phase += test::pi;
  EXPECT_LT(response({one, opposite}).norm(), solves * a.norm());
}

// A massless shaft is not condensed here, and a body that spins carries unbalance as a disk does.
TEST(UnbalanceResponse, OfABodyThatSpinsIsThatOfItsClosedForm) {
  const double m = 3.0, k = 2.7e4, U = 1e-4, Omega = 50.0;
  Structure s{.bodies = {{.name = "rotor", .m = m, .spins = true}},
              .bearings = {test::bearing(test::body("rotor"), test::isotropic(k))}};
  s.unbalances = {{.at = test::body("rotor"), .moment = U}};
  const UnbalanceResponse r =
      unbalance_response(Assembler(s), {Omega}, {point_of(test::body("rotor"), s)});
  const double exact = U * Omega * Omega / (k - m * Omega * Omega);
  EXPECT_LT(std::abs(r.x(0, 0) - exact), solves * exact);
}

// Bearings by a table: k(Omega) in the same formula.
TEST(UnbalanceResponse, TakesTheBearingsOfTheSpeed) {
  const double m = 3.0, U = 1e-4;
  const TableBearing table{
      {.speed = {0.0, 100.0}, .rows = {test::isotropic(1e4), test::isotropic(3e4, 40.0)}}};
  Structure s{.bodies = {{.name = "rotor", .m = m, .spins = true}},
              .bearings = {test::bearing(test::body("rotor"), AnyBearing(table))}};
  s.unbalances = {{.at = test::body("rotor"), .moment = U}};
  const std::vector<double> speeds{20.0, 50.0, 100.0};
  const UnbalanceResponse r =
      unbalance_response(Assembler(s), speeds, {point_of(test::body("rotor"), s)});
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double Omega = speeds[static_cast<std::size_t>(i)];
    const double k = 1e4 + 200.0 * Omega, c = 0.4 * Omega;
    const Complex exact = U * Omega * Omega / Complex(k - m * Omega * Omega, c * Omega);
    EXPECT_LT(std::abs(r.x(0, i) - exact), solves * std::abs(exact));
  }
}

// The response grows beyond all bounds only at forward critical speeds of an isotropic rotor:
// unbalance does not drive backward whirl.
TEST(UnbalanceResponse, PeaksAtForwardCriticalSpeedsOnly) {
  Structure s = test::two_disk(test::isotropic(1e6));
  s.unbalances = {{.at = at(0.5), .moment = 1e-3}};
  const Assembler assembler(s);
  const std::vector<Point> points{assembler.point(at(0.5))};
  int forward = 0;
  for (const Critical& c : critical_speeds(assembler, {.count = 4})) {
    const double beside = 1.0 + 1e-6;  // relative distance from the resonance
    const UnbalanceResponse r = unbalance_response(assembler, {beside * c.speed}, points);
    const bool is_large = std::abs(r.x(0, 0)) > 1.0;  // [m], from 1e-3 kg.m
    EXPECT_EQ(is_large, c.whirl == Whirl::forward) << c.speed;
    forward += is_large ? 1 : 0;
  }
  EXPECT_EQ(forward, 2);
}

// Undamped, m Omega^2 = k in numbers without rounding: nothing bounds the response.
TEST(UnbalanceResponse, AtAnUndampedResonanceIsAnError) {
  Structure s{.bodies = {{.name = "rotor", .m = 1.0, .spins = true}},
              .bearings = {test::bearing(test::body("rotor"), test::isotropic(16.0))}};
  s.unbalances = {{.at = test::body("rotor"), .moment = 1e-4}};
  EXPECT_THROW(unbalance_response(Assembler(s), {4.0}, {point_of(test::body("rotor"), s)}),
               NumericalError);
}

}  // namespace whirl::unbalance_test

// Where journals run on their oil films, the coefficients there, and where rotors on them become
// unstable: a table by quadrature, closed forms, and motions.

#include "libdyn/system/film_equilibrium.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/error.hpp"
#include "libdyn/linear/static_study.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "tests/support/oil_films.hpp"

namespace whirl::film_equilibrium_test {

using std::numbers::pi;
using test::MassOnFilm;

/// Load of a short half film over s Omega, s = viscosity R L^3 / (4 c^2) [Ocvirk].
double load_at(double e) {
  const double Q = (1.0 - e) * (1.0 + e);
  return e * std::sqrt(16.0 * e * e + pi * pi * Q) / (Q * Q);
}

/// A mass that runs at an eccentricity at a speed: its oil is as thick as that takes.
MassOnFilm running_at(double e, double Omega) {
  MassOnFilm rotor{.Omega = Omega};
  rotor.bearing.viscosity *=
      rotor.m * rotor.gravity / (Short::factor(rotor.bearing) * Omega * load_at(e));
  return rotor;
}

// Coefficients are those of the equilibrium, bit by bit, found once: asked again they are the same
// place.
TEST(FilmEquilibrium, RemembersTheCoefficientsOfEachSpeed) {
  const Model model = running_at(0.4, 300.0).model();
  const FilmEquilibrium equilibrium(model);
  const auto& first = equilibrium.coefficients(300.0);
  const auto& other = equilibrium.coefficients(250.0);
  EXPECT_EQ(&equilibrium.coefficients(300.0), &first);
  EXPECT_EQ(first.at(0).K, equilibrium.at(300.0)->films.at(0).stiffness);
  EXPECT_EQ(first.at(0).C, equilibrium.at(300.0)->films.at(0).damping);
  EXPECT_NE(other.at(0).K, first.at(0).K);
  for (int ask = 0; ask < 2; ++ask) {  // without speed a film carries nothing, whenever it is asked
    EXPECT_THROW(equilibrium.coefficients(0.0), NumericalError);
  }
}

RunningFilm running(const Model& model) {
  return FilmEquilibrium(model).at(model.speed)->films.at(0);
}

/// A short half film under a load along -y, by quadrature and differences, independent of whirl:
/// attitude [deg], coefficients in W / c and W / (c Omega), threshold of a rigid rotor in
/// (W / (m c))^(1/2); and what this table calls the whirl over the spin there.
struct Row {
  double e, attitude, K[4], C[4], threshold, whirl;
};
constexpr Row table[] = {{0.2,
                          75.4312,
                          {2.48493, 4.52028, -5.76309, 1.49782},
                          {9.58694, -2.49163, -2.49163, 10.97979},
                          2.68141,
                          0.51056},
                         {0.4,
                          60.9396,
                          {2.31889, 1.57148, -4.04779, 2.24931},
                          {4.21644, -2.34301, -2.34301, 7.02210},
                          2.54458,
                          0.52380},
                         {0.6,
                          46.3207,
                          {2.09171, 0.30706, -4.13769, 3.95122},
                          {2.23890, -2.13799, -2.13799, 6.65067},
                          2.70100,
                          0.65298},
                         {0.7,
                          38.7040,
                          {1.96955, -0.17339, -4.53474, 5.65943},
                          {1.62395, -2.02673, -2.02673, 7.09866},
                          3.62770,
                          0.62768},
                         {0.8,
                          30.5002,
                          {1.84770, -0.67391, -5.32635, 9.04232},
                          {1.12807, -1.91508, -1.91508, 8.17685},
                          0.0,
                          0.0}};
constexpr double differences =
    1e-4;  // what the table's coefficients are right to; they are to 2e-5

/// Of a rigid rotor with coefficients in W / c and W / (c Omega), by the rule of Routh: the
/// frequency at which it whirls at the threshold in (W / (m c))^(1/2), and that over the spin.
///
///   w^2 = (K_xx C_yy + K_yy C_xx - K_xy C_yx - K_yx C_xy) / (C_xx + C_yy)
///   (w / Omega)^2 = ((K_xx - w^2) (K_yy - w^2) - K_xy K_yx) / (C_xx C_yy - C_xy C_yx)
std::pair<double, double> whirl_at_threshold(const double (&K)[4], const double (&C)[4]) {
  const double square = (K[0] * C[3] + K[3] * C[0] - K[1] * C[2] - K[2] * C[1]) / (C[0] + C[3]);
  const double ratio =
      ((K[0] - square) * (K[3] - square) - K[1] * K[2]) / (C[0] * C[3] - C[1] * C[2]);
  return {std::sqrt(square), std::sqrt(ratio)};
}

TEST(FilmEquilibrium, HasTheCoefficientsOfTheTable) {
  for (const Row& row : table) {
    SCOPED_TRACE(row.e);
    const MassOnFilm rotor = running_at(row.e, 300.0);
    const RunningFilm film = running(rotor.model());
    const double W = rotor.m * rotor.gravity, c = rotor.bearing.clearance;
    EXPECT_NEAR(film.eccentricity, row.e, 1e-11);
    EXPECT_NEAR(film.attitude_deg(), row.attitude, 1e-4);
    EXPECT_NEAR(film.load(0), 0.0, 1e-10 * W);
    EXPECT_NEAR(film.load(1), -W, 1e-10 * W);
    EXPECT_NEAR(film.thickness, (1.0 - row.e) * c, 1e-10 * c);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(film.stiffness(i / 2, i % 2) * c / W, row.K[i], differences) << i;
      EXPECT_NEAR(film.damping(i / 2, i % 2) * c * 300.0 / W, row.C[i], differences) << i;
    }
  }
}

/// The Campbell diagram of a mass on a film around a speed.
Campbell around(const MassOnFilm& rotor, double Omega) {
  std::vector<double> speeds;
  for (int i = -5; i <= 5; ++i) speeds.push_back(Omega * (1.0 + 0.021 * i));
  return campbell(Assembler(linear_structure(rotor.model())), speeds, 4);
}

// The eccentricity falls along the diagram: at the threshold it is that of the row. Of its
// coefficients follow threshold and whirl by Routh's rule. The last column is the whirl of the mode
// that whirls fastest: at 0.2 and 0.4 that is the one at its threshold, at 0.6 and 0.7 the other
// one, which is damped.
TEST(FilmEquilibrium, HasTheThresholdsOfTheTable) {
  for (const Row& row : table) {
    const auto [whirl, ratio] = whirl_at_threshold(row.K, row.C);
    if (row.threshold == 0.0) {
      EXPECT_TRUE(std::isnan(ratio));
      continue;
    }
    SCOPED_TRACE(row.e);
    EXPECT_NEAR(whirl / ratio, row.threshold, differences);
    const double Omega = row.threshold * std::sqrt(9.81 / 1e-4);
    const MassOnFilm rotor = running_at(row.e, Omega);
    const Campbell diagram = around(rotor, 1.01 * Omega);
    ASSERT_EQ(diagram.thresholds.size(), 1u);
    EXPECT_NEAR(diagram.thresholds[0].speed / Omega, 1.0, differences);
    EXPECT_NEAR(diagram.thresholds[0].frequency / Omega, ratio, differences);
    EXPECT_TRUE(diagram.thresholds[0].is_followed());
    double fastest = 0.0;
    const Modes modes = complex_modes(Assembler(linear_structure(rotor.model())).at(Omega), 4);
    for (const Mode& mode : modes.oscillatory) fastest = std::max(fastest, mode.frequency());
    EXPECT_NEAR(fastest / Omega, row.whirl, differences);
  }
}

TEST(FilmEquilibrium, IsStableAtAnySpeedWhereTheTableHasNoThreshold) {
  for (const double threshold : {1.0, 3.0, 10.0, 100.0}) {
    const MassOnFilm rotor = running_at(0.8, threshold * std::sqrt(9.81 / 1e-4));
    const Modes modes =
        complex_modes(Assembler(linear_structure(rotor.model())).at(rotor.Omega), 4);
    for (const Mode& mode : modes.oscillatory) EXPECT_LT(mode.lambda.real(), 0.0) << threshold;
    for (const Complex root : modes.overdamped) EXPECT_LT(root.real(), 0.0) << threshold;
  }
}

// From hardly any load to a film of a ten thousandth of the clearance.
TEST(FilmEquilibrium, IsFoundUnderLightAndHeavyLoads) {
  for (const double e : {1e-6, 1e-4, 0.01, 0.5, 0.9, 0.99, 0.999, 0.9999}) {
    MassOnFilm rotor = running_at(e, 300.0);
    rotor.offset = {2e-3, -1e-3};
    const RunningFilm film = running(rotor.model());
    EXPECT_NEAR(film.thickness, (1.0 - e) * rotor.bearing.clearance,
                1e-8 * (1.0 - e) * rotor.bearing.clearance)
        << e;
    EXPECT_NEAR(std::tan(film.attitude), pi * std::sqrt((1.0 - e) * (1.0 + e)) / (4.0 * e),
                1e-6 / e)
        << e;
  }
}

// Without a load the journal runs in the middle: K_xy = -K_yx = pi s Omega / c, C = 2 pi s / c, and
// whirls at half the speed, at the brink of stability if it had no inertia.
TEST(FilmEquilibrium, RunsInTheMiddleWithoutALoad) {
  const MassOnFilm rotor{.m = 1e-3, .gravity = 0.0};
  const double s = Short::factor(rotor.bearing), c = rotor.bearing.clearance;
  const RunningFilm film = running(rotor.model());
  EXPECT_EQ(film.eccentricity, 0.0);
  EXPECT_TRUE(std::isnan(film.attitude));
  EXPECT_TRUE(std::isnan(film.sommerfeld));
  const double k = pi * s * rotor.Omega / c, d = 2.0 * pi * s / c;
  EXPECT_NEAR(film.stiffness(0, 1), k, 1e-9 * k);
  EXPECT_NEAR(film.stiffness(1, 0), -k, 1e-9 * k);
  EXPECT_NEAR(film.stiffness(0, 0), 0.0, 1e-6 * k);
  EXPECT_NEAR(film.damping(0, 0), d, 1e-9 * d);
  EXPECT_NEAR(film.damping(0, 1), 0.0, 1e-6 * d);
  const Modes modes = complex_modes(Assembler(linear_structure(rotor.model())).at(rotor.Omega), 2);
  ASSERT_EQ(modes.oscillatory.size(), 1u);
  EXPECT_NEAR(modes.oscillatory[0].frequency() / rotor.Omega, 0.5, 1e-3);
}

// Petroff's power in the middle; Sommerfeld's number of a bearing as books have it.
TEST(FilmEquilibrium, TellsSommerfeldsNumberAndThePower) {
  const MassOnFilm light{.gravity = 0.0};
  const JournalBearing& b = light.bearing;
  const double petroff = 2.0 * pi * b.viscosity * std::pow(light.Omega, 2) * std::pow(b.radius, 3) *
                         b.length / b.clearance;
  EXPECT_NEAR(running(light.model()).power_loss, petroff, 1e-12 * petroff);
  for (const double e : {0.3, 0.9}) {
    const MassOnFilm rotor = running_at(e, 300.0);
    const RunningFilm film = running(rotor.model());
    const double W = rotor.m * rotor.gravity, Q = 1.0 - e * e;
    // S (L / D)^2 = Q^2 / (pi e (pi^2 Q + 16 e^2)^(1/2))
    const double ratio = rotor.bearing.length / (2.0 * rotor.bearing.radius);
    EXPECT_NEAR(film.sommerfeld * ratio * ratio,
                Q * Q / (pi * e * std::sqrt(pi * pi * Q + 16.0 * e * e)), 1e-9);
    // journal and bearing: their moments differ by that of the load, W c e sin(attitude)
    const double shear = 2.0 * pi * rotor.bearing.viscosity * 300.0 *
                         std::pow(rotor.bearing.radius, 3) * rotor.bearing.length /
                         (rotor.bearing.clearance * std::sqrt(Q));
    const double moment = shear + 0.5 * W * rotor.bearing.clearance * e * std::sin(film.attitude);
    EXPECT_NEAR(film.power_loss, 300.0 * moment, 1e-9 * film.power_loss);
  }
}

/// Journals at both ends of a light shaft with a disk, on equal films; a third bearing in the
/// middle if it has a stiffness.
Model flexible(double k_middle = 0.0, double Omega = 300.0) {
  Model model;
  model.speed = Omega;
  model.has_speed = true;
  Structure& s = model.structure;
  s.bodies = {{.name = "left", .m = 2.0, .spins = true},
              {.name = "disk", .m = 30.0, .spins = true},
              {.name = "right", .m = 2.0, .spins = true}};
  for (const char* end : {"left", "right"}) {
    Connection link = test::bearing(test::body(end), test::isotropic(10e6, 0.0));
    link.to = test::body("disk");
    s.links.push_back(link);
    model.films.push_back(
        {.name = end,
         .at = test::body(end),
         .bearing = {.radius = 0.025, .length = 0.012, .clearance = 1e-4, .viscosity = 0.02}});
  }
  if (k_middle > 0.0) {
    s.bearings.push_back(test::bearing(test::body("disk"), test::isotropic(k_middle, 100.0)));
  }
  s.gravity = 9.81;
  return model;
}

// In coordinates of the motion nothing is accelerated there.
void expect_at_rest(const Model& model) {
  const Scene scene = make_scene(model);
  const auto rotor = FilmEquilibrium(model).at(model.speed);
  const int n = scene.contacts.coordinates();
  Vec y = Vec::Zero(2 * n), a(n);
  y.head(n) = NearestCoordinates(scene).of(rotor->q);
  scene.contacts.acceleration(0.0, y.data(), a.data());
  EXPECT_LT(a.norm(), 1e-8 * scene.contacts.constant_load().norm());
}

TEST(FilmEquilibrium, LeavesNoAcceleration) {
  expect_at_rest(flexible());
  Model two_disks = test::TwoDisksOnFilms{}.model();
  two_disks.structure.unbalances.clear();
  expect_at_rest(two_disks);
  for (const double k : {1e4, 1e6, 1e8, 1e10}) expect_at_rest(flexible(k));
  Model unequal =
      flexible(1e7);  // one journal is pushed up against its wall, one lies on a housing
  unequal.films[0].offset = {3e-4, -5e-4};
  unequal.structure.bodies.push_back({.name = "housing", .m = 5.0});
  unequal.structure.bearings.push_back(
      test::bearing(test::body("housing"), test::isotropic(5e6, 100.0)));
  unequal.films[1].against = test::body("housing");
  expect_at_rest(unequal);
}

TEST(FilmEquilibrium, NeedsSpeedWhereNothingElseHoldsTheRotor) {
  const Model model = flexible(0.0, 0.0);
  EXPECT_THROW(FilmEquilibrium(model).at(0.0), NumericalError);
  // held by a spring, within the clearance
  const RunningFilm film = running(flexible(1e8, 0.0));
  EXPECT_EQ(film.load.norm(), 0.0);
  EXPECT_GT(film.eccentricity, 0.0);
  EXPECT_EQ(film.power_loss, 0.0);
}

// A body that nothing holds, even with the journals held.
TEST(FilmEquilibrium, SaysWhatIsFree) {
  Model model = flexible();
  model.structure.bodies.push_back({.name = "loose", .m = 1.0});
  EXPECT_THROW(FilmEquilibrium(model).at(300.0), ModelError);
}

TEST(FilmEquilibrium, BalancesTheLoadsOfBearings) {
  const Model model = flexible(2e6);
  const Assembler assembler(model.structure);
  const StaticStudy study = static_study(model, assembler);
  ASSERT_EQ(study.on_films.films.size(), 2u);
  const double weight = 34.0 * 9.81;
  double fy = study.at_rest.bearings.at(0).fy();
  double fx = study.at_rest.bearings.at(0).fx();
  for (const RunningFilm& film : study.on_films.films) fy += film.fy(), fx += film.fx();
  EXPECT_NEAR(fy, -weight, 1e-9 * weight);
  EXPECT_NEAR(fx, 0.0, 1e-9 * weight);
}

// A rest has no frequency: a bearing whose coefficients follow that of the whirl holds the rotor
// with those of 0 Hz, whatever the speed.
TEST(FilmEquilibrium, IsOneOfCoefficientsAtRest) {
  Model model = MassOnFilm{.Omega = 300.0}.model();
  const BearingCoefficients soft = test::isotropic(1e5, 0.0), stiff = test::isotropic(4e5, 0.0);
  Connection spring = test::bearing(test::body("journal"), soft);
  spring.coefficients = TableBearing{{.speed = {}, .rows = {soft, stiff}, .whirl = {0.0, 400.0}}};
  model.structure.bearings.push_back(spring);
  const StaticStudy study = static_study(model, Assembler(model.structure));
  const double weight = 10.0 * 9.81;
  const BearingLoad& held = study.at_rest.bearings.at(0);
  const RunningFilm& film = study.on_films.films.at(0);
  EXPECT_NEAR(held.fy() + film.fy(), -weight, 1e-9 * weight);
  EXPECT_NEAR(held.fx() + film.fx(), 0.0, 1e-9 * weight);
  EXPECT_NEAR(held.fy(), 1e5 * study.at_rest.displacement(1), 1e-9 * weight);
}

TEST(FilmEquilibrium, LeavesOutWhatIsNotToBeLinearized) {
  Model model = flexible(2e6);
  for (OilFilm& film : model.films) film.is_linearized = false;
  EXPECT_FALSE(has_linear_films(model));
  EXPECT_TRUE(linear_structure(model).linearized.empty());
  EXPECT_TRUE(static_study(model, Assembler(model.structure)).on_films.films.empty());
}

/// How much a small whirl in the least stable mode grows over 20 revolutions at a speed, above one
/// or below.
double growth(Model model, double Omega) {
  model.speed = Omega;
  const Scene scene = make_scene(model);
  const System system = linear_system(model, scene);
  const Modes modes = complex_modes(system, 6);
  const auto least = std::max_element(
      modes.oscillatory.begin(), modes.oscillatory.end(),
      [](const Mode& a, const Mode& b) { return a.lambda.real() < b.lambda.real(); });
  const NearestCoordinates nearest(scene);
  const int n = scene.contacts.coordinates();
  Vec y = Vec::Zero(2 * n), rest = Vec::Zero(2 * n);
  rest.head(n) = nearest.of(FilmEquilibrium(model).at(Omega)->q);
  const double size = 1e-4 * scene.contacts.length_scale();
  y.head(n) = rest.head(n) + size * nearest.of(least->shape.real());
  y.tail(n) = size * nearest.of((least->lambda * least->shape).real());
  MotionState state = test::state_of(y);
  const auto turn = [&](long revolutions) {
    const Integration run = test::run(scene, state, revolutions, {.tolerance = 1e-12});
    EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  };
  const auto largest = [&] {
    double most = 0.0;
    for (int i = 0; i < 8; ++i) {
      turn(1);
      most = std::max(most, distance(scene.contacts, state.y, rest));
    }
    return most;
  };
  const double before = largest();
  turn(20);
  return largest() / before;
}

// What the diagram calls a threshold is one of motions: 1 % below whirls die out, 1 % above they
// grow.
void expect_threshold(const Model& model, double first, double last) {
  std::vector<double> speeds;
  for (int i = 0; i <= 20; ++i) speeds.push_back(first + (last - first) * i / 20);
  const Campbell diagram = campbell(Assembler(linear_structure(model)), speeds, 4);
  ASSERT_GE(diagram.thresholds.size(), 1u);
  const double Omega = diagram.thresholds[0].speed;
  EXPECT_LT(growth(model, 0.99 * Omega), 0.98) << Omega;
  EXPECT_GT(growth(model, 1.01 * Omega), 1.02) << Omega;
}

TEST(FilmEquilibrium, TellsWhereARigidRotorBecomesUnstable) {
  expect_threshold(MassOnFilm{}.model(), 300.0, 1500.0);
}

TEST(FilmEquilibrium, TellsWhereAFlexibleRotorBecomesUnstable) {
  expect_threshold(flexible(), 300.0, 1500.0);
}

// Eigenvalues of the linearized rotor against those of the Jacobian of its equations of motion.
TEST(FilmEquilibrium, LinearizesTheEquationsOfMotion) {
  Model model = flexible(1e6, 500.0);
  model.structure.damping = {.mass = 0.5, .stiffness = 1e-5};  // of the rotor, not of its films
  const Scene scene = make_scene(model);
  const int n = scene.contacts.coordinates();
  Vec y = Vec::Zero(2 * n);
  y.head(n) = NearestCoordinates(scene).of(FilmEquilibrium(model).at(500.0)->q);
  Mat A = Mat::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  const Vec& scale = scene.contacts.state_scale();
  for (int i = 0; i < 2 * n; ++i) {
    const double h = 1e-5 * scale(i);
    Vec up = y, down = y, a(n), b(n);
    up(i) += h, down(i) -= h;
    scene.contacts.acceleration(0.0, up.data(), a.data());
    scene.contacts.acceleration(0.0, down.data(), b.data());
    A.col(i).tail(n) = (a - b) / (2.0 * h);
  }
  const CVec lambda = A.eigenvalues();
  for (const Mode& mode : complex_modes(linear_system(model, scene), 6).oscillatory) {
    EXPECT_LT((lambda.array() - mode.lambda).abs().minCoeff(), 1e-5 * std::abs(mode.lambda));
  }
}

// Unbalance by the linearized films against a motion that is small enough.
TEST(FilmEquilibrium, RespondsToUnbalanceAsMotionsDo) {
  Model model = flexible(0.0, 200.0);
  model.structure.unbalances = {{.at = test::body("disk"), .moment = 1e-8}};
  const auto u = UnbalanceSolver(Assembler(linear_structure(model))).at(200.0);
  ASSERT_TRUE(u);
  const Scene scene = make_scene(model);
  MotionState state = test::start_of(model, scene);
  const Integration run = test::run(scene, state, 200, {.tolerance = 1e-13});
  EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  const Vec rest = FilmEquilibrium(model).at(200.0)->q;
  const FullState full = full_state(scene, state);
  const Vec moved = full.displacement - scene.system.dofs.T * rest;
  const double size = u->cwiseAbs().maxCoeff();
  EXPECT_LT((moved - u->real()).cwiseAbs().maxCoeff(), 1e-3 * size);
}

// Of a symmetric rigid rotor both critical speeds lie where the frequency of the film's own
// stiffness meets the speed.
TEST(FilmEquilibrium, HasCriticalSpeedsOfItsFilms) {
  const MassOnFilm rotor = running_at(0.6, 250.0);
  const Assembler assembler(linear_structure(rotor.model()));
  const auto criticals = critical_speeds(assembler, {.count = 2, .start = 250.0});
  ASSERT_GE(criticals.size(), 1u);
  for (const Critical& c : criticals) {
    Mat2 K = Mat2(Mat(assembler.at(c.speed).K));
    K = (0.5 * (K + K.transpose())).eval();
    const Mat2 D = K - rotor.m * c.speed * c.speed * Mat2::Identity();
    EXPECT_NEAR(D.determinant() / K.squaredNorm(), 0.0, 1e-9);
  }
}

}  // namespace whirl::film_equilibrium_test

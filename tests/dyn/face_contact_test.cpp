// Face contacts: a disk that tilts against a plane, beside a ring.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "libbase/error.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/law_proofs.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::face_contact_test {

/// Disk on a massless cantilever between a ring and a face, set T of models/overhung_face_rub.toml.
struct OverhungDisk {
  double Omega = 230.0;
  double m = 0.573, It = 3.85e-4, Ip = 7.06e-4, L = 0.11723, EI = 20.37971, beta = 2.421527e-4;
  double rp = 0.05, gap = 7.1502e-4, kc = 451975.33, mu = 0.10086;
  double axial_gap = 3.9672e-4, kca = 91260.308, mua = 0.074972;
  double e = 4.0669e-4, phase = 0.0, gravity = 9.81;
  Slip slip = Slip::forward;
  double tolerance = 0.0;  ///< of smoothed slip [m/s]
  int faces = 1;           ///< further ones have 0.9, 0.8, ... of the clearance
  bool has_ring = true;

  Model model() const {
    Model s;
    s.speed = Omega;
    s.has_speed = true;
    Segment shaft = test::massless_cylinder(L, 0.01, 1);
    shaft.material.E *= EI / test::EI(shaft);
    const Station end = test::node(2);
    s.structure = test::cantilever(shaft);
    s.structure.disks = {{.name = "disk", .at = end, .m = m, .Id = It, .Ip = Ip}};
    s.structure.unbalances = {{.at = end, .moment = m * e, .phase = phase}};
    s.structure.damping.stiffness = beta;
    s.structure.gravity = gravity;
    if (has_ring) {
      s.contacts.push_back({.name = "ring",
                            .at = end,
                            .clearance = gap,
                            .friction = {.mu = mu, .slip = Slip::forward},
                            .law = Radial<>{.k = kc}});
    }
    for (int i = 0; i < faces; ++i) {
      s.contacts.push_back({.name = "face",
                            .at = end,
                            .clearance = (1.0 - 0.1 * i) * axial_gap,
                            .friction = {.mu = mua, .slip = slip, .tolerance = tolerance},
                            .law = Face<>{.k = kca, .radius = rp}});
    }
    return s;
  }
  Scene scene() const { return make_scene(model()); }

  /// Accelerations of (u_x, u_y, gamma_x, gamma_y), term by term.
  ///
  ///   m ux'' + (D q')_1 + k11 ux - k12 gy = m e n^2 cos nt + phiL (mu uy - ux) + phia mua sin tc
  ///   m uy'' + (D q')_2 + k11 uy + k12 gx
  ///       = m e n^2 sin nt - m g - phiL (mu ux + uy) - phia mua cos tc
  ///   It gx'' + Ip n gy' + (D q')_3 + k12 uy + k22 gx = -rp phia sin tc
  ///   It gy'' - Ip n gx' + (D q')_4 - k12 ux + k22 gy = +rp phia cos tc
  ///
  /// @param share  of mua that acts, by the slip velocity
  template <class Share>
  Vec acceleration(double nt, const Vec& q, const Vec& v, Share share) const {
    const double k11 = 12.0 * EI / (L * L * L), k12 = 6.0 * EI / (L * L), k22 = 4.0 * EI / L;
    Mat K(4, 4);
    K << k11, 0, 0, -k12, 0, k11, k12, 0, 0, k12, k22, 0, -k12, 0, 0, k22;
    const Vec elastic = K * q + beta * (K * v);
    const double r = std::hypot(q(0), q(1)), g = std::hypot(q(2), q(3)), rz = rp * g;
    const double phiL = has_ring && r > gap ? kc * (r - gap) / r : 0.0;
    const double sin_tc = q(2) / g, cos_tc = -q(3) / g;
    double phia = 0.0;
    for (int i = 0; i < faces; ++i) {
      phia += std::max(0.0, kca * (rz - (1.0 - 0.1 * i) * axial_gap));
    }
    const double vt = Omega * rp - sin_tc * v(0) + cos_tc * v(1);
    const double friction = phia * mua * share(vt);
    const double n2 = Omega * Omega;
    Vec a(4);
    a(0) =
        (m * e * n2 * std::cos(nt) + phiL * (mu * q(1) - q(0)) + friction * sin_tc - elastic(0)) /
        m;
    a(1) = (m * e * n2 * std::sin(nt) - m * gravity - phiL * (mu * q(0) + q(1)) -
            friction * cos_tc - elastic(1)) /
           m;
    a(2) = (-rp * phia * sin_tc - Ip * Omega * v(3) - elastic(2)) / It;
    a(3) = (+rp * phia * cos_tc + Ip * Omega * v(2) - elastic(3)) / It;
    return a;
  }
};

const OverhungDisk set_T;
OverhungDisk smoothed(double tolerance) {
  OverhungDisk p;
  p.slip = Slip::actual;
  p.tolerance = tolerance;
  return p;
}
OverhungDisk with_two_faces() {
  OverhungDisk p;
  p.faces = 2;
  return p;
}

/// Reduced coordinates of the disk's (x, y, theta_x, theta_y): full = map eta.
Mat map_of(const Scene& scene) {
  return scene.displacement_map().bottomRows(4);
}

MotionState settled(const OverhungDisk& p, const Scene& scene, long revolutions) {
  MotionState state = test::start_of(p.model(), scene);
  const Integration run = test::run(scene, state, revolutions, {.tolerance = 1e-12});
  EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  return state;
}

// In touch or not, with friction of the spin's sense and of the slip: 300 random states each.
TEST(FaceContact, AddsTheForcesOfItsEquations) {
  constexpr double rounding = 1e-12;  // relative: K q is some 1e3 of what it adds up to
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const OverhungDisk& p : {set_T, smoothed(5.0), with_two_faces()}) {
    const Scene scene = p.scene();
    ASSERT_EQ(scene.contacts.coordinates(), 4);
    const Mat inverse = map_of(scene).inverse();
    int touching = 0;
    for (int i = 0; i < 300; ++i) {
      Vec q(4), v(4);
      for (int k = 0; k < 4; ++k) {
        q(k) = any(random) * (k < 2 ? 1.5 * p.gap : 1.5 * p.axial_gap / p.rp);
        v(k) = any(random) * (k < 2 ? 30.0 : 30.0 / p.rp) * p.gap * p.Omega;
      }
      touching += p.rp * std::hypot(q(2), q(3)) > p.axial_gap ? 1 : 0;
      const double nt = 3.0 * any(random);
      Vec y(8), a(4);
      y << inverse * q, inverse * v;
      scene.contacts.acceleration(nt, y.data(), a.data());
      const Vec expected = p.acceleration(nt, q, v, [&](double vt) {
        return p.slip == Slip::forward ? 1.0 : std::tanh(vt / p.tolerance);
      });
      const Vec found = map_of(scene) * a;
      for (const int k : {0, 2}) {
        EXPECT_LT((found - expected).segment(k, 2).norm(), rounding * expected.norm());
      }
    }
    EXPECT_GT(touching, 100);
    EXPECT_LT(touching, 290);
  }
}

class FaceByMethod : public ::testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Methods, FaceByMethod,
                         ::testing::Values(std::pair("dop853", 1e-10),
                                           std::pair("cvode_adams", 1e-5),
                                           std::pair("cvode_bdf", 1e-4), std::pair("arkode", 1e-8),
                                           std::pair("arkode_dirk", 1e-5)),
                         [](const auto& member) { return member.param.first; });

// Through impacts on ring and face, against quadruple precision.
TEST_P(FaceByMethod, MovesAsInQuadruplePrecision) {
  const auto [name, accuracy] = GetParam();
  for (const OverhungDisk& p : {set_T, smoothed(5.0), with_two_faces()}) {
    const Scene scene = p.scene();
    const test::Stretch s{scene, settled(p, scene, 60), 2, 4};
    test::expect_end_by(name, s, test::exact_end(s, 1e-20), accuracy);
  }
}

TEST(FaceContact, ErrorFollowsTheTolerance) {
  for (const OverhungDisk& p : {set_T, smoothed(5.0)}) {
    const Scene scene = p.scene();
    const test::Stretch s{scene, settled(p, scene, 60), 3, 7};
    test::expect_error_follows_tolerance(s, test::exact_end(s, 1e-22));
  }
}

// RK4 without events, fourth order while nothing begins or ends to touch: a disk that is pressed
// into ring and face for good.
TEST(FaceContact, IsOfFourthOrderByRk4AloneAndInLanes) {
  OverhungDisk p = smoothed(5.0);
  p.gravity = 9.81 * 60.0;
  p.e = 2e-5;
  const Scene scene = p.scene();
  const MotionState start = settled(p, scene, 60);
  for (const ContactState& c : start.contacts) ASSERT_TRUE(c.in_touch());
  MotionState exact = start;
  test::run(scene, exact, 2, {.tolerance = 1e-14});
  std::vector<double> number, error;
  for (const double n : {400.0, 800.0, 1600.0}) {
    const double h = scene.contacts.period() / n;
    MotionState alone = start;
    test::run(scene, alone, 2, {.fixed_step = h, .method = Rk4{}});
    number.push_back(n);
    error.push_back(distance(scene.contacts, alone.y, exact.y));
    std::vector<Trajectory> lanes(3, {.system = &scene.contacts, .state = start, .revolutions = 2});
    integrate_batch_rk4(lanes, {.fixed_step = h});
    EXPECT_LT(distance(scene.contacts, lanes[2].state.y, alone.y), 1e-11);
  }
  EXPECT_NEAR(test::order_of(number, error), 4.0, 0.1);
}

// Lanes with other parameters, kinds of friction and lengths move as each would alone, bit by bit.
TEST(FaceContact, InABatchIsBitwiseTheSameAsAlone) {
  std::vector<Scene> scenes;
  std::vector<MotionState> starts;
  for (int i = 0; i < 37; ++i) {
    OverhungDisk p = i % 3 == 0 ? smoothed(1.0 + i) : set_T;
    p.Omega = 200.0 + 5.0 * i;
    p.mua = i % 4 == 0 ? 0.0 : 0.05;
    p.faces = 2;
    scenes.push_back(p.scene());
    starts.push_back(test::start_of(p.model(), scenes.back()));
  }
  test::expect_same_alone(scenes, starts, 1e-9, 500);
}

// Through impacts: against central differences, and the determinant against the divergence.
TEST(FaceTangent, IsTheLimitOfDifferences) {
  constexpr double accurate = 1e-6;  // 1e-14 / h of rounding, h^2 of curvature, tens of that
  for (const OverhungDisk& p : {set_T, smoothed(5.0), smoothed(20.0), with_two_faces()}) {
    const Scene scene = p.scene();
    const test::Stretch s{scene, settled(p, scene, 60), 2, 4};
    test::expect_tangent_of_differences(s, accurate);
    test::expect_divergence(s);
  }
}

// Without gravity, space has no direction: start and unbalance turned, the end is turned.
TEST(FaceContact, KnowsNoDirection) {
  OverhungDisk p = smoothed(5.0);
  p.gravity = 0.0;
  p.Omega = 260.0;
  const double angle = 1.1;
  OverhungDisk turned = p;
  turned.phase = angle;
  Mat R = Mat::Zero(4, 4);
  for (const int i : {0, 2}) {
    R.block(i, i, 2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  }
  Vec q(4), v(4);
  q << 3e-4, -1e-4, 2e-3, 4e-3;
  v << 0.1, 0.05, -1.0, 0.5;
  const auto end = [](const OverhungDisk& rotor, const Vec& place, const Vec& velocity) -> Vec {
    const Scene scene = rotor.scene();
    const Mat inverse = map_of(scene).inverse();
    MotionState state = test::state_of((Vec(8) << inverse * place, inverse * velocity).finished());
    const Integration run = test::run(scene, state, 3, {.tolerance = 1e-13});
    EXPECT_GT(run.cost.events, 6);
    return map_of(scene) * state.y.head(4);
  };
  const Vec expected = R * end(p, q, v), found = end(turned, R * q, R * v);
  EXPECT_LT((found - expected).head(2).norm(), 1e-9 * p.gap);
  EXPECT_LT((found - expected).tail(2).norm(), 1e-9 * p.axial_gap / p.rp);
}

// Without friction, damping and unbalance nothing is lost: gyroscopics do no work, the face is a
// spring of potential k d^2 / 2.
TEST(FaceContact, KeepsTheEnergy) {
  OverhungDisk p;
  p.mu = p.mua = p.beta = p.e = p.gravity = 0.0;
  const Scene scene = p.scene();
  const Mat map = map_of(scene), inverse = map.inverse();
  const double k11 = 12.0 * p.EI / std::pow(p.L, 3), k12 = 6.0 * p.EI / (p.L * p.L),
               k22 = 4.0 * p.EI / p.L;
  const auto energy = [&](const Vec& y) {
    const Vec q = map * y.head(4), v = map * y.tail(4);
    const double d = std::max(0.0, std::hypot(q(0), q(1)) - p.gap);
    const double da = std::max(0.0, p.rp * std::hypot(q(2), q(3)) - p.axial_gap);
    return 0.5 * (p.m * v.head(2).squaredNorm() + p.It * v.tail(2).squaredNorm() +
                  k11 * q.head(2).squaredNorm() + k22 * q.tail(2).squaredNorm() + p.kc * d * d +
                  p.kca * da * da) -
           k12 * (q(0) * q(3) - q(1) * q(2));
  };
  Vec q(4), v(4);
  q << 3e-4, -1e-4, 2e-3, 4e-3;
  v << 0.3, 0.05, -1.0, 2.0;
  MotionState state = test::state_of((Vec(8) << inverse * q, inverse * v).finished());
  const double before = energy(state.y);
  const Integration run = test::run(scene, state, 50, {.tolerance = 1e-13});
  ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  EXPECT_GT(run.cost.events, 200);
  EXPECT_NEAR(energy(state.y), before, 1e-9 * before);
}

// Against a body that tilts, too: what counts is the difference, and both get the same moment and
// the same friction, reversed.
TEST(FaceContact, WorksBetweenTwoBodiesThatTilt) {
  Model model;
  model.has_speed = true;
  model.structure.bodies = {
      {.name = "rotor", .m = 2.0, .spins = true, .tilts = true, .Id = 0.01, .Ip = 0.015},
      {.name = "stator", .m = 5.0, .tilts = true, .Id = 0.04}};
  model.speed = 100.0;
  model.contacts = {{.name = "face",
                     .at = test::body("rotor"),
                     .against = test::body("stator"),
                     .clearance = 1e-4,
                     .friction = {.mu = 0.3, .slip = Slip::forward},
                     .law = Face<>{.k = 1e6, .radius = 0.1}}};
  const Scene scene = make_scene(model);
  const Mat map = scene.displacement_map(), inverse = map.inverse();
  const auto push = [&](const Vec& q) -> Vec {
    Vec y = Vec::Zero(16), a(8);
    y.head(8) = inverse * q;
    scene.contacts.acceleration(0.0, y.data(), a.data());
    return map * a;
  };
  Vec q = Vec::Zero(8);
  q.segment(2, 2) << 3e-3, -4e-3;
  q.segment(6, 2) = q.segment(2, 2);
  EXPECT_EQ(push(q).norm(), 0.0);  // tilted alike
  q.segment(6, 2).setZero();       // d = 0.1 * 5e-3 - 1e-4
  const double N = 1e6 * 4e-4, T = 0.3 * N;
  const Vec a = push(q);
  const double exact = 1e-9 * N;
  EXPECT_NEAR(2.0 * a(0), T * 0.6, exact);  // sin tc = 0.6, cos tc = 0.8
  EXPECT_NEAR(2.0 * a(1), -T * 0.8, exact);
  EXPECT_NEAR(0.01 * a(2), -0.1 * N * 0.6, exact);
  EXPECT_NEAR(0.01 * a(3), 0.1 * N * 0.8, exact);
  EXPECT_LT((2.0 * a.head(2) + 5.0 * a.segment(4, 2)).norm(), exact);
  EXPECT_LT((0.01 * a.segment(2, 2) + 0.04 * a.segment(6, 2)).norm(), exact);
}

// At rest on the face: the moment of the disk's weight tilts it against its spring.
TEST(FaceContact, HoldsTheStaticSag) {
  OverhungDisk p;
  p.axial_gap = 2e-4;
  p.gravity = 9.81 * 10.0;
  const Scene scene = p.scene();
  const MotionState start = test::start_of(p.model(), scene);
  const Vec q = map_of(scene) * start.y.head(4);
  OverhungDisk still = p;
  still.e = still.mu = still.mua = 0.0;
  const Vec left = still.acceleration(0.0, q, Vec::Zero(4), [](double) { return 1.0; });
  EXPECT_GT(p.rp * std::hypot(q(2), q(3)), p.axial_gap);
  EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-6 * p.gravity / p.rp);
}

TEST(FaceContact, IsNothingForCollocation) {
  const Scene scene = set_T.scene();
  EXPECT_FALSE(Collocation::abilities.can(scene.contacts));
  EXPECT_FALSE(prefers_collocation(scene.contacts));
  MotionState state = test::start_of(set_T.model(), scene);
  EXPECT_THROW(test::run(scene, state, 1, {.method = Collocation{}}), ModelError);
}

// Tilts without inertia cannot be pushed.
TEST(FaceContact, NeedsRotaryInertia) {
  OverhungDisk p;
  p.It = p.Ip = 0.0;
  try {
    p.scene();
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("without rotary inertia"), std::string::npos);
  }
}

}  // namespace whirl::face_contact_test

// Curves of bifurcations in two parameters: maps where they are known exactly, and the touch of a
// rotor in closed form.

#include "libdyn/branches/bifurcation_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <optional>

#include "libbase/error.hpp"
#include "libdyn/studies/bifurcation_curves.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/flows.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::bifurcation_curve_test {

using enum BifurcationKind;

constexpr double located = 1e-7;  ///< of both parameters

/// x' = a - x^2 + b y, y' = x
Flow henon(double a, double b) {
  return test::map_flow(2, [=](const Vec& y, Vec& f, Mat& J) {
    f << a - y(0) * y(0) + b * y(1), y(0);
    J << -2.0 * y(0), b, 1.0, 0.0;
  });
}

/// The whole border through (x, first), along the second parameter from the first to its last
/// value.
Branch border(BifurcationKind kind, const FlowPlane& flows, const Vec& scale, const Vec& x,
              double first, const ContinuationOptions& second) {
  constexpr double low = -2.0, high = 4.0;
  Vec start(x.size() + 1);
  start << x, (first - low) / (high - low);
  Continuation walk(bifurcation_curve_equations(kind, flows, scale, low, high), start, second);
  while (walk.advance()) {
  }
  Branch branch = walk.branch();
  for (BranchPoint& p : branch.points) {  // the first parameter itself
    double& u = p.z(x.size());
    u = low + u * (high - low);
  }
  return branch;
}

// Henon's map: fold at a = -(1 - b)^2 / 4, x = -(1 - b) / 2; period doubling at a = 3 (1 - b)^2 /
// 4, x = (1 - b) / 2; the doubled orbit doubles at a = (1 - b)^2 + (1 + b)^2 / 4.
TEST(BifurcationCurve, FollowsFoldsAndPeriodDoublingsOfHenonsMap) {
  const FlowPlane plane{henon, {}};
  const ContinuationOptions b{.low = -0.5, .high = 0.5, .first = -0.5};
  const Branch folds = border(fold, plane, Vec::Ones(2), Vec::Constant(2, -0.74), -0.55, b);
  EXPECT_TRUE(folds.ends_as(EndKind::range)) << folds.end_text();
  for (const BranchPoint& p : folds.points) {
    EXPECT_NEAR(p.z(2), -0.25 * std::pow(1.0 - p.value, 2), located);
    EXPECT_NEAR(p.z(0), -0.5 * (1.0 - p.value), located);
    ASSERT_EQ(p.multipliers.size(), 1);
    EXPECT_NEAR(p.multipliers(0).real(), -p.value, located);  // mu_1 mu_2 = -b
  }
  const Branch doublings =
      border(period_doubling, plane, Vec::Ones(2), Vec::Constant(2, 0.74), 1.7, b);
  EXPECT_EQ(doublings.points.back().value, 0.5);
  for (const BranchPoint& p : doublings.points) {
    EXPECT_NEAR(p.z(2), 0.75 * std::pow(1.0 - p.value, 2), located);
  }
  const double u = 1.5, a = u * u + 0.0625;  // at b = -0.5
  const double root = std::sqrt(a - 0.75 * u * u);
  const Vec two{{0.5 * u + root, 0.5 * u - root, 0.5 * u - root, 0.5 * u + root}};
  const Branch second = border(period_doubling, plane, Vec::Ones(2), two, a + 1e-3, b);
  EXPECT_EQ(second.points.back().value, 0.5);
  for (const BranchPoint& p : second.points) {
    EXPECT_NEAR(p.z(4), std::pow(1.0 - p.value, 2) + 0.25 * std::pow(1.0 + p.value, 2), located);
  }
}

// z' = (1 + a - b^2) e^i z - |z|^2 z: the fixed point z = 0 loses its stability at a = b^2.
TEST(BifurcationCurve, FollowsNeimarkSackerPoints) {
  const auto flow = [](double a, double b) {
    return test::map_flow(2, [=](const Vec& y, Vec& f, Mat& J) {
      const double s = 1.0 + a - b * b, c = std::cos(1.0), d = std::sin(1.0), r2 = y.squaredNorm();
      J << s * c, -s * d, s * d, s * c;
      f = J * y - r2 * y;
      J -= r2 * Mat::Identity(2, 2) + 2.0 * y * y.transpose();
    });
  };
  const Branch curve = border(neimark_sacker, {flow, {}}, Vec::Ones(2), Vec::Zero(2), 0.9,
                              {.low = -1.0, .high = 1.0, .first = -1.0});
  EXPECT_TRUE(curve.ends_as(EndKind::range)) << curve.end_text();
  for (const BranchPoint& p : curve.points) {
    EXPECT_NEAR(p.z(2), p.value * p.value, located);
    EXPECT_EQ(p.multipliers.size(), 0);
  }
  EXPECT_THROW(bifurcation_curve_equations(pitchfork, {flow, {}}, Vec::Ones(2), 0.0, 1.0),
               NumericalError);
}

/// Derivatives of the residual by the states, by the first parameter and by the second, by
/// differences of the eighth order.
Mat differences(const BranchEquations& equations, const Vec& x, double second, double step) {
  const auto residual = [&](const Vec& at, double b) {
    return equations.at(at, b, WithTangent::no).residual;
  };
  Mat slopes = Mat::Zero(x.size(), x.size() + 1);
  for (std::size_t j = 0; j < neighbor_places.size(); ++j) {
    const double by = neighbor_places[j] * step, weight = neighbor_weights[j] / step;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      slopes.col(k) += weight * residual(x + by * Vec::Unit(x.size(), k), second);
    }
    slopes.col(x.size()) += weight / second * residual(x, second * (1.0 + by));
  }
  return slopes;
}

/// Planes of two numbers of a rotor in its stator.
struct Plane {
  test::RotorStator rotor;
  double test::RotorStator::*first, test::RotorStator::*second;
  double low, high, at_first, at_second;
  int segments;
  double step = 0x1p-16;  ///< of differences
  double aspect = 1.0;    ///< of the ring, above 1 out of round

  PlaneScenes scenes() const {
    const auto at = [*this](double a, double b) {
      test::RotorStator r = rotor;
      r.*first = a;
      r.*second = b;
      Model model = r.model();
      if (aspect > 1.0) {
        model.contacts[0].geometry = geometry::Ellipse{.angle = 0.4, .aspect = aspect};
      }
      return std::make_shared<const Scene>(make_scene(model));
    };
    const ParameterEnds across{0.9 * at_second, 1.1 * at_second};
    return {at(at_first, at_second), at,
            std::make_shared<const PlaneSlopes>(at, ParameterEnds{low, high}, across)};
  }
  /// On the way of a motion, revolutions that do not quite meet; then u.
  Vec unknowns() const {
    const PlaneScenes all = scenes();
    const Scene& scene = *all.first;
    Trajectory t{.system = &scene.contacts, .revolutions = 50};
    t.state = test::start_of(rotor.model(), scene);
    const Vec scale = scene.contacts.state_scale();
    const Eigen::Index n = scale.size(), size = segments * n;
    Vec x(size + 1);
    for (Eigen::Index k = 0; k < size; k += n) {
      integrate_single(t, {});
      t.revolutions = 1;
      x.segment(k, n) = t.state.y.cwiseQuotient(scale);
    }
    x(size) = (at_first - low) / (high - low);
    return x;
  }
};

/// Whether a curve of a kind has the derivatives that differences tend to; nothing where there is
/// no such multiplier.
std::optional<bool> has_derivatives(const Plane& plane, BifurcationKind kind) {
  constexpr double bound = 1e-7;  // tangents have thirteen digits, of which impacts take some
  const PlaneScenes scenes = plane.scenes();
  const Vec x = plane.unknowns(), scale = scenes.first->contacts.state_scale();
  const auto equations =
      bifurcation_curve_equations(kind, flows_of(scenes), scale, plane.low, plane.high);
  const auto at = equations.at(x, plane.at_second, WithTangent::yes);
  if (at.residual.size() == 0) return std::nullopt;
  const Mat known = differences(equations, x, plane.at_second, plane.step);
  Mat told(x.size(), x.size() + 1);
  told << at.jacobian, at.slope();
  bool is_right = true;
  for (Eigen::Index k = 0; k < known.cols(); ++k) {
    is_right = is_right && (told.col(k) - known.col(k)).norm() < bound * known.col(k).norm();
  }
  const auto g = known.rows() - 1;
  return is_right && (told.row(g) - known.row(g)).norm() < bound * known.row(g).norm();
}

TEST(BifurcationCurve, HasTheDerivativesThatDifferencesTendTo) {
  using R = test::RotorStator;
  const R doubling{.Omega = 138.4, .kC = 64e6, .mu = 0.13};
  R damped = test::P1, hertz = test::P1, smoothed = test::P1;
  smoothed.slip_tolerance = 1.0;
  damped.cC = 2e4;
  hertz.kH = 1.5e8;
  std::map<BifurcationKind, int> seen;
  for (const Plane& plane :
       {Plane{doubling, &R::mu, &R::kC, 0.1, 0.15, 0.13, 64e6, 2, 0x1p-18},
        Plane{test::P1, &R::e, &R::Omega, 0.5e-3, 1.5e-3, 1e-3, 136.0, 2},
        Plane{damped, &R::cC, &R::Omega, 1e4, 3e4, 2e4, 136.0, 1},
        Plane{hertz, &R::kH, &R::mu, 1e8, 2e8, 1.5e8, 0.1, 1},
        Plane{smoothed, &R::gap, &R::mu, 5e-3, 7e-3, 6e-3, 0.1, 1, 0x1p-18, 1.2}}) {
    for (const auto kind : {fold, period_doubling, neimark_sacker, grazing}) {
      if (kind == grazing && plane.segments > 1) continue;  // revolutions hardly differ: which one?
      const auto right = has_derivatives(plane, kind);
      EXPECT_TRUE(right.value_or(true)) << static_cast<int>(kind);
      seen[kind] += right.has_value();
    }
  }
  for (const auto kind : {fold, neimark_sacker, grazing}) EXPECT_GT(seen[kind], 0);
}

// Of bearings that change the modes differences are left.
TEST(BifurcationCurve, HasNoDerivativesWhereShapesChange) {
  const auto slopes = [](int modes) {
    const auto at = [modes](double k, double mu) {
      return std::make_shared<const Scene>(
          test::TwoDiskRub{.k = k, .mu = mu, .modes = modes}.scene());
    };
    return std::make_unique<PlaneSlopes>(at, ParameterEnds{3e6, 5e6}, ParameterEnds{0.1, 0.2});
  };
  using enum PlaneParameter;
  EXPECT_FALSE(slopes(8)->panel_at(first, 4e6, 0.15));
  EXPECT_TRUE(slopes(8)->panel_at(second, 4e6, 0.15));
  EXPECT_TRUE(slopes(0)->panel_at(first, 4e6, 0.15));
}

// Below its critical speed the rotor alone turns in a circle, r = e W^2 / |w^2 - W^2 + 2 i d W|,
// around its sag, m g / k: it grazes the ring where both add up to the clearance. As plane: offset
// of the unbalance e in units of 1 mm, and the speed.
TEST(BifurcationCurve, FollowsGrazingsInClosedForm) {
  const auto at = [](double e, double W) {
    test::RotorStator p = test::P1;
    p.e = 1e-3 * e;
    p.Omega = W;
    return p;
  };
  const auto first = std::make_shared<const Scene>(at(1.0, 125.0).scene());
  const auto scene = [&](double e, double W) {
    return std::make_shared<const Scene>(at(e, W).scene());
  };
  const PlaneScenes scenes{
      first, scene,
      std::make_shared<const PlaneSlopes>(scene, ParameterEnds{0.5, 1.5}, ParameterEnds{110, 130})};
  const auto touching = [&](double W) {  // [mm]
    const test::RotorStator p = test::P1;
    const std::complex<double> D(p.kr - p.mr * W * W, p.cr * W);
    const double sag = p.mr * p.gravity / p.kr;  // the stator sags, too
    const double stator = p.ms * p.gravity / p.ks;
    return 1e3 * (p.gap - (sag - stator)) * std::abs(D) / (p.mr * W * W);
  };
  Trajectory t{.system = &first->contacts, .revolutions = 400};
  t.state = test::start_of(at(0.9995 * touching(125.0), 125.0).model(), *first);
  const Scene near = at(0.9995 * touching(125.0), 125.0).scene();
  t.system = &near.contacts;
  integrate_single(t, {});
  const Vec scale = first->contacts.state_scale();
  const Branch curve =
      border(grazing, flows_of(scenes, "ring"), scale, t.state.y.cwiseQuotient(scale),
             0.9995 * touching(125.0),
             {.low = 110.0, .high = 130.0, .first = 125.0, .direction = -1.0, .largest_step = 2.0});
  EXPECT_EQ(curve.points.back().value, 110.0);
  for (const BranchPoint& p : curve.points) {
    EXPECT_NEAR(p.z(8), touching(p.value), located) << p.value;
    // also where the step ends that touches, or does not, by rounding
    const std::vector<Vec> start{p.state(scale)};
    EXPECT_NEAR(nearest_graze(*scene(p.z(8), p.value), "ring", start).depth, 0.0, 1e-9);
  }
}

}  // namespace whirl::bifurcation_curve_test

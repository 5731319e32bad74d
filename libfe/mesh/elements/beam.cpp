#include "libfe/mesh/elements/beam.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/quadrature.hpp"

namespace whirl::inline fe {

namespace {

constexpr int gauss_points = 24;  // exact for cylinders; a cone of ratio 1:10 integrates to 1e-9

/// Fields of all shape functions of one plane at the integration points, a column per function.
struct PlaneFields {
  Mat w, theta, moment, shear;  ///< deflection, rotation, E I theta', V = kappa G A (w' - theta)
  Mat slope;                    ///< w'
};

/// Properties along the element, at the integration points.
struct Along {
  Vec bending_flexibility;  ///< 1 / (E I)
  Vec shear_flexibility;    ///< 1 / (kappa G A), 0 without shear
  Vec rho_A, rho_I;         ///< mass and rotary inertia per length
};

Along properties(const Beam& beam, const Quadrature& q) {
  const auto n = q.x.size();
  Along a{Vec(n), Vec::Zero(n), Vec(n), Vec::Zero(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Section section = beam.at(q.x(i));
    a.bending_flexibility(i) = 1.0 / (beam.material.E * section.I());
    a.rho_A(i) = beam.material.rho * section.A();
    if (beam.theory != Theory::euler_bernoulli) a.rho_I(i) = beam.material.rho * section.I();
    if (beam.theory == Theory::timoshenko) {
      const double kappa = shear_coefficient(beam.shear, section, beam.material.nu);
      a.shear_flexibility(i) = 1.0 / (kappa * beam.material.G * section.A());
    }
  }
  return a;
}

/// Integrates given moments and shear forces from the left end, and keeps the values at the right.
struct Deflection {
  Vec w, theta;
  double w_end, theta_end;
};
Deflection integrate(const Vec& moment, const Vec& shear, const Along& along, const Quadrature& q,
                     double L) {
  const Vec curvature = moment.cwiseProduct(along.bending_flexibility);
  Deflection d;
  d.theta = L * (q.S * curvature);
  const Vec slope = d.theta + shear.cwiseProduct(along.shear_flexibility);
  d.w = L * (q.S * slope);
  d.theta_end = L * q.w.dot(curvature);
  d.w_end = L * q.w.dot(slope);
  return d;
}

PlaneFields shape_functions(const Beam& beam, const Along& along, const Quadrature& q) {
  const double L = beam.L;
  const auto n = q.x.size();
  const Vec one = Vec::Ones(n), zero = Vec::Zero(n);

  // states of self-stress: M = a + b z with V = -b
  const Vec z = L * q.x;
  const Deflection by_a = integrate(one, zero, along, q, L);
  const Deflection by_b = integrate(z, -one, along, q, L);
  Mat2 flexibility;  // (theta_end, w_end) from (a, b)
  flexibility << by_a.theta_end, by_b.theta_end, by_a.w_end, by_b.w_end;
  const Mat2 stiffness = flexibility.inverse();

  const int internal = 2 * beam.internal_functions;
  PlaneFields f{Mat(n, 4 + internal), Mat(n, 4 + internal), Mat(n, 4 + internal),
                Mat(n, 4 + internal), Mat()};
  Eigen::Index columns = 0;

  // adds the function with given left end and particular moments that ends in (w, theta)
  const auto add = [&](double w0, double theta0, const Vec& moment, const Vec& shear, double w_end,
                       double theta_end) {
    const Deflection p = integrate(moment, shear, along, q, L);
    const Vec2 ab =
        stiffness * Vec2(theta_end - theta0 - p.theta_end, w_end - w0 - theta0 * L - p.w_end);
    f.moment.col(columns) = moment + ab(0) * one + ab(1) * z;
    f.shear.col(columns) = shear - ab(1) * one;
    f.theta.col(columns) = theta0 * one + p.theta + ab(0) * by_a.theta + ab(1) * by_b.theta;
    f.w.col(columns) = w0 * one + theta0 * z + p.w + ab(0) * by_a.w + ab(1) * by_b.w;
    ++columns;
  };
  add(1, 0, zero, zero, 0, 0);
  add(0, 1, zero, zero, 0, 0);
  add(0, 0, zero, zero, 1, 0);
  add(0, 0, zero, zero, 0, 1);

  // without shear a distributed moment only does what distributed forces do
  const bool with_moments = beam.theory == Theory::timoshenko;
  for (int k = 0; k < beam.internal_functions; ++k) {
    const Vec power = q.x.array().pow(k + 1);  // integral of forces or moments ~ xi^k
    add(0, 0, -L / (k + 2.0) * q.x.cwiseProduct(power), power, 0, 0);
    if (with_moments) add(0, 0, power, zero, 0, 0);
  }

  // internal functions: orthogonal in elastic energy, largest value one
  const auto energy = [&](Eigen::Index i, Eigen::Index j) {
    return q.w.dot(
        f.moment.col(i).cwiseProduct(along.bending_flexibility).cwiseProduct(f.moment.col(j)) +
        f.shear.col(i).cwiseProduct(along.shear_flexibility).cwiseProduct(f.shear.col(j)));
  };
  const std::array<Mat*, 4> fields{&f.w, &f.theta, &f.moment, &f.shear};
  for (Eigen::Index i = 4; i < columns; ++i) {
    for (Eigen::Index j = 4; j < i; ++j) {
      const double share = energy(i, j) / energy(j, j);
      for (Mat* field : fields) field->col(i) -= share * field->col(j);
    }
    const double size =
        std::max(f.w.col(i).cwiseAbs().maxCoeff(), L * f.theta.col(i).cwiseAbs().maxCoeff());
    for (Mat* field : fields) field->col(i) /= size;
  }
  for (Mat* field : fields) field->conservativeResize(n, columns);
  f.slope = f.theta + along.shear_flexibility.asDiagonal() * f.shear;
  return f;
}

}  // namespace

ElementMatrices<Eigen::Dynamic> matrices(const Beam& beam) {
  if (beam.internal_functions < 0 || beam.internal_functions > 4) {
    throw OptionError("a beam element takes 0 to 4 pairs of internal functions");
  }
  static const Quadrature q = Quadrature::gauss(gauss_points);
  const Along along = properties(beam, q);
  const PlaneFields f = shape_functions(beam, along, q);
  const auto m = f.w.cols();  // functions of one plane
  const Vec weight = beam.L * q.w;

  const auto integral = [&](const Mat& a, const Vec& by, const Mat& b) -> Mat {
    return a.transpose() * by.cwiseProduct(weight).asDiagonal() * b;
  };
  const Vec one = Vec::Ones(gauss_points);
  const Mat elastic = integral(f.moment, along.bending_flexibility, f.moment) +
                      integral(f.shear, along.shear_flexibility, f.shear);
  const Mat K = elastic + beam.axial_force * integral(f.slope, one, f.slope);
  const Mat rotary = integral(f.theta, along.rho_I, f.theta);
  const Mat M = integral(f.w, along.rho_A, f.w) + rotary;
  const Mat T = beam.torque * integral(f.moment, along.bending_flexibility, f.theta);

  // planes: u = (x, theta_y, ...), v = (y, -theta_x, ...)
  ElementMatrices<Eigen::Dynamic> e(static_cast<int>(2 * m));
  const auto freedom = [&](int plane, Eigen::Index i) -> Eigen::Index {
    if (i >= 4) return 8 + plane * (m - 4) + (i - 4);
    static constexpr int of_x[] = {0, 3, 4, 7}, of_y[] = {1, 2, 5, 6};
    return plane == 0 ? of_x[i] : of_y[i];
  };
  const auto sign = [](int plane, Eigen::Index i) {
    return plane == 1 && (i == 1 || i == 3) ? -1.0 : 1.0;
  };
  const auto add = [&](auto& to, int row_plane, int column_plane, double factor, const Mat& block) {
    for (Eigen::Index j = 0; j < m; ++j) {
      for (Eigen::Index i = 0; i < m; ++i) {
        to(freedom(row_plane, i), freedom(column_plane, j)) +=
            factor * sign(row_plane, i) * sign(column_plane, j) * block(i, j);
      }
    }
  };
  const bool has_mass = beam.carries != Carries::stiffness;
  const bool has_stiffness = beam.carries != Carries::mass;
  for (const int plane : {0, 1}) {
    if (has_mass) add(e.M, plane, plane, 1.0, M);
    if (has_mass && beam.damping.mass != 0.0) add(e.C, plane, plane, beam.damping.mass, M);
    if (!has_stiffness) continue;
    add(e.K, plane, plane, 1.0, K);
    add(e.C, plane, plane, beam.material.eta, elastic);
    if (beam.damping.stiffness != 0.0) add(e.C, plane, plane, beam.damping.stiffness, K);
  }
  // each pair of planes: rotor inertia 2 rho I, damping seen from the rotating shaft, torque
  const bool gyroscopic = beam.theory != Theory::euler_bernoulli;
  if (gyroscopic && has_mass) {
    add(e.G, 0, 1, +2.0, rotary);
    add(e.G, 1, 0, -2.0, rotary);
  }
  if (!has_stiffness) return e;
  add(e.H, 0, 1, +beam.material.eta, elastic);
  add(e.H, 1, 0, -beam.material.eta, elastic);
  if (beam.torque != 0.0) {
    add(e.K, 0, 1, +1.0, T);
    add(e.K, 1, 0, -1.0, T);
  }
  return e;
}

Mat deflection_functions(const Beam& beam, const Vec& xi) {
  static const Quadrature q = Quadrature::gauss(gauss_points);
  return q.interpolation(xi) * shape_functions(beam, properties(beam, q), q).w;
}

}  // namespace whirl::inline fe

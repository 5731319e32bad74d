#include "libfe/analyses/bending.hpp"

#include <Eigen/LU>
#include <array>
#include <limits>
#include <vector>

#include "libbase/numerics/quadrature.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libfe/mesh/shaft_elements.hpp"

namespace whirl::inline fe {

namespace {

constexpr int pieces = 8;            ///< of a beam, between which the line is told
constexpr int points_of_piece = 12;  ///< exact for cylinders; a cone of ratio 1:10 to rounding
constexpr int plane_x[] = {0, 3, 4, 7}, plane_y[] = {1, 2, 5, 6};  ///< dofs of a plane
constexpr std::array<double, 4> sign_y{1.0, -1.0, 1.0, -1.0};      ///< theta = -theta_x there

/// Deflection and rotation that a moment and a shear force make of a straight beam, at the ends of
/// its pieces.
struct Bent {
  Vec w = Vec::Zero(pieces + 1), theta = Vec::Zero(pieces + 1);
};

/// Integrals along beams beside each other, which bend as one.
class BeamIntegrals {
 public:
  explicit BeamIntegrals(const std::vector<Beam>& beams)
      : beams_(beams), h_(beams.front().L / pieces) {}

  /// @param moment, shear  functions of the position from the left end [N.m], [N]
  Bent bend(const auto& moment, const auto& shear) const {
    Bent bent;
    for (int k = 0; k < pieces; ++k) {
      Vec curvature(points_of_piece), slip(points_of_piece);
      for (Eigen::Index i = 0; i < points_of_piece; ++i) {
        const double s = h_ * (k + rule().x(i));
        const Stiffness stiffness = this->stiffness(s);
        curvature(i) = moment(s) / stiffness.bending;
        slip(i) = shear(s) / stiffness.shear;
      }
      const Vec slope = (h_ * (rule().S * curvature)).array() + bent.theta(k) + slip.array();
      bent.theta(k + 1) = bent.theta(k) + h_ * rule().w.dot(curvature);
      bent.w(k + 1) = bent.w(k) + h_ * rule().w.dot(slope);
    }
    return bent;
  }

  /// Integrals of the mass per length from the left end, once and twice [kg], [kg.m].
  Vec2 mass(double s) const {
    Vec2 sum = Vec2::Zero();
    for (Eigen::Index i = 0; i < points_of_piece; ++i) {
      const double t = s * rule().x(i);
      for (const Beam& beam : beams_) {
        if (beam.carries == Carries::stiffness) continue;
        sum += s * rule().w(i) * beam.material.rho * section(beam, t).A() * Vec2(1.0, s - t);
      }
    }
    return sum;
  }

  /// Nominal stresses of the first beam under a moment and a shear force of all of them [Pa].
  struct Stresses {
    double bending, shear;
  };
  Stresses stresses(double s, double moment, double force) const {
    double bending = 0.0, shear = 0.0;  // stiffness of all
    for (const Beam& beam : beams_) {
      if (beam.carries == Carries::mass) continue;
      bending += beam.material.E * section(beam, s).I();
      shear += beam.material.G * section(beam, s).A();
    }
    const Beam& shaft = beams_.front();
    const double r = 0.5 * section(shaft, s).outer, q = 0.5 * section(shaft, s).inner;
    const double mean = force * shaft.material.G / shear;
    return {moment * shaft.material.E * r / bending,
            4.0 / 3.0 * mean * (r * r + r * q + q * q) / (r * r + q * q)};
  }

 private:
  /// E I and kappa G A of all beams; without shear in one of them the latter is infinite.
  struct Stiffness {
    double bending = 0.0, shear = 0.0;
  };
  Stiffness stiffness(double s) const {
    Stiffness sum;
    for (const Beam& beam : beams_) {
      if (beam.carries == Carries::mass) continue;
      const Section section = this->section(beam, s);
      sum.bending += beam.material.E * section.I();
      const double kappa = shear_coefficient(beam.shear, section, beam.material.nu);
      sum.shear += beam.theory == Theory::timoshenko ? kappa * beam.material.G * section.A()
                                                     : std::numeric_limits<double>::infinity();
    }
    return sum;
  }
  static const Quadrature& rule() {
    static const Quadrature rule = Quadrature::gauss(points_of_piece);
    return rule;
  }
  static Section section(const Beam& beam, double s) { return beam.at(s / beam.L); }

  const std::vector<Beam>& beams_;
  double h_;
};

/// One plane of a beam: what its ends do, and the forces on them.
struct Plane {
  Eigen::Vector4d ends;    ///< w, theta of the left end, of the right one [m, rad]
  Eigen::Vector4d forces;  ///< on the beam at these [N, N.m]
  double acceleration;     ///< of gravity along w [m/s^2]
};

/// The cubic with given ends and slopes.
double cubic(const Eigen::Vector4d& ends, double L, double s) {
  const double x = s / L, x2 = x * x, x3 = x2 * x;
  return ends(0) * (1.0 - 3.0 * x2 + 2.0 * x3) + ends(1) * L * (x - 2.0 * x2 + x3) +
         ends(2) * (3.0 * x2 - 2.0 * x3) + ends(3) * L * (x3 - x2);
}

/// Columns w, M, V of one plane at the ends of the pieces.
///
///   V(s) = V(0) - integral q,   M(s) = M(0) - V(0) s + integral integral q + N (w(s) - w(0))
Mat line_of(const Beam& beam, const BeamIntegrals& integrals, const Plane& plane) {
  const double V0 = -plane.forces(0), M0 = -plane.forces(1), a = plane.acceleration;
  Mat line(pieces + 1, 3);
  // the weight between ends at rest, and both states of self-stress, which turn it to the true ends
  const Bent weight = integrals.bend([&](double s) { return a * integrals.mass(s)(1); },
                                     [&](double s) { return -a * integrals.mass(s)(0); });
  const Bent by_moment = integrals.bend([](double) { return 1.0; }, [](double) { return 0.0; });
  const Bent by_force = integrals.bend([](double s) { return s; }, [](double) { return -1.0; });
  Mat2 flexibility;
  flexibility << by_moment.theta(pieces), by_force.theta(pieces),  //
      by_moment.w(pieces), by_force.w(pieces);
  const Eigen::Vector4d& e = plane.ends;
  const Vec2 share = flexibility.inverse() * Vec2(e(3) - e(1) - weight.theta(pieces),
                                                  e(2) - e(0) - e(1) * beam.L - weight.w(pieces));
  for (int k = 0; k <= pieces; ++k) {
    const double s = beam.L * k / pieces;
    const Vec2 mass = integrals.mass(s);
    line(k, 0) =
        e(0) + e(1) * s + weight.w(k) + share(0) * by_moment.w(k) + share(1) * by_force.w(k);
    line(k, 1) = M0 - V0 * s + a * mass(1) + beam.axial_force * (cubic(e, beam.L, s) - e(0));
    line(k, 2) = V0 - a * mass(0);
  }
  return line;
}

}  // namespace

BendingLine bending_line(const Assembler& assembler, double Omega, const Vec& displacement) {
  const Mesh& mesh = assembler.mesh();
  const DofMap& dofs = assembler.dofs();
  const auto size = static_cast<Eigen::Index>(mesh.elements.size()) * (pieces + 1);
  const Vec2 steady = steady_acceleration(assembler.structure());
  BendingLine line{Vec(size), Mat(size, 2), Mat(size, 2), Mat(size, 2), Vec(size), Vec(size)};
  const std::vector<Structure::Shaft> shafts = assembler.structure().shafts();
  int internal = 4 * dofs.nodes;  // index of the amplitudes of the next beam's own functions
  for (const bool tilts : dofs.body_tilts) internal += tilts ? 4 : 2;
  Eigen::Index at = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const MeshElement& element = mesh.elements[e];
    const double speed = shafts[static_cast<std::size_t>(element.shaft)].speed_at(Omega);
    const std::vector<Beam> beams = beams_along(e, assembler.structure(), mesh);
    const Beam& beam = beams.front();  // of the shaft itself; it alone has functions of its own
    const auto matrices = whirl::matrices(beam);
    const Eigen::Index n = matrices.K.rows();
    Vec q(n), acceleration = Vec::Zero(n);
    q.head(4) = displacement.segment(4 * element.left, 4);
    q.segment(4, 4) = displacement.segment(4 * element.right, 4);
    q.tail(n - 8) = displacement.segment(internal, n - 8);
    internal += static_cast<int>(n) - 8;
    acceleration(plane_x[0]) = acceleration(plane_x[2]) = steady(0);
    acceleration(plane_y[0]) = acceleration(plane_y[2]) = steady(1);
    Vec f = matrices.K * q + speed * (matrices.H * q) - matrices.M * acceleration;
    for (std::size_t i = 1; i < beams.size(); ++i) {
      const auto layer = whirl::matrices(beams[i]);
      f.head(8) +=
          layer.K * q.head(8) + speed * (layer.H * q.head(8)) - layer.M * acceleration.head(8);
    }
    const BeamIntegrals integrals(beams);
    for (const int plane : {0, 1}) {
      Plane p{.ends = {}, .forces = {}, .acceleration = acceleration(plane == 0 ? 0 : 1)};
      for (std::size_t i = 0; i < 4; ++i) {
        const int k = plane == 0 ? plane_x[i] : plane_y[i];
        const double sign = plane == 0 ? 1.0 : sign_y[i];
        p.ends(static_cast<Eigen::Index>(i)) = sign * q(k);
        p.forces(static_cast<Eigen::Index>(i)) = sign * f(k);
      }
      const Mat columns = line_of(beam, integrals, p);
      line.deflection.block(at, plane, pieces + 1, 1) = columns.col(0);
      line.moment.block(at, plane, pieces + 1, 1) = columns.col(1);
      line.shear.block(at, plane, pieces + 1, 1) = columns.col(2);
    }
    for (int k = 0; k <= pieces; ++k) {
      const auto found = integrals.stresses(beam.L * k / pieces, line.moment.row(at + k).norm(),
                                            line.shear.row(at + k).norm());
      line.bending_stress(at + k) = found.bending;
      line.shear_stress(at + k) = found.shear;
    }
    for (int k = 0; k <= pieces; ++k) {
      line.z(at++) = mesh.z[static_cast<std::size_t>(element.left)] + beam.L * k / pieces;
    }
  }
  return line;
}

}  // namespace whirl::inline fe

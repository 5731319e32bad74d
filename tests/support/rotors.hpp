#pragma once
/// Builders that let a test say a rotor in a few lines.

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "libfe/assembly/assemble.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr double rpm = pi / 30.0;  ///< [rad/s]

/// Steel of [Friswell2010], sec. 5.9.
inline Material steel(double rho = 7810.0) {
  const double E = 211e9, G = 81.2e9;
  return {.name = "steel", .rho = rho, .E = E, .G = G, .nu = E / (2.0 * G) - 1.0};
}

/// The same without mass.
inline Material massless_steel() {
  return steel(0.0);
}

// ---- places -------------------------------------------------------------------------------------

/// @param number  from 1, as in model files
inline Station node(int number) {
  return {.kind = Station::Kind::node, .node = number};
}
inline Station at(double z) {
  return {.kind = Station::Kind::position, .z = z};
}
inline Station body(std::string name) {
  return {.kind = Station::Kind::body, .body = std::move(name)};
}
inline Station ground() {
  return {};
}

// ---- shafts -------------------------------------------------------------------------------------

/// A solid cylinder of steel.
inline Segment cylinder(double length, double diameter, int elements,
                        Theory theory = Theory::timoshenko) {
  return {.material = steel(),
          .length = length,
          .left = {.outer = diameter},
          .right = {.outer = diameter},
          .elements = elements,
          .theory = theory};
}

/// A massless solid cylinder without shear, the shaft of closed forms.
inline Segment massless_cylinder(double length, double diameter, int elements) {
  Segment s = cylinder(length, diameter, elements, Theory::euler_bernoulli);
  s.material = massless_steel();
  return s;
}

/// A solid cone of steel.
inline Segment cone(double length, double left, double right, int elements,
                    Theory theory = Theory::timoshenko) {
  Segment s = cylinder(length, left, elements, theory);
  s.right.outer = right;
  return s;
}

/// Bending stiffness E I of a segment's left end [N.m^2].
inline double EI(const Segment& s) {
  return s.material.E * s.left.I();
}

// ---- connections --------------------------------------------------------------------------------

/// The same stiffness [N/m] and damping [N.s/m] along x and y.
inline BearingCoefficients isotropic(double k, double c = 0.0) {
  BearingCoefficients b;
  b.K.diagonal().setConstant(k);
  b.C.diagonal().setConstant(c);
  return b;
}

/// Different stiffness [N/m] and damping [N.s/m] along x and y.
inline BearingCoefficients orthotropic(double kx, double ky, double cx = 0.0, double cy = 0.0) {
  BearingCoefficients b;
  b.K.diagonal() << kx, ky;
  b.C.diagonal() << cx, cy;
  return b;
}

inline Connection connect(Station from, Station to, const AnyBearing& coefficients) {
  return {.from = std::move(from), .to = std::move(to), .coefficients = coefficients};
}
inline Connection connect(Station from, Station to, const BearingCoefficients& coefficients) {
  return connect(std::move(from), std::move(to), constant_bearing(coefficients));
}
/// A connection to the ground.
template <class Coefficients>
Connection bearing(Station from, const Coefficients& coefficients) {
  return connect(std::move(from), ground(), coefficients);
}
inline Connection rigid(Station from, Station to = ground()) {
  return {.from = std::move(from), .to = std::move(to), .is_rigid = true};
}
inline Connection clamped(Station from, Station to = ground()) {
  return {.from = std::move(from), .to = std::move(to), .is_clamped = true};
}

// ---- rotors -------------------------------------------------------------------------------------

/// A shaft between rigid bearings at its ends.
inline Structure pinned(const Segment& shaft) {
  return {.shaft = {shaft}, .bearings = {rigid(at(0.0)), rigid(at(shaft.length))}};
}

/// A shaft clamped at its left end.
inline Structure cantilever(const Segment& shaft) {
  return {.shaft = {shaft}, .bearings = {clamped(at(0.0))}};
}

/// Jeffcott rotor: a disk without inertia of tilt amid a massless shaft between rigid bearings.
struct Jeffcott {
  double m = 5.0;                 ///< [kg]
  double length = 0.8, d = 0.02;  ///< [m]

  Structure structure() const {
    Structure s = pinned(massless_cylinder(length, d, 2));
    s.disks.push_back({.at = node(2), .m = m});
    return s;
  }
  double k() const {  ///< 48 E I / L^3 [N/m]
    return 48.0 * EI(massless_cylinder(length, d, 2)) / (length * length * length);
  }
  double omega() const { return std::sqrt(k() / m); }
};

/// A disk at the end of a massless cantilever; its stiffness there in closed form.
struct Overhung {
  double m = 10.0, Id = 0.05, Ip = 0.09;  ///< [kg], [kg.m^2]
  double length = 0.4, d = 0.03;          ///< [m]

  Structure structure() const {
    Structure s = cantilever(massless_cylinder(length, d, 2));
    s.disks.push_back({.at = node(3), .m = m, .Id = Id, .Ip = Ip});
    return s;
  }
  /// Of (w, theta) at the disk: E I [12 / L^3, -6 / L^2; -6 / L^2, 4 / L].
  Mat2 K() const {
    const double L = length;
    Mat2 k;
    k << 12.0 / (L * L * L), -6.0 / (L * L), -6.0 / (L * L), 4.0 / L;
    return EI(massless_cylinder(length, d, 1)) * k;
  }
};

/// The two-disk rotor of [Friswell2010], example 5.9.1, on given bearings.
/// @param elements  per sixth of the shaft
inline Structure two_disk(const BearingCoefficients& coefficients, int elements = 1) {
  Structure s;
  for (int i = 0; i < 6; ++i) s.shaft.push_back(cylinder(0.25, 0.05, elements));
  s.disks = {{.at = at(0.5), .m = 32.589728, .Id = 0.178089, .Ip = 0.329564},
             {.at = at(1.0), .m = 51.525261, .Id = 0.423581, .Ip = 0.805082}};
  s.bearings = {bearing(at(0.0), coefficients), bearing(at(1.5), coefficients)};
  return s;
}

struct RandomRotor {
  int elements = 30;
  bool is_isotropic = false;  ///< bearings with the same coefficients along x and y
  bool is_free = false;       ///< no bearings
  double damping = 0.0;       ///< of the bearings, share of critical for the mass on them
};

/// A stepped and tapered shaft with three disks and two bearings, other for every draw.
inline Structure random_rotor(std::mt19937& random, const RandomRotor& how) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Structure s;
  constexpr int segments = 5;
  for (int i = 0; i < segments; ++i) {
    const int elements = how.elements / segments + (i < how.elements % segments ? 1 : 0);
    s.shaft.push_back(cone(between(0.1, 0.4), between(0.03, 0.08), between(0.03, 0.08), elements));
    if (i % 2 == 1) s.shaft.back().right = s.shaft.back().left;  // a cylinder
    if (i == 2) s.shaft.back().left.inner = s.shaft.back().right.inner = 0.01;
  }
  const auto any_node = [&] {
    return node(std::uniform_int_distribution<int>(1, how.elements + 1)(random));
  };
  for (int i = 0; i < 3; ++i) {
    const double m = between(1.0, 30.0), radius = between(0.05, 0.2);
    s.disks.push_back({.at = any_node(),
                       .m = m,
                       .Id = 0.3 * m * radius * radius,
                       .Ip = 0.5 * m * radius * radius});
  }
  if (how.is_free) return s;
  for (const double z : {0.0, s.length()}) {
    const double kx = between(1e6, 1e8), ky = how.is_isotropic ? kx : between(1e6, 1e8);
    const double cx = 2.0 * how.damping * std::sqrt(20.0 * kx);
    const double cy = 2.0 * how.damping * std::sqrt(20.0 * ky);
    s.bearings.push_back(bearing(at(z), orthotropic(kx, ky, cx, cy)));
  }
  return s;
}

}  // namespace whirl::test

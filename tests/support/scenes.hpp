#pragma once
/// Builders that let a test say a scene with contacts in a few lines, and run it.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "libdyn/methods/methods.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/scene.hpp"
#include "libfe/mesh/elements/disk.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::test {

/// Linear contact, or Hertz contact if its stiffness kH is given.
inline AnyContactLaw<> contact_law(double kC, double cC, double kH, double alpha) {
  if (kH > 0.0) return Hertz<>{.k = kH, .alpha = alpha};
  return Radial<>{.k = kC, .c = cC};
}

/// Rotor and stator of "Nonlinear dynamics of a rotor-stator system with contacts", coordinates
/// x_r, y_r, x_s, y_s; the contact is "ring".
///
///   m_r z_r'' + c_r z_r' + k_r z_r = m_r e Omega^2 e^(i (Omega t + phase)) - i m_r g + F
///   m_s z_s'' + c_s z_s' + k_s z_s = -i m_s g - F
struct RotorStator {
  double Omega = 136.0;             ///< [rad/s]
  double kC = 150e6, mu = 0.1;      ///< contact: stiffness [N/m], friction
  double cC = 0.0;                  ///< and damping [N.s/m]
  double kH = 0.0;                  ///< above 0: Hertz contact instead [N/m^1.5]
  double alpha = 0.0;               ///< and its dissipation factor [s/m]
  double mr = 50.0, ms = 50.0;      ///< [kg]
  double kr = 980e3, ks = 14.58e6;  ///< [N/m]
  double cr = 280.0, cs = 2700.0;   ///< [N.s/m]
  double e = 1e-3, phase = 0.0;     ///< unbalance: offset [m], phase [rad]
  double gap = 6e-3;                ///< [m]
  double gravity = 9.81;            ///< [m/s^2]
  double R = 0.1;                   ///< of the contact, for the slip velocity [m]
  double slip_tolerance = 0.0;      ///< [m/s]
  Slip slip = Slip::actual;
  Vec2 offset = Vec2::Zero();  ///< center of the clearance circle [m]

  Model model() const {
    Model m;
    m.speed = Omega;
    m.has_speed = true;
    m.structure.bodies = {{.name = "rotor", .m = mr, .spins = true}, {.name = "stator", .m = ms}};
    m.structure.bearings = {bearing(body("rotor"), isotropic(kr, cr)),
                            bearing(body("stator"), isotropic(ks, cs))};
    m.structure.unbalances = {{.at = body("rotor"), .moment = mr * e, .phase = phase}};
    m.structure.gravity = gravity;
    m.contacts = {{.name = "ring",
                   .at = body("rotor"),
                   .against = body("stator"),
                   .clearance = gap,
                   .offset = offset,
                   .friction = {.mu = mu, .slip = slip, .radius = R, .tolerance = slip_tolerance},
                   .law = contact_law(kC, cC, kH, alpha)}};
    return m;
  }
  Scene scene() const { return make_scene(model()); }
};

/// Reference points of the rotor and stator: what their steady motion is, from the two static sags.
inline const RotorStator P1{.Omega = 136.0, .kC = 150e6, .mu = 0.10};  ///< five impacts a period
inline const RotorStator P2{.Omega = 136.0, .kC = 20e6, .mu = 0.10};   ///< two long contacts
inline const RotorStator P3{.Omega = 151.0, .kC = 50e6, .mu = 0.05};   ///< permanent contact
inline const RotorStator P4{.Omega = 151.0, .kC = 150e6, .mu = 0.20};  ///< weakly chaotic

/// A mass on a spring within a ring that stands still, coordinates x, y; the contact is "ring".
struct MassInRing {
  double Omega = 100.0;         ///< [rad/s]; 0: does not spin
  double m = 1.0;               ///< [kg]
  double k = 1e4, c = 0.0;      ///< of the spring [N/m] and damper [N.s/m]; 0: the mass is free
  double U = 0.0, phase = 0.0;  ///< unbalance [kg.m], [rad]
  double kC = 1e6, cC = 0.0;    ///< of the contact [N/m], [N.s/m]
  double kH = 0.0;              ///< above 0: Hertz contact instead [N/m^1.5]
  double alpha = 0.0;           ///< and its dissipation factor [s/m]
  double mu = 0.0, R = 0.0;     ///< friction and its radius [m]
  double clearance = 1e-3;      ///< [m]
  double gravity = 0.0;         ///< [m/s^2]
  Vec2 offset = Vec2::Zero();   ///< [m]

  Model model() const {
    Model s;
    s.speed = Omega;
    s.has_speed = true;
    s.structure.bodies = {{.name = "mass", .m = m, .spins = true}};
    if (k != 0.0 || c != 0.0) s.structure.bearings = {bearing(body("mass"), isotropic(k, c))};
    if (U != 0.0) s.structure.unbalances = {{.at = body("mass"), .moment = U, .phase = phase}};
    s.structure.gravity = gravity;
    s.contacts = {{.name = "ring",
                   .at = body("mass"),
                   .clearance = clearance,
                   .offset = offset,
                   .friction = {.mu = mu, .radius = R},
                   .law = contact_law(kC, cC, kH, alpha)}};
    return s;
  }
  Scene scene() const { return make_scene(model()); }
};

/// Shaft with two disks of "Nonlinear rotordynamics of a MDOF rotor-stator contact system subjected
/// to frictional and gravitational effects": 12 elements, 52 dofs, disks at nodes 4 and 9, out
/// of balance at node 4, bearings at nodes 1 and 13; the contact "ring" at node 7.
struct TwoDiskRub {
  double speed = 4430.0 * rpm;        ///< [rad/s]
  double k = 4e6, c = 5e3;            ///< of the bearings [N/m], [N.s/m]
  double mu = 0.1;                    ///< friction; slip at R = 10 mm, the shaft's radius
  int modes = 8;                      ///< of the reduction; 0: every freedom
  std::vector<WhirlStart> start{};    ///< added to equilibrium
  std::vector<int> contact_nodes{7};  ///< with the same ring
  double gravity = 0.0;               ///< [m/s^2]

  Model model() const {
    Model m;
    m.speed = speed;
    m.has_speed = true;
    Structure& s = m.structure;
    s.shaft = {cylinder(0.6, 0.02, 12)};
    s.shaft[0].material = steel(7800.0);
    for (const int number : {4, 9}) {
      Disk disk{.at = node(number), .outer_diameter = 0.3, .inner_diameter = 0.02, .width = 0.01};
      set_inertia_from_shape(disk, 7800.0);
      s.disks.push_back(disk);
    }
    s.unbalances = {{.at = node(4), .moment = s.disks[0].m * 0.5e-3}};
    s.bearings = {bearing(node(1), isotropic(k, c)), bearing(node(13), isotropic(k, c))};
    s.gravity = gravity;
    for (const int number : contact_nodes) {
      m.contacts.push_back({.name = "ring",
                            .at = node(number),
                            .clearance = 5e-3,
                            .friction = {.mu = mu, .radius = 0.01},
                            .law = Radial<>{.k = 4e6}});
    }
    m.reduction = {.method = modes > 0 ? ReductionMethod::modal : ReductionMethod::none,
                   .modes = modes};
    m.start.whirl = start;
    return m;
  }
  Scene scene() const { return make_scene(model()); }
};

/// State (eta, eta') at the start of a revolution.
inline MotionState state_of(Vec y) {
  MotionState state;
  state.y = std::move(y);
  return state;
}

/// State of a mass in a ring: place [m] and velocity [m/s].
inline MotionState state_of(const Vec2& place, const Vec2& velocity) {
  return state_of((Vec(4) << place, velocity).finished());
}

/// Where a model starts by itself.
inline MotionState start_of(const Model& model, const Scene& scene) {
  return start_state(model, scene, nullptr);
}

struct RunOptions {
  double tolerance = 1e-10;
  double fixed_step = 0.0;  ///< [s]; 0: the step is controlled
  AnyMethod method;
};

/// Moves a state on by whole revolutions.
inline Integration run(const Scene& scene, MotionState& state, long revolutions,
                       const RunOptions& how = {}, const Observer& observer = {}) {
  return integrate(how.method, scene.contacts, state, revolutions,
                   {.tolerance = how.tolerance, .fixed_step = how.fixed_step}, observer);
}

}  // namespace whirl::test

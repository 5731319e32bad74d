#pragma once
/// What a model file says about the rotor and its surroundings, checked and in SI, before any mesh.

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/linalg.hpp"
#include "libfe/parts/bearings.hpp"
#include "libfe/parts/gear.hpp"
#include "libfe/parts/material.hpp"
#include "libfe/parts/probe.hpp"
#include "libfe/parts/section.hpp"
#include "libfe/parts/station.hpp"
#include "libfe/parts/support.hpp"

namespace whirl::inline fe {

/// Damping in proportion to mass and stiffness: C = mass M + stiffness K.
struct Rayleigh {
  double mass = 0.0;       ///< [1/s]
  double stiffness = 0.0;  ///< [s]

  bool operator==(const Rayleigh&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        optional("mass", &Rayleigh::mass, "1/s", nonnegative, "a in C = a M + b K"),
        optional("stiffness", &Rayleigh::stiffness, "s", nonnegative, "b in C = a M + b K")};
  }
};

/// Part of the shaft between two planes: a cylinder or a cone of one material.
struct Segment {
  Material material;
  double length = 0.0;         ///< [m]
  Section left, right;         ///< sections at both ends; diameters vary linearly between
  int elements = 0;            ///< number of equal elements; 0: chosen by the mesh
  int internal_functions = 0;  ///< pairs of internal shape functions per element and plane
  Theory theory = Theory::timoshenko;
  ShearCoefficient shear;
  double axial_force = 0.0;  ///< tension > 0 [N]
  double torque = 0.0;       ///< about +z on the face that looks to +z [N.m]
  Rayleigh damping{};        ///< of this segment, at rest
  Where where{};

  /// Section at a fraction s of the length, 0 <= s <= 1.
  Section at(double s) const { return between(left, right, s); }

  bool operator==(const Segment&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        alternative("length", &Segment::length, "m", positive, "length of the segment"),
        alternative("elements", &Segment::elements, "", positive,
                    "number of equal elements; left out: chosen from the shape and the stations"),
        optional(
            "internal_functions", &Segment::internal_functions, "", nonnegative,
            "pairs of internal shape functions per element, 0 to 4; each raises the order by two"),
        optional("theory", &Segment::theory, "", any, "beam theory"),
        optional("axial_force", &Segment::axial_force, "N", any, "tension > 0"),
        optional("torque", &Segment::torque, "N.m", any, "about +z on the face that looks to +z")};
  }
};

/// Deflections of a shaft without any force on it, at t = 0; they turn with the shaft.
///
/// Between its positions the bow is the natural cubic spline, beyond them straight.
struct Bow {
  std::vector<double> z;     ///< positions, ascending [m]; empty: the shaft is straight
  std::vector<double> x, y;  ///< deflection there [m]
  bool operator==(const Bow&) const = default;
};

/// A further shaft, within the first one, around it or beside it, whose speed has a given ratio to
/// that of the first.
struct Rotor {
  std::string name;
  double ratio = 1.0;  ///< of its speed to that of the first shaft; below 0: against it
  /// In place of a ratio its own speeds at speeds of the first shaft, which ascend [rad/s]; a
  /// single one: it always has that; none: the ratio holds.
  std::vector<double> lead{}, own{};
  double z = 0.0;              ///< of its left end, along the axis of the first shaft [m]
  std::vector<Segment> shaft;  ///< left to right
  Where where{};
  Bow bow{};  ///< of its shaft, at positions along the axis of the first one

  bool operator==(const Rotor&) const = default;

  bool has_own_speed() const { return !own.empty(); }
  /// Speed where the first shaft has a speed [rad/s]: own speeds are straight between those that
  /// are given, and stay beyond them.
  double speed_at(double Omega) const;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        alternative("ratio", &Rotor::ratio, "", any,
                    "of its speed to that of the first shaft; below 0: it turns against it"),
        optional("position", &Rotor::z, "m", nonnegative,
                 "of its left end, from that of the first shaft")};
  }
};

/// What of a part of the shaft counts.
enum class Carries {
  both,
  stiffness,  ///< no mass, no rotary inertia
  mass        ///< neither stiffness nor damping
};
constexpr auto choices(Carries) {
  return std::array{Choice<Carries>{"both", Carries::both},
                    Choice<Carries>{"stiffness", Carries::stiffness},
                    Choice<Carries>{"mass", Carries::mass}};
}

/// A sleeve, hub or tube that goes with the shaft: its beams lie beside those of the segments,
/// between the same nodes.
struct Layer {
  std::string name;
  Station from, to;  ///< on the shaft, from left of to; the mesh gets nodes there
  Material material;
  Section left, right;  ///< sections at both ends; diameters vary linearly between
  Carries carries = Carries::both;
  Theory theory = Theory::timoshenko;
  ShearCoefficient shear{};
  Rayleigh damping{};  ///< of this layer, at rest
  Where where{};

  bool operator==(const Layer&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{optional("carries", &Layer::carries, "", any, "what of the layer counts"),
                      optional("theory", &Layer::theory, "", any, "beam theory")};
  }
};

/// A rigid disk on the shaft.
struct Disk {
  std::string name;
  Station at;
  double m = 0.0;   ///< mass [kg]
  double Id = 0.0;  ///< diametral moment of inertia [kg.m^2]
  double Ip = 0.0;  ///< polar moment of inertia [kg.m^2]
  double outer_diameter = 0.0, inner_diameter = 0.0, width = 0.0;  ///< for pictures [m]; 0: unknown

  bool operator==(const Disk&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        alternative("mass", &Disk::m, "kg", nonnegative,
                    "of a disk that is not given by its shape"),
        optional("diametral_inertia", &Disk::Id, "kg.m^2", nonnegative, "about a diameter"),
        optional("polar_inertia", &Disk::Ip, "kg.m^2", nonnegative, "about the axis"),
        alternative("outer_diameter", &Disk::outer_diameter, "m", positive,
                    "of a disk of some material"),
        optional("inner_diameter", &Disk::inner_diameter, "m", nonnegative, "bore; left out: none"),
        alternative("width", &Disk::width, "m", positive, "along the axis")};
  }
};

/// A mass that moves along x and y, as a pedestal's share that differs [kg].
struct PlanarMass {
  double x = 0.0, y = 0.0;

  constexpr PlanarMass(double both = 0.0) : x(both), y(both) {}
  constexpr PlanarMass(double along_x, double along_y) : x(along_x), y(along_y) {}
  bool operator==(const PlanarMass&) const = default;
};

/// A lumped mass: a stator, a pedestal, the mass of a Jeffcott rotor.
struct Body {
  std::string name;
  PlanarMass m;               ///< [kg]; of a body that spins the same along x and y
  bool spins = false;         ///< part of the rotor: unbalance and gyroscopics
  std::string rotor{};        ///< with which it spins; empty: with the first shaft
  bool tilts = false;         ///< has theta_x, theta_y
  double Id = 0.0, Ip = 0.0;  ///< moments of inertia [kg.m^2], if it tilts
  Where where{};

  bool operator==(const Body&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("mass", &Body::m, "kg", nonnegative, "mass of the body, or [along x, along y]"),
        optional("spins", &Body::spins, "", any, "it is part of the rotor"),
        optional("tilts", &Body::tilts, "", any, "it has theta_x and theta_y"),
        optional("diametral_inertia", &Body::Id, "kg.m^2", nonnegative, "if it tilts"),
        optional("polar_inertia", &Body::Ip, "kg.m^2", nonnegative, "if it tilts and spins")};
  }
};

/// When a load begins to act, after the start of the recording of a motion; both zero: it always
/// acts.
struct Beginning {
  double time = 0.0;         ///< [s]
  double revolutions = 0.0;  ///< of the rotor

  bool is_late() const { return time > 0.0 || revolutions > 0.0; }
  bool operator==(const Beginning&) const = default;
};

/// A mass off the axis: force moment * Omega^2, turning with the rotor.
struct Unbalance {
  Station at;
  double moment = 0.0;  ///< mass times eccentricity [kg.m]
  double phase = 0.0;   ///< angle from +x at t = 0 [rad]
  Beginning begins{};   ///< of simulated motions; all other analyses have it all the time
  std::string name{};
  bool operator==(const Unbalance&) const = default;
};

/// What a load is, and where it points.
enum class ForceKind {
  force,             ///< [N]
  moment,            ///< [N.m]
  base_acceleration  ///< of the ground, and so of all that has weight [m/s^2]
};
enum class Turning { no, forward, backward };
/// Those that a model file names.
constexpr auto choices(Turning) {
  return std::array{Choice<Turning>{"forward", Turning::forward},
                    Choice<Turning>{"backward", Turning::backward}};
}

/// A load that does not follow from the motion: constant, of an order of the speed, or of a
/// frequency of its own. With w its frequency,
///
///   along a direction   F cos(w t + phase) (cos angle, sin angle)
///   turning             F (cos(phase + w t), sin(phase + w t)), backward with -w
///
/// along x and y, of a moment about them.
struct Force {
  std::string name;
  ForceKind kind = ForceKind::force;
  Station at;          ///< not of a base
  double size = 0.0;   ///< F [N, N.m, m/s^2]
  double angle = 0.0;  ///< from +x [rad]
  Turning turning = Turning::no;
  double order = 0.0;      ///< of the speed; 0: it does not follow it
  double frequency = 0.0;  ///< of its own [rad/s]; 0, and no order: constant
  double phase = 0.0;      ///< [rad]
  Beginning begins{};      ///< of simulated motions; all other analyses have it all the time

  bool has_station() const { return kind != ForceKind::base_acceleration; }
  bool is_constant() const { return order == 0.0 && frequency == 0.0; }
  /// Whether it has the frequency of unbalance.
  bool is_synchronous() const { return order == 1.0; }
  bool operator==(const Force&) const = default;
};

/// A bearing or a seal (station to ground or body), or a link (any two stations).
struct Connection {
  std::string name;
  Station from, to;
  AnyBearing coefficients;
  bool is_rigid = false;    ///< x and y of both ends are the same
  bool is_clamped = false;  ///< and the tilts too
  Where where{};
  double clearance = 0.0;  ///< of a bearing or seal, radial [m]; 0: not told

  bool operator==(const Connection&) const = default;

  static constexpr auto fields() {
    return std::tuple{alternative(
        "clearance", &Connection::clearance, "m", Range::positive,
        "radial, that the rotor has there; for checks of clearances, it changes no coefficient")};
  }
};

/// A connection whose coefficients follow from the state of the rotor at a speed, as those of an
/// oil film follow from where its journal runs.
struct LinearizedConnection {
  std::string name;
  Station from, to;
  /// Coefficients at a spin and a whirl frequency, as a kind of bearing has them (bearings.hpp)
  /// [rad/s]; throws a NumericalError where the state is not found.
  std::function<BearingCoefficients(double Omega, double omega)> at;
  std::string_view kind = "oil film";  ///< or "rolling bearing"
};

/// Damping ratios of modes at rest, beside all other damping.
struct ModalDamping {
  std::vector<double> ratios;  ///< of the lowest modes that deform; empty: none
  bool is_common = false;      ///< one ratio stands for all modes, up to most_damped_modes
  bool operator==(const ModalDamping&) const = default;
};
/// That one common ratio damps.
inline constexpr int most_damped_modes = 100;

struct Structure {
  std::vector<Segment> shaft;  ///< left to right from z = 0
  std::vector<Disk> disks;
  std::vector<Body> bodies;
  std::vector<Connection> bearings;
  std::vector<Connection> links;
  std::vector<Connection> seals;
  std::vector<LinearizedConnection> linearized;  ///< in linear analyses only
  std::vector<Unbalance> unbalances;
  std::vector<Station> stations;  ///< further places that need a node (contacts)
  Rayleigh damping;
  double gravity = 0.0;  ///< acceleration along -y [m/s^2]
  std::vector<Layer> layers{};
  ModalDamping modal_damping{};
  Bow bow{};
  std::vector<Force> forces{};
  std::vector<Probe> probes{};
  std::vector<Rotor> rotors{};  ///< further shafts
  std::vector<GearPair> gears{};
  std::vector<Support> supports{};

  /// A shaft: segments from where it starts, and the ratio of its speed to that of the first one.
  struct Shaft {
    const std::vector<Segment>& segments;
    const std::string& name;       ///< of its rotor; empty: the first shaft
    double start = 0.0;            ///< [m]
    double ratio = 1.0;            ///< NaN: it has a speed of its own
    const Rotor* rotor = nullptr;  ///< of a further shaft

    bool has_own_speed() const { return rotor && rotor->has_own_speed(); }
    double speed_at(double Omega) const { return rotor ? rotor->speed_at(Omega) : Omega; }
    double length() const {
      double sum = 0.0;
      for (const Segment& segment : segments) sum += segment.length;
      return sum;
    }
    double end() const { return start + length(); }
  };
  /// The first shaft, which may have no segments, and those of the rotors.
  std::vector<Shaft> shafts() const;
  /// @param number  of a shaft, from 0
  const std::vector<Segment>& segments_of(int number) const {
    return number == 0 ? shaft : rotors.at(static_cast<std::size_t>(number) - 1).shaft;
  }
  /// @param number  of a shaft, from 0
  const Bow& bow_of(int number) const {
    return number == 0 ? bow : rotors.at(static_cast<std::size_t>(number) - 1).bow;
  }
  /// Whether one of the shafts is.
  bool is_bent() const;
  /// Takes the bow of every shaft away.
  void straighten();
  /// The first of the rotors whose speed is their own; null: there is none.
  const Rotor* rotor_of_own_speed() const;
  /// Number of the shaft of a rotor, from 0; an empty name is the first shaft, nothing is no rotor.
  std::optional<int> shaft_named(const std::string& rotor) const;

  /// Connections of one kind, with its word in model files.
  struct Connections {
    const char* kind;
    const std::vector<Connection>& list;
  };
  /// All of them.
  std::array<Connections, 3> connections() const {
    return {{{"bearing", bearings}, {"link", links}, {"seal", seals}}};
  }

  /// Of the first shaft.
  double length() const { return shafts().front().length(); }
  /// From the left end of the first shaft to the rightmost end of all.
  double extent() const;
};

}  // namespace whirl::inline fe

#pragma once
/// Rotors saved by ROSS 2 and 3 (rotor.save: TOML or JSON), as its files have them.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libio/model/config.hpp"

namespace whirl::inline io {

/// A shaft element, or a layer of one: elements of equal nodes lie upon each other.
struct RossElement {
  Where where;
  std::string material;                            ///< name in the model: see RossRotor::materials
  int node = 0;                                    ///< left one, from 0
  double length = 0.0;                             ///< [m]
  std::array<double, 2> outer{}, inner{};          ///< diameters at both ends [m]
  double axial_force = 0.0, torque = 0.0;          ///< [N], [N.m]
  bool shears = true, tilts = true, turns = true;  ///< shear, rotary inertia, gyroscopics
  bool is_hutchinson = false;                      ///< else Cowper's shear coefficient
  double nu = 0.0;                                 ///< Poisson's ratio
  double mass_damping = 0.0, stiffness_damping = 0.0;  ///< alpha [1/s], beta [s]

  /// Whether both are parts of one uniform stretch: no cones, and equal in all but their places.
  bool is_like(const RossElement& other) const;
};

struct RossMaterial {
  std::string name;                    ///< unique
  double rho = 0.0, E = 0.0, G = 0.0;  ///< [kg/m^3], [Pa], [Pa]
};

/// A disk, or a gear.
struct RossDisk {
  Where where;
  std::string name;
  int node = 0;
  double m = 0.0, Id = 0.0, Ip = 0.0;  ///< [kg], [kg.m^2]
};

/// The teeth of a gear, which is a disk beside them.
struct RossGear {
  std::string name;
  int node = 0;
  double teeth = 0.0;                              ///< how many; 0: not told
  double pitch_radius = 0.0;                       ///< [m]; 0: not told
  double pressure_angle = 0.0, helix_angle = 0.0;  ///< normal, of the driving gear [rad]
  double width = 0.0, E = 0.0;                     ///< [m], [Pa]; 0: not told
};

/// What a file says of the gears of a multi-rotor that mesh.
struct RossMesh {
  std::vector<double> nodes;      ///< of both gears; none: not told
  double stiffness = 0.0;         ///< [N/m]; 0: not told
  std::optional<double> centers;  ///< direction from the driving to the driven center [rad]
};

/// A point mass, on a support or on the shaft.
struct RossPointMass {
  std::string name;
  int node = 0;
  double mx = 0.0, my = 0.0;  ///< [kg]
};

constexpr std::array<std::string_view, 12> ross_coefficients{
    "kxx", "kxy", "kyx", "kyy", "cxx", "cxy", "cyx", "cyy", "mxx", "mxy", "myx", "myy"};

/// Magnets of a bearing and their controller, i / u = P + I / s + D s / (1 + s / w_D), of each
/// axis.
struct RossMagnets {
  double current_stiffness = 0.0;     ///< ki [N/A]
  double negative_stiffness = 0.0;    ///< ks [N/m]
  double proportional = 0.0;          ///< P [A/m]
  double integral = 0.0;              ///< I [A/(m.s)]
  double derivative = 0.0;            ///< D [A.s/m]
  double derivative_bandwidth = 0.0;  ///< w_D [rad/s]; 0: without end
  double angle = 0.0;                 ///< of the first axis, from +x to +y [rad]
};

/// A bearing or seal of any class, by its coefficients.
struct RossBearing {
  /// Coefficients at a speed and a whirl frequency, in the order of ross_coefficients [SI].
  struct Row {
    double speed = 0.0, whirl = 0.0;  ///< [rad/s]
    std::array<double, 12> values{};
  };
  Where where;
  std::string name;
  bool is_seal = false;
  int node = 0, link = -1;  ///< where it is, and what it is fixed to; -1: the ground
  bool has_speed = false, has_whirl = false;
  std::vector<Row> rows;               ///< one row if the coefficients are constant
  std::optional<RossMagnets> magnets;  ///< that the coefficients come from
};

/// A coupling: springs between two nodes with a mass at each.
struct RossCoupling {
  std::string name;
  int node = 0;                                        ///< left one
  double length = 0.0, outer = 0.0;                    ///< [m]
  std::array<double, 2> m{}, Id{}, Ip{};               ///< at both ends [kg], [kg.m^2]
  std::array<double, 2> k{}, c{}, k_tilt{}, c_tilt{};  ///< along (about) x and y [SI]

  bool has_equal_halves() const { return m[0] == m[1] && Id[0] == Id[1] && Ip[0] == Ip[1]; }
};

/// How ROSS finds coefficients between the rows of a table.
enum class RossTables {
  smoothing_spline,  ///< before 3.0
  pchip
};

struct RossRotor {
  std::string version;
  RossTables tables = RossTables::pchip;
  std::vector<RossMaterial> materials;
  std::vector<RossElement> elements;  ///< by their nodes; of one node the inner ones first
  std::vector<RossCoupling> couplings;
  std::vector<RossDisk> disks;
  std::vector<RossGear> gears;
  RossMesh mesh;
  std::optional<double> speed_ratio;  ///< of the second shaft to the first one, if told
  std::vector<RossPointMass> masses;
  std::vector<RossBearing> bearings;
  double rated_speed = 0.0, minimum_speed = 0.0, maximum_speed = 0.0;  ///< 0: not told [rad/s]
  double mass_damping = 0.0,
         stiffness_damping = 0.0;              ///< of the whole rotor: alpha [1/s], beta [s]
  std::vector<double> damping_ratios;          ///< of the first modes
  double default_ratio = 0.0;                  ///< damping ratio of the other modes
  std::vector<std::string> left_out;           ///< a sentence each
  std::vector<std::string> taken_differently;  ///< likewise
};

/// Every key of the file that is not read is in `left_out`.
///
/// @param root  tree of a file, TOML or JSON
/// @throws ModelError  with the places of all problems: no rotor of ROSS, a value that is missing
///                     or not valid, tables of unequal length
RossRotor read_ross(const ConfigNode& root);

}  // namespace whirl::inline io

#pragma once
/// Motions for ParaView: a collection (.pvd) of surfaces (.vtp), one per moment.

#include <filesystem>
#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libcontact/geometries.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

/// A piece of the shaft or of a layer between two points, a cone or cylinder.
struct VtkShaftPiece {
  int left = 0, right = 0;                       ///< points, from 0, left before right
  double left_radius = 0.0, right_radius = 0.0;  ///< outer ones [m]
};

/// A solid of revolution that moves and tilts with a point: a disk, or a body of the rotor.
struct VtkDisk {
  std::string name;
  int point = 0;              ///< from 0
  double outer_radius = 0.0;  ///< [m]
  double inner_radius = 0.0;  ///< [m]
  double width = 0.0;         ///< [m]
  std::string not_given{};    ///< "size", "diameter" or "width", drawn as a symbol
};

/// A ring around the rotor, or a plate beside it, fixed or moving with a body.
///
/// The distance from the rotor is drawn as much enlarged as the displacements, so that the surfaces
/// touch on the screen when they touch in the model.
struct VtkStator {
  std::string name;
  int point = -1;              ///< what carries it, from 0; -1: the ground
  double z = 0.0;              ///< of its middle [m]
  Vec2 offset = Vec2::Zero();  ///< of its center [m]
  double rotor_radius = 0.0;   ///< of the rotor there [m]
  double clearance = 0.0;      ///< [m]
  double width = 0.0;          ///< [m]; 0: a fifth of its radius
  AnyGeometry geometry{};      ///< what the rotor meets
};

/// A bearing, or the spring below what carries bearings: a pyramid below the rotor, whose tip moves
/// with one end and whose foot is on the other; a symbol, not to scale.
struct VtkSupport {
  std::string name;
  int from = 0;        ///< the point above, from 0
  int to = -1;         ///< what carries it, from 0; -1: the ground
  double z = 0.0;      ///< along the shaft [m]
  double tip = 0.0;    ///< below the axis: the radius of the shaft, or the height of a body [m]
  double foot = 0.0;   ///< likewise of the foot [m], > tip
  double width = 0.0;  ///< of the foot [m]
};

/// A place where forces may act, drawn as an arrow's shaft.
struct VtkContact {
  std::string name;
  int point = 0;  ///< where the rotor touches, from 0
};

/// What is drawn. Points are the nodes and then the bodies, or whatever else moves.
struct VtkScene {
  std::vector<double> z;  ///< of each point at rest [m]
  std::vector<VtkShaftPiece> shaft;
  std::vector<VtkDisk> disks;
  std::vector<VtkStator> stators;
  std::vector<VtkContact> contacts;
  std::vector<VtkSupport> supports{};
};

/// Says which disks of a scene are symbols; empty where there are none.
///
///   "Thin, broken and not to scale, as the model does not give the size of fan, the width of rim"
std::string symbols_told(const VtkScene& scene);

/// The force at one contact.
struct VtkForce {
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< from the contact's point to where it acts [m]
  Vec2 force = Vec2::Zero();                      ///< on the rotor [N]
  bool is_touching = false;
};

/// One moment.
struct VtkFrame {
  double time = 0.0;             ///< [s]
  Mat motion;                    ///< points x 4: x, y [m], theta_x, theta_y [rad]
  std::vector<VtkForce> forces;  ///< one per contact of the scene
};

struct VtkOptions {
  double deflection_scale = 0.0;  ///< drawn per true displacement; 0: vtk_deflection_scale()
  double force_scale = 0.0;       ///< [m/N]; 0: the largest force as long as 15 % of the scene
  int facets = 48;                ///< points around, >= 3
  int sections = 4;               ///< parts that a piece of the shaft is drawn in, >= 1
  Replaces replaces = Replaces::own_pictures;
};

/// Writes "x.pvd" and "x/x_0001.vtp", "x/x_0002.vtp", ...
///
/// A point at arm r from a point of the scene with displacement u and tilt theta is displaced by
///
///   u + theta x r
///
/// and drawn at its undeformed position + deflection scale * displacement. The axis of a shaft
/// piece is the cubic whose slopes at its ends are the tilts there; between the ends tilts are
/// linear.
///
/// Point data: "displacement [m]" and "rotation [rad]", both true; "undeformed position [m]";
/// "contact force [N]", at both ends of the lines. Cell data: "part" (0 shaft, 1 disk, 2 stator,
/// 3 contact force, 4 a disk whose size is not given: a symbol of which every other sector is
/// there, 5 bearing or spring, 6 the plate of the ground or body that it stands on), "member" (its
/// number from 1 among its kind), "in touch" (0, 1). Field data: "time [s]", "deflection scale",
/// "force scale [m/N]", "disk names", "stator names", "contact names", "support names".
///
/// The collection is removed first and written last: where there is one, it is complete.
///
/// @param frames  all with as many points and contacts as the scene
/// @return        paths of the files, the collection first
/// @throws FileError  if a file cannot be written
std::vector<std::filesystem::path> write_vtk_series(const std::filesystem::path& pvd_path,
                                                    const VtkScene& scene,
                                                    const std::vector<VtkFrame>& frames,
                                                    const VtkOptions& options = {});

/// The scale at which the largest displacement of all frames is drawn as 12 % of the scene's size,
/// or the largest tilt as 0.35 rad if that is less: disks that tilt more would look stretched. The
/// size is the distance of the outermost points or the largest diameter. 1 where nothing moves.
double vtk_fitting_scale(const VtkScene& scene, const std::vector<VtkFrame>& frames);

/// The fitting scale, and at least 1: a motion is never drawn smaller than it is.
double vtk_deflection_scale(const VtkScene& scene, const std::vector<VtkFrame>& frames);

}  // namespace whirl::inline io

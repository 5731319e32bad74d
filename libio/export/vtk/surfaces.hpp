#pragma once
/// The surfaces of a scene and where their vertices are. No VTK here: see writer.cpp.

#include <vector>

#include "libio/export/vtk.hpp"

namespace whirl::inline io::vtk {

/// Kinds of cells, as "part" numbers them.
enum Part { shaft, disk, stator, contact_force, disk_symbol, support, foot };

/// A point of a surface and what it moves with.
struct Vertex {
  int left = -1, right = -1;        ///< points of the scene; -1: at rest
  double share = 0.0;               ///< where between them, from 0 to 1
  Eigen::Vector3d arm;              ///< from the axis there to the vertex, or from the origin [m]
  Eigen::Vector3d gap = {0, 0, 0};  ///< added to the arm, and drawn enlarged [m]
};

struct Cell {
  std::vector<int> vertices;
  Part part;
  int member;  ///< number from 1 among its kind
};

/// All surfaces, the same in every frame.
struct Surfaces {
  std::vector<Vertex> vertices;
  std::vector<Cell> cells;
};

/// @param options  facets and sections
Surfaces surfaces_of(const VtkScene& scene, const VtkOptions& options);

/// Where a vertex is at rest [m] and how it has moved [m, rad].
struct Placement {
  Eigen::Vector3d rest, displacement, rotation;
};

/// @param motion  as in VtkFrame
Placement place(const Vertex& vertex, const VtkScene& scene, const Mat& motion);

/// Scale of the force lines for the largest force of all frames [m/N].
double force_scale(const VtkScene& scene, const std::vector<VtkFrame>& frames);

}  // namespace whirl::inline io::vtk

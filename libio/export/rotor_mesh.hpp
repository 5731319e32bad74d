#pragma once
/// The rotor as a mesh that other programs read: lines along its axis, or triangles around it.

#include <array>
#include <string>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libio/export/vtk.hpp"

namespace whirl::inline io {

/// Displacements of all points of a scene.
struct MeshField {
  std::string name;
  Mat motion;  ///< as in VtkFrame
};

/// Numbers of all points or cells of a mesh.
struct MeshArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
  bool is_integer = false;
};

/// A mesh of cells of one kind.
struct RotorMesh {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  std::vector<std::array<int, 3>> cells;
  int corners = 2;  ///< of a cell: a line has two, a triangle three
  std::vector<MeshArray> point_data, cell_data;
};

/// Nodes and elements of the shaft, in the model's numbering. Bodies have no place in it.
///
/// Point data: "node" from 1; "disk", "bearing" and "contact", numbers from 1 of what is there, or
/// 0, and "seal" of a model that has some; "disk_mass_kg"; of every field the displacement [m]
/// under the field's name, and the tilts [rad] under that name with "_tilt" behind it. Cell data:
/// "segment" from 1, the diameters at both ends, "youngs_modulus_pa", "density_kg_m3"; if there are
/// layers, whose cells lie on those of the shaft, "layer" from 1, 0 of the shaft.
///
/// @param group  name of integer cell data with the segment's number; empty: none
/// @throws ModelError  if the model has no shaft
RotorMesh line_mesh(const Model& model, const Assembler& assembler,
                    const std::vector<MeshField>& fields, const std::string& group);

/// The surface of the shaft, and of disks whose size is given. Cell data: "part", 0 shaft, 1 disk.
RotorMesh surface_mesh(const VtkScene& scene, const std::vector<MeshField>& fields);

/// VTK's format of unstructured grids, as text.
std::string vtu_of(const RotorMesh& mesh);

}  // namespace whirl::inline io

#include "libio/export/rotor_mesh.hpp"

#include <fmt/format.h>

#include <map>

#include "libbase/error.hpp"
#include "libio/export/vtk/surfaces.hpp"
#include "libio/results/own_file.hpp"

namespace whirl::inline io {

namespace {

/// Numbers from 1 of the things at each node; of several the first.
template <class List, class StationOf>
MeshArray numbers_at_nodes(std::string name, const List& list, StationOf station_of,
                           const Assembler& assembler) {
  MeshArray array{std::move(name), 1, {}};
  array.values.assign(assembler.mesh().z.size(), 0.0);
  double number = 0.0;
  for (const auto& item : list) {
    ++number;
    for (const Station& station : station_of(item)) {
      const Point point = assembler.point(station);
      if (point.kind != Point::Kind::node) continue;
      double& value = array.values[static_cast<std::size_t>(point.index)];
      if (value == 0.0) value = number;
    }
  }
  return array;
}

void append(std::vector<double>& values, const Eigen::Vector3d& v) {
  values.insert(values.end(), v.data(), v.data() + 3);
}

void write_array(std::string& out, const MeshArray& array) {
  // meshio takes "one component" for matrices of one column, which some formats refuse
  const std::string components =
      array.components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", array.components);
  out += fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"ascii\">\n",
                     array.is_integer ? "Int64" : "Float64", array.name, components);
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    out += array.is_integer ? fmt::format("{}", static_cast<long>(array.values[i]))
                            : fmt::format("{}", array.values[i]);
    out += (i + 1) % static_cast<std::size_t>(array.components) == 0 ? '\n' : ' ';
  }
  out += "</DataArray>\n";
}

/// What is at the nodes of a rotor.
std::vector<MeshArray> arrays_of_nodes(const Model& model, const Assembler& assembler) {
  const Structure& s = model.structure;
  const auto at_its_ends = [](const auto& c) { return std::vector{c.from, c.to}; };
  MeshArray node{"node"}, mass{"disk_mass_kg"};
  for (std::size_t i = 0; i < assembler.mesh().z.size(); ++i) {
    node.values.push_back(static_cast<double>(i + 1));
  }
  mass.values.assign(node.values.size(), 0.0);
  for (const Disk& d : s.disks) {
    mass.values[static_cast<std::size_t>(assembler.point(d.at).index)] += d.m;
  }
  std::vector<MeshArray> arrays{
      node,
      numbers_at_nodes(
          "disk", s.disks, [](const Disk& d) { return std::vector{d.at}; }, assembler),
      mass, numbers_at_nodes("bearing", s.bearings, at_its_ends, assembler),
      numbers_at_nodes(
          "contact", model.contacts,
          [](const Contact& c) {
            return c.limits ? std::vector<Station>{} : std::vector{c.at, c.against};
          },
          assembler)};
  if (!s.seals.empty()) {
    arrays.push_back(numbers_at_nodes("seal", s.seals, at_its_ends, assembler));
  }
  return arrays;
}

/// What the elements and layers are made of, a cell for each.
struct CellArrays {
  MeshArray segment{"segment"}, outer_left{"outer_diameter_left_m"},
      outer_right{"outer_diameter_right_m"}, inner_left{"inner_diameter_left_m"},
      inner_right{"inner_diameter_right_m"}, modulus{"youngs_modulus_pa"}, density{"density_kg_m3"},
      layer{"layer"};

  /// Adds a piece of a segment or a layer between fractions of its length.
  /// @param number  of the layer, from 1; 0: a segment
  void add(const MeshElement& e, const auto& part, double from, double to, int number) {
    const Section left = between(part.left, part.right, from),
                  right = between(part.left, part.right, to);
    segment.values.push_back(e.segment + 1);
    outer_left.values.push_back(left.outer);
    outer_right.values.push_back(right.outer);
    inner_left.values.push_back(left.inner);
    inner_right.values.push_back(right.inner);
    modulus.values.push_back(part.material.E);
    density.values.push_back(part.material.rho);
    layer.values.push_back(number);
  }
};

/// Adds the cells of elements and layers with what they are made of.
/// @param group  name of one more array, which holds the segments; empty: none
void add_cells(const Structure& s, const Mesh& mesh, const std::string& group, RotorMesh& to) {
  CellArrays cells;
  const auto add = [&](const MeshElement& e, const auto& part, double from, double end,
                       int number) {
    to.cells.push_back({e.left, e.right, 0});
    cells.add(e, part, from, end, number);
  };
  for (const MeshElement& e : mesh.elements) {
    add(e, s.segments_of(e.shaft)[static_cast<std::size_t>(e.segment)], e.from, e.to, 0);
  }
  for (const MeshLayer& piece : mesh.layers) {
    add(mesh.elements[static_cast<std::size_t>(piece.element)],
        s.layers[static_cast<std::size_t>(piece.layer)], piece.from, piece.to, piece.layer + 1);
  }
  to.cell_data = {cells.segment,     cells.outer_left, cells.outer_right, cells.inner_left,
                  cells.inner_right, cells.modulus,    cells.density};
  if (!s.layers.empty()) to.cell_data.push_back(cells.layer);
  if (!group.empty()) to.cell_data.push_back({group, 1, cells.segment.values, true});
}

}  // namespace

RotorMesh line_mesh(const Model& model, const Assembler& assembler,
                    const std::vector<MeshField>& fields, const std::string& group) {
  const Mesh& mesh = assembler.mesh();
  if (mesh.elements.empty()) {
    throw ModelError({}, "", "the model has no shaft, of which a mesh could be written");
  }
  RotorMesh result;
  for (const double z : mesh.z) result.points.emplace_back(0.0, 0.0, z);
  result.point_data = arrays_of_nodes(model, assembler);
  for (const MeshField& field : fields) {
    MeshArray displacement{field.name, 3}, tilt{field.name + "_tilt", 3};
    for (Eigen::Index i = 0; i < std::ssize(mesh.z); ++i) {
      append(displacement.values, {field.motion(i, 0), field.motion(i, 1), 0.0});
      append(tilt.values, {field.motion(i, 2), field.motion(i, 3), 0.0});
    }
    result.point_data.insert(result.point_data.end(), {displacement, tilt});
  }
  add_cells(model.structure, mesh, group, result);
  return result;
}

RotorMesh surface_mesh(const VtkScene& scene, const std::vector<MeshField>& fields) {
  VtkOptions options;
  options.sections = 1;
  const vtk::Surfaces surfaces = vtk::surfaces_of(scene, options);
  const Mat at_rest = Mat::Zero(std::ssize(scene.z), 4);
  RotorMesh mesh;
  mesh.corners = 3;
  MeshArray part{"part"};
  std::map<int, int> places;  // of vertices that are written
  std::vector<const vtk::Vertex*> written;
  const auto place_of = [&](int vertex) {
    const auto [at, is_new] = places.try_emplace(vertex, static_cast<int>(written.size()));
    if (is_new) written.push_back(&surfaces.vertices[static_cast<std::size_t>(vertex)]);
    return at->second;
  };
  for (const vtk::Cell& cell : surfaces.cells) {
    if (cell.part != vtk::shaft && cell.part != vtk::disk) continue;
    for (std::size_t i = 2; i < cell.vertices.size(); ++i) {
      mesh.cells.push_back(
          {place_of(cell.vertices[0]), place_of(cell.vertices[i - 1]), place_of(cell.vertices[i])});
      part.values.push_back(cell.part);
    }
  }
  if (mesh.cells.empty()) {
    throw ModelError({}, "", "the model has neither shaft nor disks, which could be written");
  }
  for (const vtk::Vertex* v : written) {
    mesh.points.push_back(vtk::place(*v, scene, at_rest).rest);
  }
  for (const MeshField& field : fields) {
    MeshArray displacement{field.name, 3};
    for (const vtk::Vertex* v : written) {
      append(displacement.values, vtk::place(*v, scene, field.motion).displacement);
    }
    mesh.point_data.push_back(std::move(displacement));
  }
  mesh.cell_data.push_back(std::move(part));
  return mesh;
}

std::string vtu_of(const RotorMesh& mesh) {
  constexpr int vtk_line = 3, vtk_triangle = 5;
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n{}\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n",
      xml_mark, mesh.points.size(), mesh.cells.size());
  for (const MeshArray& array : mesh.point_data) write_array(out, array);
  out += "</PointData>\n<CellData>\n";
  for (const MeshArray& array : mesh.cell_data) write_array(out, array);
  out += "</CellData>\n<Points>\n";
  MeshArray points{"Points", 3}, corners{"connectivity", mesh.corners, {}, true},
      offsets{"offsets", 1, {}, true}, types{"types", 1, {}, true};
  for (const Eigen::Vector3d& p : mesh.points) append(points.values, p);
  for (const auto& cell : mesh.cells) {
    for (int i = 0; i < mesh.corners; ++i) {
      corners.values.push_back(cell[static_cast<std::size_t>(i)]);
    }
    offsets.values.push_back(static_cast<double>(corners.values.size()));
    types.values.push_back(mesh.corners == 2 ? vtk_line : vtk_triangle);
  }
  corners.components = 1;  // VTK takes no others here
  write_array(out, points);
  out += "</Points>\n<Cells>\n";
  for (const MeshArray* array : {&corners, &offsets, &types}) write_array(out, *array);
  return out + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace whirl::inline io

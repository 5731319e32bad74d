#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cassert>
#include <fstream>

#include "libio/export/vtk.hpp"
#include "libio/export/vtk/surfaces.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using namespace vtk;

namespace {

/// Scales of a series, and what does not change in it.
struct Series {
  const VtkScene& scene;
  Surfaces surfaces;
  double deflection_scale, force_scale;
};

template <class Array>
vtkNew<Array> named_array(const std::string& name, int components = 1) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}

template <class Member>
void add_names(vtkPolyData* data, const std::string& name, const std::vector<Member>& members) {
  const auto array = named_array<vtkStringArray>(name);
  for (const Member& member : members) array->InsertNextValue(member.name);
  data->GetFieldData()->AddArray(array);
}

void add_number(vtkPolyData* data, const std::string& name, double value) {
  const auto array = named_array<vtkDoubleArray>(name);
  array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}

/// Points of a frame, with what stands at them.
struct Points {
  vtkNew<vtkPoints> drawn;
  vtkNew<vtkFloatArray> displacement = named_array<vtkFloatArray>("displacement [m]", 3);
  vtkNew<vtkFloatArray> rotation = named_array<vtkFloatArray>("rotation [rad]", 3);
  vtkNew<vtkFloatArray> rest = named_array<vtkFloatArray>("undeformed position [m]", 3);
  vtkNew<vtkFloatArray> force = named_array<vtkFloatArray>("contact force [N]", 3);

  void add(const Placement& p, const Vector3d& at, const Vector3d& f) {
    drawn->InsertNextPoint(at.data());
    displacement->InsertNextTuple(p.displacement.data());
    rotation->InsertNextTuple(p.rotation.data());
    rest->InsertNextTuple(p.rest.data());
    force->InsertNextTuple(f.data());
  }
};

/// Lines and polygons of a frame, with what they belong to. VTK numbers lines before polygons, in
/// the cells' data too.
struct Cells {
  vtkNew<vtkCellArray> lines, polygons;
  vtkNew<vtkIntArray> part = named_array<vtkIntArray>("part");
  vtkNew<vtkIntArray> member = named_array<vtkIntArray>("member");
  vtkNew<vtkIntArray> touch = named_array<vtkIntArray>("in touch");

  void describe(int of_part, int of_member, bool is_touching) {
    part->InsertNextValue(of_part);
    member->InsertNextValue(of_member);
    touch->InsertNextValue(is_touching);
  }
};

/// Adds a line for the force of every contact.
void add_forces(const Series& series, const VtkFrame& frame, Points& points, Cells& cells) {
  const VtkScene& scene = series.scene;
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    const VtkForce& f = frame.forces[k];
    const int point = scene.contacts[k].point;
    const Vector3d vector(f.force.x(), f.force.y(), 0.0);
    const Placement p = place({point, point, 0.0, f.arm}, scene, frame.motion);
    const Vector3d foot = p.rest + series.deflection_scale * p.displacement;
    const vtkIdType first = points.drawn->GetNumberOfPoints();
    points.add(p, foot, vector);
    points.add(p, foot + series.force_scale * vector, vector);
    cells.lines->InsertNextCell({first, first + 1});
    cells.describe(contact_force, static_cast<int>(k) + 1, f.is_touching);
  }
}

vtkNew<vtkPolyData> data_of(const Series& series, const VtkFrame& frame) {
  const VtkScene& scene = series.scene;
  const double scale = series.deflection_scale;
  Points points;
  for (const Vertex& vertex : series.surfaces.vertices) {
    const Placement p = place(vertex, scene, frame.motion);
    points.add(p, p.rest + scale * p.displacement + (scale - 1.0) * vertex.gap, Vector3d::Zero());
  }
  Cells cells;
  add_forces(series, frame, points, cells);
  for (const Cell& cell : series.surfaces.cells) {
    cells.polygons->InsertNextCell(static_cast<int>(cell.vertices.size()));
    for (const int vertex : cell.vertices) cells.polygons->InsertCellPoint(vertex);
    cells.describe(cell.part, cell.member, false);
  }

  vtkNew<vtkPolyData> data;
  data->SetPoints(points.drawn);
  data->SetLines(cells.lines);
  data->SetPolys(cells.polygons);
  for (vtkDataArray* array :
       {points.displacement.Get(), points.rotation.Get(), points.rest.Get(), points.force.Get()}) {
    data->GetPointData()->AddArray(array);
  }
  for (vtkDataArray* array : {cells.part.Get(), cells.member.Get(), cells.touch.Get()}) {
    data->GetCellData()->AddArray(array);
  }
  add_number(data, "time [s]", frame.time);
  add_number(data, "deflection scale", series.deflection_scale);
  add_number(data, "force scale [m/N]", series.force_scale);
  add_names(data, "disk names", scene.disks);
  add_names(data, "stator names", scene.stators);
  add_names(data, "contact names", scene.contacts);
  add_names(data, "support names", scene.supports);
  return data;
}

void write_frame(const fs::path& path, vtkPolyData* data) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  vtkNew<vtkCallbackCommand> no_message;  // without a listener VTK prints its errors
  writer->AddObserver(vtkCommand::ErrorEvent, no_message);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, no_message);
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError) {
    throw FileError(fmt::format("cannot write {}: {}", path.string(),
                                vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
  }
}

}  // namespace

std::vector<fs::path> write_vtk_series(const fs::path& pvd_path, const VtkScene& scene,
                                       const std::vector<VtkFrame>& frames,
                                       const VtkOptions& options) {
  assert(options.facets >= 3 && options.sections >= 1);
  if (pvd_path.extension() != ".pvd") {
    throw FileError(fmt::format("cannot write {}: the name must end in .pvd", pvd_path.string()));
  }
  FileReplacement collection(pvd_path, options.replaces);
  const std::string stem = pvd_path.stem().string();
  const fs::path folder = pvd_path.parent_path() / stem;
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames.size()).size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    names.push_back(fmt::format("{}_{:0{}}.vtp", stem, i + 1, digits));
    require_replaceable(folder / names.back(), options.replaces);
  }
  std::error_code problem;
  fs::remove(collection.place(), problem);
  fs::create_directory(folder, problem);
  if (problem) {
    throw FileError(fmt::format("cannot make {}: {}", folder.string(), problem.message()));
  }

  const Series series{
      scene, surfaces_of(scene, options),
      options.deflection_scale != 0.0 ? options.deflection_scale
                                      : vtk_deflection_scale(scene, frames),
      options.force_scale != 0.0 ? options.force_scale : force_scale(scene, frames)};
  std::vector<fs::path> paths = {pvd_path};
  std::string list;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    assert(frames[i].motion.rows() == std::ssize(scene.z) && frames[i].motion.cols() == 4);
    assert(frames[i].forces.size() == scene.contacts.size());
    const std::string& name = names[i];
    write_frame(folder / name, data_of(series, frames[i]));
    paths.push_back(folder / name);
    list += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n",
                        frames[i].time, xml_text(stem + '/' + name));
  }

  std::ofstream stream(collection.temporary(), std::ios::binary);
  stream << "<?xml version=\"1.0\"?>\n"
         << xml_mark << "\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
         << list << "  </Collection>\n</VTKFile>\n";
  stream.close();
  if (!stream) throw FileError(fmt::format("cannot write {}", pvd_path.string()));
  collection.commit();
  return paths;
}

}  // namespace whirl::inline io

#include "libio/export/mesh_formats.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/system/program.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/results/temporary_folder.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

constexpr bool lines = true, surface = false;

}  // namespace

const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> all{{"abaqus", ".inp", lines},
                                           {"ansys", ".msh", surface},
                                           {"avsucd", ".avs", lines, "avsucd:material"},
                                           {"exodus", ".e", lines},
                                           {"gmsh", ".msh", lines, "gmsh:physical"},
                                           {"gmsh22", ".msh", lines, "gmsh:physical"},
                                           {"hmf", ".hmf", lines},
                                           {"mdpa", ".mdpa", lines},
                                           {"med", ".med", lines},
                                           {"medit", ".mesh", lines, "medit:ref"},
                                           {"nastran", ".bdf", lines, "nastran:ref"},
                                           {"netgen", ".vol", lines, "netgen:index"},
                                           {"neuroglancer", ".ng", surface},
                                           {"obj", ".obj", surface},
                                           {"off", ".off", surface},
                                           {"permas", ".post", lines},
                                           {"ply", ".ply", surface},
                                           {"stl", ".stl", surface},
                                           {"tecplot", ".dat", lines},
                                           {"vtk42", ".vtk", lines},
                                           {"vtk51", ".vtk", lines},
                                           {"vtu", ".vtu", lines},
                                           {"wkt", ".wkt", surface}};
  return all;
}

const MeshFormat* mesh_format(std::string_view name) {
  const auto& all = mesh_formats();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const MeshFormat& format) { return format.name == name; });
  return found == all.end() ? nullptr : &*found;
}

void write_mesh(const fs::path& place, const MeshFormat& format, const RotorMesh& mesh,
                Replaces replaces) {
  if (format.name == "vtu") return replace_file(place, vtu_of(mesh), replaces);
  FileReplacement file(place, replaces);  // a wrong place is said first
  const TemporaryFolder folder("export", place);
  const fs::path from = folder.path() / "mesh.vtu", to = folder.path() / "mesh",
                 output = folder.path() / "output.txt";
  replace_file(from, vtu_of(mesh));
  const auto fail = [&](const std::string& why) {
    throw FileError(fmt::format("cannot write {}: {}", place.string(), why));
  };
  const std::optional<int> status =
      run_program({"meshio", "convert", "--input-format", "vtu", "--output-format",
                   std::string(format.name), from.string(), to.string()},
                  output);
  if (!status) {
    fail(
        fmt::format("the format {} needs meshio, of the Debian package meshio-tools (vtu, vtk, "
                    "xdmf and csv do not)",
                    format.name));
  }
  std::error_code problem;
  if (*status != 0) fail("meshio says: " + last_words(output));
  if (!fs::exists(to, problem) || fs::file_size(to, problem) == 0) {
    fail("meshio wrote nothing: " + last_words(output));
  }
  fs::copy_file(to, file.temporary(), fs::copy_options::overwrite_existing, problem);
  if (problem) fail(problem.message());
  file.commit();
}

}  // namespace whirl::inline io

#include "libio/export/mesh_formats.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "libbase/program.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

constexpr bool lines = true, surface = false;

/// Files beside a place, removed at the end.
struct Beside {
  fs::path mesh, result, output;
  explicit Beside(const fs::path& place) {
    const std::string stem = fmt::format("{}.{}", place.string(), ::getpid());
    mesh = stem + ".vtu";
    result = stem + ".part";
    output = stem + ".txt";
  }
  ~Beside() {
    std::error_code ignored;
    for (const fs::path& file : {mesh, result, output}) fs::remove(file, ignored);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
};

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
  FileReplacement{place, replaces};  // a wrong place is said first
  const Beside beside(place);
  replace_file(beside.mesh, vtu_of(mesh));
  const auto fail = [&](const std::string& why) {
    throw FileError(fmt::format("cannot write {}: {}", place.string(), why));
  };
  const std::optional<int> status = run_program(
      {"meshio", "convert", "--input-format", "vtu", "--output-format", std::string(format.name),
       fs::absolute(beside.mesh).string(), fs::absolute(beside.result).string()},
      beside.output);
  if (!status) {
    fail(
        fmt::format("the format {} needs meshio, of the Debian package meshio-tools (vtu, vtk, "
                    "xdmf and csv do not)",
                    format.name));
  }
  std::error_code problem;
  if (*status != 0) fail("meshio says: " + last_words(beside.output));
  if (!fs::exists(beside.result, problem) || fs::file_size(beside.result, problem) == 0) {
    fail("meshio wrote nothing: " + last_words(beside.output));
  }
  fs::rename(beside.result, place, problem);
  if (problem) fail(problem.message());
}

}  // namespace whirl::inline io

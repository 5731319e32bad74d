#pragma once
/// Formats of finite element programs, which meshio writes.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "libio/export/rotor_mesh.hpp"

namespace whirl::inline io {

/// A format that a mesh of the rotor is written in.
struct MeshFormat {
  std::string_view name;        ///< as meshio calls it
  std::string_view ending;      ///< of its files
  bool has_lines = true;        ///< takes elements of a shaft; else the surface is written
  std::string_view group = "";  ///< integer cell data that become properties or groups
};

/// All formats; VTU needs no meshio.
const std::vector<MeshFormat>& mesh_formats();

/// The format of a name, or null.
const MeshFormat* mesh_format(std::string_view name);

/// Writes a mesh: whole, or not at all.
/// @throws FileError  with what meshio says, or with the package of meshio if that is missing
void write_mesh(const std::filesystem::path& place, const MeshFormat& format, const RotorMesh& mesh,
                Replaces replaces);

}  // namespace whirl::inline io

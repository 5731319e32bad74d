#pragma once
/// A model or a result to other programs, in any of the formats that are known.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libio/export/mesh_formats.hpp"
#include "libio/export/scene_source.hpp"

namespace whirl::inline io {

/// A format of ours, or one of finite element programs.
struct ExportFormat {
  std::string name, ending;
  const MeshFormat* mesh = nullptr;  ///< null: one of ours
};
/// The format of a name.
/// @throws ModelError  for other names, with all that there are
ExportFormat export_format(const std::string& name);

struct ExportOptions {
  ExportFormat format;
  std::filesystem::path stem;  ///< of the files; an ending that this program knows does not count
  MotionWindow window{};
  std::optional<long> frames{};  ///< of a motion at most; left out: 128, of XDMF all
  long modes = 4;                ///< mode shapes, where there are any
  Replaces replaces = Replaces::own_pictures;
};

/// What an export wrote.
struct Exported {
  std::vector<std::filesystem::path> files;
  std::string text;                  ///< for people, lines
  std::vector<std::string> notes{};  ///< what matrices leave out or linearize
};

/// Writes the motion and the modes of a source, or its tables.
/// @throws ModelError      for tables of a model, and for a window where nothing moves
/// @throws FileError       if a file cannot be written
/// @throws NumericalError  for matrices and modes where oil films carry nothing, as at rest
Exported export_scene(const SceneSource& source, const ExportOptions& options);

}  // namespace whirl::inline io

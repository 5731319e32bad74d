#include "libio/export/scene_export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libio/export/matrices.hpp"
#include "libio/export/rotor_mesh.hpp"
#include "libio/export/universal_file.hpp"
#include "libio/export/xdmf.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/results/dataset_path.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/option_values.hpp"
#include "libio/texts/model_text.hpp"

namespace whirl::inline io {

namespace {

namespace fs = std::filesystem;

constexpr int mode_frames = 36;
constexpr double all_revolutions = 1e9;

/// Formats of ours and the endings of their files.
struct OwnFormat {
  std::string_view name, ending;
};
constexpr std::array<OwnFormat, 6> own_formats{{{"vtk", ".pvd"},
                                                {"xdmf", ".xdmf"},
                                                {"csv", ".csv"},
                                                {"uff", ".uff"},
                                                {"mtx", ".mtx"},
                                                {"mat", ".mat"}}};

/// A name without the ending of a file that this program knows; other points in it stay.
fs::path without_ending(fs::path file, const std::string& of_format) {
  for (const std::string& ending :
       {of_format, std::string(".vtp"), std::string(".vtk"), std::string(".h5"),
        std::string(".hdf5"), std::string(".toml")}) {
    if (file.extension() == ending) return file.replace_extension("");
  }
  return file;
}

/// Series of moments for ParaView, by one of two writers.
Exported export_series(const SceneSource& source, const ExportOptions& options,
                       const fs::path& stem) {
  const std::string& ending = options.format.ending;
  const bool is_xdmf = options.format.name == "xdmf";
  Exported written{{}, fmt::format("Written for ParaView (open the {} files)\n\n", ending)};
  const auto write = [&](const std::string& suffix, const std::vector<VtkFrame>& frames,
                         const std::string& what) {
    const fs::path place = stem.string() + suffix + ending;
    const auto files =
        is_xdmf ? write_xdmf_series(place, source.scene, frames, options.replaces)
                : write_vtk_series(place, source.scene, frames, {.replaces = options.replaces});
    written.files.insert(written.files.end(), files.begin(), files.end());
    written.text += fmt::format("  {}: {} frames, {}\n", place.string(), frames.size(), what);
  };
  if (source.has_motion()) {
    const MotionSamples samples = source.samples(options.window, is_xdmf ? 64.0 : 4.0);
    const long most = options.frames.value_or(is_xdmf ? 100'000 : 128);
    write("", source.motion(samples, most), samples.text);
  }
  if (source.has_modes()) {
    source.each_mode(options.modes, mode_frames,
                     [&](int number, const Mode& mode, const std::vector<VtkFrame>& frames) {
                       write(fmt::format("_mode{}", number), frames, told(number, mode));
                     });
  }
  if (const std::string told = symbols_told(source.scene); !told.empty() && !is_xdmf) {
    written.text += fmt::format("\n  {}\n", told);
  }
  return written;
}

Exported export_csv(const SceneSource& source, const ExportOptions& options, const fs::path& stem) {
  if (!source.result) {
    throw ModelError({"--format csv"}, "", "a model holds no tables; take the result of a verb");
  }
  std::optional<MotionSamples> samples;
  if (options.window.is_given()) {
    samples = source.samples(options.window, all_revolutions);
  }
  Exported written{write_csv_tables(*source.result, stem, options.replaces, samples), ""};
  if (samples) written.text = fmt::format("  of the motion {}\n", samples->text);
  for (const fs::path& file : written.files) written.text += fmt::format("  {}\n", file.string());
  if (written.files.empty()) written.text = "There are no tables in this result\n";
  return written;
}

/// The matrices at the operating speed, of the rotor as linear analyses have it.
Exported export_matrices(const SceneSource& source, const ExportOptions& options,
                         const fs::path& stem) {
  const auto write = options.format.name == "mat" ? write_matlab : write_matrix_market;
  const double Omega = source.model.speed;
  Exported written{write(stem, source.model, source.assembler, Omega, options.replaces),
                   fmt::format("M q'' + (C + Omega G) q' + K q = f at {:.6g} rpm\n\n", Omega / rpm),
                   linear_notes(source.model, {Omega})};
  for (const fs::path& file : written.files) written.text += fmt::format("  {}\n", file.string());
  return written;
}

/// Frequency responses as a universal file.
Exported export_universal(const SceneSource& source, const ExportOptions& options,
                          const fs::path& stem) {
  if (!source.result ||
      !source.result->has(dataset_of<FrequencyResponse>(&ResponsePair::receptance))) {
    throw ModelError({"--format uff"}, "",
                     "is for frequency responses; take the result of whirl frf");
  }
  const fs::path place = stem.string() + options.format.ending;
  const auto found = read_result<FrequencyResponse>(*source.result);
  write_universal(place, found, source.model, source.assembler, options.replaces);
  return {{place},
          fmt::format("  {}: receptances, mobilities and accelerances of {} pairs\n",
                      place.string(), found.pairs.size())};
}

Exported export_mesh(const SceneSource& source, const ExportOptions& options,
                     const fs::path& stem) {
  const MeshFormat& format = *options.format.mesh;
  std::vector<MeshField> fields;
  std::string told_fields;
  const auto add = [&](const std::string& name, const Mat& motion, const std::string& what) {
    fields.push_back({name, motion});
    told_fields += fmt::format("    {}: {}\n", name, what);
  };
  if (source.has_motion()) {
    MotionSamples samples = source.samples(options.window, 1.0);
    samples.first = samples.last;
    add("displacement_m", source.motion(samples, 1).back().motion,
        fmt::format("at the end of {}", samples.text));
  }
  if (source.has_modes()) {
    source.each_mode(
        options.modes, 4, [&](int number, const Mode& mode, const std::vector<VtkFrame>& quarters) {
          for (const int k : {0, 1}) {
            add(fmt::format("mode{}_{}deg", number, 90 * k),
                quarters[static_cast<std::size_t>(k)].motion,
                fmt::format("{}, at {} degrees of its cycle", told(number, mode), 90 * k));
          }
        });
  }
  const RotorMesh mesh = format.has_lines ? line_mesh(source.model, source.assembler, fields,
                                                      std::string(format.group))
                                          : surface_mesh(source.scene, fields);
  const fs::path place = stem.string() + options.format.ending;
  write_mesh(place, format, mesh, options.replaces);
  Exported written{
      {place},
      fmt::format("  {}: {} {} and {} points; where the format takes fields\n{}", place.string(),
                  mesh.cells.size(), format.has_lines ? "lines" : "triangles", mesh.points.size(),
                  told_fields)};
  if (format.has_lines) return written;
  for (const VtkDisk& d : source.scene.disks) {
    if (d.not_given.empty()) continue;
    written.notes.push_back(
        fmt::format("\"{}\" is left out: the model does not give its {}", d.name, d.not_given));
  }
  return written;
}

}  // namespace

ExportFormat export_format(const std::string& name) {
  std::vector<std::string> known;
  for (const OwnFormat& own : own_formats) {
    if (own.name == name) return {name, std::string(own.ending)};
    known.emplace_back(own.name);
  }
  if (const MeshFormat* mesh = mesh_format(name)) return {name, std::string(mesh->ending), mesh};
  for (const MeshFormat& mesh : mesh_formats()) known.emplace_back(mesh.name);
  const auto near = nearest(name, known);
  throw wrong_option("format", name,
                     fmt::format("unknown format{}; there are {}",
                                 near ? fmt::format(", did you mean \"{}\"?", *near) : "",
                                 fmt::join(known, ", ")));
}

Exported export_scene(const SceneSource& source, const ExportOptions& options) {
  if (!source.has_motion() && options.window.is_given()) {
    throw wrong_window("are of motions, and this file holds none");
  }
  const fs::path stem = without_ending(options.stem, options.format.ending);
  if (options.format.mesh) return export_mesh(source, options, stem);
  if (options.format.name == "csv") return export_csv(source, options, stem);
  if (options.format.name == "uff") return export_universal(source, options, stem);
  if (options.format.name == "mtx" || options.format.name == "mat") {
    return export_matrices(source, options, stem);
  }
  return export_series(source, options, stem);
}

}  // namespace whirl::inline io

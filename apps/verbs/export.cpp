#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "libio/export/mesh_formats.hpp"
#include "libio/export/rotor_mesh.hpp"
#include "libio/export/scene_source.hpp"
#include "libio/export/xdmf.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline cli {

namespace {

namespace fs = std::filesystem;

constexpr int mode_frames = 36;

/// A name without the ending of a file that this program knows; other points in it stay.
fs::path without_ending(fs::path file, const std::string& of_format) {
  for (const std::string& ending :
       {of_format, std::string(".vtp"), std::string(".vtk"), std::string(".h5"),
        std::string(".hdf5"), std::string(".toml")}) {
    if (file.extension() == ending) return file.replace_extension("");
  }
  return file;
}

/// Every format that is known, ours first.
std::vector<std::string> known_formats() {
  std::vector<std::string> names{"vtk", "xdmf", "csv"};
  for (const MeshFormat& format : mesh_formats()) names.emplace_back(format.name);
  return names;
}

ModelError unknown_format(const std::string& name) {
  const auto known = known_formats();
  const auto near = nearest(name, known);
  return ModelError({"--format " + name}, "",
                    fmt::format("unknown format{}; there are {}",
                                near ? fmt::format(", did you mean \"{}\"?", *near) : "",
                                fmt::join(known, ", ")));
}

/// What an export wrote.
struct Exported {
  std::vector<fs::path> files;
  std::string text;
};

/// Series of moments for ParaView, by one of two writers.
Exported export_series(const Invocation& call, const SceneSource& source, const fs::path& stem,
                       bool is_xdmf) {
  const std::string ending = is_xdmf ? ".xdmf" : ".pvd";
  Exported written{{}, fmt::format("Written for ParaView (open the {} files)\n\n", ending)};
  const auto write = [&](const std::string& suffix, const std::vector<VtkFrame>& frames,
                         const std::string& what) {
    const fs::path place = stem.string() + suffix + ending;
    const Replaces replaces = call.picture_replaces();
    const auto files = is_xdmf
                           ? write_xdmf_series(place, source.scene, frames, replaces)
                           : write_vtk_series(place, source.scene, frames, {.replaces = replaces});
    written.files.insert(written.files.end(), files.begin(), files.end());
    written.text += fmt::format("  {}: {} frames, {}\n", place.string(), frames.size(), what);
  };
  if (source.has_motion()) {
    const MotionSamples samples = source.samples(window_of(call), is_xdmf ? 64.0 : 4.0);
    write("", source.motion(samples, call.integer_or("frames", is_xdmf ? 100'000 : 128)),
          samples.text);
  }
  if (source.has_modes()) {
    source.each_mode(call.integer("modes"), mode_frames,
                     [&](int number, const Mode& mode, const std::vector<VtkFrame>& frames) {
                       write(fmt::format("_mode{}", number), frames, told(number, mode));
                     });
  }
  return written;
}

Exported export_csv(const Invocation& call, const SceneSource& source, const fs::path& stem) {
  if (!source.result) {
    throw ModelError({"--format csv"}, "", "a model holds no tables; take the result of a verb");
  }
  std::optional<MotionSamples> samples;
  if (source.has_motion() && window_of(call).is_given())
    samples = source.samples(window_of(call), 1e9);
  Exported written{write_csv_tables(*source.result, stem, call.picture_replaces(), samples), ""};
  if (samples) written.text = fmt::format("  of the motion {}\n", samples->text);
  for (const fs::path& file : written.files) written.text += fmt::format("  {}\n", file.string());
  if (written.files.empty()) written.text = "There are no tables in this result\n";
  return written;
}

Exported export_mesh(const Invocation& call, const SceneSource& source, const MeshFormat& format,
                     const fs::path& stem) {
  std::vector<MeshField> fields;
  std::string told_fields;
  const auto add = [&](const std::string& name, const Mat& motion, const std::string& what) {
    fields.push_back({name, motion});
    told_fields += fmt::format("    {}: {}\n", name, what);
  };
  if (source.has_motion()) {
    MotionSamples samples = source.samples(window_of(call), 1.0);
    samples.first = samples.last;
    add("displacement_m", source.motion(samples, 1).back().motion,
        fmt::format("at the end of {}", samples.text));
  }
  if (source.has_modes()) {
    source.each_mode(
        call.integer("modes"), 4,
        [&](int number, const Mode& mode, const std::vector<VtkFrame>& quarters) {
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
  const fs::path place = stem.string() + std::string(format.ending);
  write_mesh(place, format, mesh, call.picture_replaces());
  return {{place},
          fmt::format("  {}: {} {} and {} points; where the format takes fields\n{}",
                      place.string(), mesh.cells.size(), format.has_lines ? "lines" : "triangles",
                      mesh.points.size(), told_fields)};
}

Report run_export(const Invocation& call) {
  const std::string name = call.text("format");
  const MeshFormat* mesh = mesh_format(name);
  if (!mesh && name != "vtk" && name != "xdmf" && name != "csv") throw unknown_format(name);
  const SceneSource source = scene_source(call);
  const std::string ending = mesh ? std::string(mesh->ending) : name == "vtk" ? ".pvd" : "." + name;
  if (!source.has_motion() && window_of(call).is_given()) {
    throw ModelError({"--revolutions, --from-revolution, --times"}, "",
                     "are of motions, and this file holds none");
  }
  const fs::path stem = without_ending(call.text_or("out", call.file), ending);
  const Exported written = mesh            ? export_mesh(call, source, *mesh, stem)
                           : name == "csv" ? export_csv(call, source, stem)
                                           : export_series(call, source, stem, name == "xdmf");
  Report report{.record = begin_record(call, source.model), .text = written.text};
  Record list = Record::array();
  for (const fs::path& f : written.files) list.add(f.string());
  report.record.set("files", list);
  return report;
}

}  // namespace

Verb export_verb() {
  return {
      .name = "export",
      .group = "Results",
      .summary = "a result or a model to other programs",
      .takes = "FILE",
      .example = "whirl export run.h5 --format vtk --out run",
      .options = {{"format", "F",
                   "vtk: series for ParaView; xdmf: longer ones; csv: tables; vtu; with meshio "
                   "abaqus, nastran, gmsh, exodus, med, stl, ...",
                   "vtk"},
                  {"out", "NAME", "where the files go, without an ending; left out: beside FILE"},
                  from_revolution_option,
                  {"revolutions", "N",
                   "revolutions of a motion, given alone: the last ones; left out: 4, xdmf 64"},
                  times_option,
                  {"frames", "N", "frames of a motion at most; left out: 128, xdmf all"},
                  {"modes", "N", "mode shapes", "4"}},
      .run = run_export,
  };
}

}  // namespace whirl::inline cli

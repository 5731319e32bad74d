#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libio/export/scene_export.hpp"
#include "libverbs/command/invocation.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/result_input.hpp"

namespace whirl::inline cli {

namespace {

struct ExportVerbOptions {
  Option<std::string> format{
      "format", "F",
      "vtk: series for ParaView; xdmf: longer ones; csv: tables; uff: frequency responses; mtx, "
      "mat: M, C, G, K; vtu; with meshio abaqus, nastran, "
      "gmsh, exodus, med, stl, ...",
      "vtk"};
  Option<std::string> out =
      output_option("out", "NAME", "where the files go, without an ending; left out: beside FILE",
                    "", FileUse::stem);
  WindowVerbOptions window{
      .revolutions = {"revolutions", "N",
                      "revolutions of a motion, given alone: the last ones; left out: 4, xdmf 64",
                      revolution_range}};
  Option<long> frames{"frames", "N", "frames of a motion at most; left out: 128, xdmf all",
                      Whole{1, 10'000'000}};
  Option<long> modes{"modes", "N", "mode shapes", 4, mode_range};
  auto fields() { return std::tie(format, out, window, frames, modes); }
};

Report run_export(const Invocation& call, const ExportVerbOptions& options) {
  const ExportFormat format = export_format(*options.format);
  const SceneSource source = scene_source(call);
  const Exported written = export_scene(source, {.format = format,
                                                 .stem = options.out.value_or(call.file),
                                                 .window = window_of(options.window),
                                                 .frames = options.frames.value,
                                                 .modes = *options.modes,
                                                 .replaces = call.picture_replaces()});
  Report report = begin_report(call, source.model);
  if (written.files.empty()) {
    throw FileError(
        fmt::format("{} holds nothing that can be written as {}", call.file, *options.format));
  }
  report.text = written.text;
  report.add_notes(written.notes);
  report.record.set("files", file_list(written.files));
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
      .run = run_export,
  };
}

}  // namespace whirl::inline cli

#include <fmt/format.h>

#include <cmath>

#include "apps/verbs/all.hpp"
#include "apps/verbs/common.hpp"
#include "libio/hdf5.hpp"
#include "libio/model_file.hpp"
#include "libio/vtk_scene.hpp"

namespace whirl {

namespace {

namespace fs = std::filesystem;

constexpr int mode_frames = 36;

/// A name without the ending of a file that this program knows; other points in it stay.
fs::path without_ending(fs::path file) {
  for (const char* ending : {".pvd", ".vtp", ".vtk", ".h5", ".hdf5", ".toml"}) {
    if (file.extension() == ending) return file.replace_extension("");
  }
  return file;
}

bool is_result(const std::string& file) {
  return fs::path(file).extension() == ".h5" || fs::path(file).extension() == ".hdf5";
}

/// The last revolutions of a trajectory, evenly thinned to a number of frames.
std::vector<VtkFrame> trajectory_frames(const ResultReader& result, const Model& model,
                                        const Assembler& assembler, long revolutions, long most) {
  const Mat basis = result.matrix("/trajectory/basis");
  const Mat coordinates = result.matrix("/trajectory/coordinates");
  const Vec time = result.vector("/trajectory/time");
  const auto per_revolution =
      static_cast<Eigen::Index>(result.number_attribute("/trajectory", "samples_per_revolution"));
  const auto count = std::min<Eigen::Index>(time.size(), revolutions * per_revolution);
  const auto frames = std::min<Eigen::Index>(count, most);
  const auto contacts = static_cast<Eigen::Index>(model.contacts.size());
  Mat normal = Mat::Zero(contacts, time.size()), friction = normal;
  if (result.has("/trajectory/normal_force")) {
    normal = result.matrix("/trajectory/normal_force");
    friction = result.matrix("/trajectory/friction_force");
  }
  const int freedoms = assembler.uncondensed(0.0).dofs.full_size;
  if (basis.rows() != freedoms || normal.rows() != contacts) {
    throw ModelError(
        {}, "",
        fmt::format(
            "the motion is of another rotor ({} freedoms, {} contacts) than the model as set "
            "({}, {}): leave out --set",
            basis.rows(), normal.rows(), freedoms, contacts));
  }
  std::vector<VtkFrame> list;
  for (Eigen::Index k = 0; k < frames; ++k) {
    const auto j = time.size() - count + k * count / frames;
    list.push_back(vtk_frame(model, assembler, time(j), basis * coordinates.col(j), normal.col(j),
                             friction.col(j)));
  }
  return list;
}

}  // namespace

Report run_export(const Invocation& call) {
  const std::string format = call.text("format", "vtk");
  if (format != "vtk") {
    throw ModelError({"--format " + format}, "", "unknown format, expected vtk");
  }
  const std::unique_ptr<ResultReader> result =
      is_result(call.file) ? std::make_unique<ResultReader>(call.file) : nullptr;
  const Model model =
      result ? parse_model(result->strings("/model").at(0), call.file, call.sets) : call.model();
  const Assembler assembler(model.structure);
  const VtkScene scene = vtk_scene(model, assembler);
  const fs::path stem = without_ending(call.text("out", call.file));
  std::vector<fs::path> files;
  std::string text;
  const auto write = [&](const std::string& suffix, const std::vector<VtkFrame>& frames,
                         const std::string& what) {
    const fs::path pvd = stem.string() + suffix + ".pvd";
    const auto written = write_vtk_series(pvd, scene, frames);
    files.insert(files.end(), written.begin(), written.end());
    text += fmt::format("  {}: {} frames, {}\n", pvd.string(), frames.size(), what);
  };
  if (result && result->has("/trajectory/coordinates")) {
    const auto frames = trajectory_frames(*result, model, assembler, call.integer("revolutions", 4),
                                          call.integer("frames", 128));
    write("", frames, "the end of the motion");
  }
  const bool with_modes = !result || result->has("/modes");
  if (with_modes) {
    const System system = assembler.at(model.speed);
    const Modes modes = complex_modes(system, static_cast<int>(call.integer("modes", 4)));
    int number = 0;
    for (const Mode& mode : modes.oscillatory) {
      ++number;
      write(fmt::format("_mode{}", number), vtk_mode_frames(mode, system.dofs, scene, mode_frames),
            fmt::format("mode {} at {:.1f} rpm, {}", number, mode.frequency() / rpm,
                        name_of(mode.whirl)));
    }
  }
  Report report{.record = begin_record(call, model)};
  Record list = Record::array();
  for (const fs::path& f : files) list.add(f.string());
  report.record.set("files", list);
  report.text = "Written for ParaView (open the .pvd files)\n\n" + text;
  return report;
}

}  // namespace whirl

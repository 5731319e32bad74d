#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "libbase/program.hpp"
#include "libio/export/scene_source.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline cli {

namespace {

namespace fs = std::filesystem;

ModelError wrong(const std::string& what, std::string message) {
  return ModelError({what}, "", std::move(message));
}

/// A folder that is removed at the end: among the system's temporary ones, or beside the result
/// where there are none.
class Folder {
 public:
  explicit Folder(const fs::path& beside) {
    std::error_code problem;
    fs::path parent = fs::temp_directory_path(problem);
    if (problem) {
      parent = fs::absolute(beside).parent_path();
      ::setenv("TMPDIR", parent.c_str(), 1);  // for the programs that this one calls
    }
    std::string name = (parent / "whirl_animate_XXXXXX").string();
    if (!::mkdtemp(name.data())) {
      throw FileError(fmt::format("cannot make the folder {}: {}", name, std::strerror(errno)));
    }
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path path;
};

/// Width and height of "960x540" [pixels].
std::pair<int, int> size_of(const std::string& text) {
  constexpr int least = 64, most = 8192;
  std::pair<int, int> size;
  const char* const end = text.data() + text.size();
  const auto [at, first] = std::from_chars(text.data(), end, size.first);
  if (first == std::errc{} && at != end && *at == 'x') {
    const auto [last, second] = std::from_chars(at + 1, end, size.second);
    const auto fits = [](int pixels) { return pixels >= least && pixels <= most; };
    if (second == std::errc{} && last == end && fits(size.first) && fits(size.second)) return size;
  }
  throw wrong(
      "--size " + text,
      fmt::format("expected WIDTHxHEIGHT of {} to {} pixels, such as 960x540", least, most));
}

/// The program that draws, beside this one.
fs::path renderer() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).replace_filename("whirl_render");
}

/// Lets the renderer draw a series, on a display of its own where there is none.
void render(const fs::path& series, const fs::path& to, std::pair<int, int> size, long rate,
            const std::string& title, const fs::path& output) {
  const auto fail = [&](const std::string& why) {
    throw FileError(fmt::format("cannot draw {}: {}", to.string(), why));
  };
  if (!fs::exists(renderer())) {
    fail(
        "this build has no whirl_render, which needs VTK's rendering; whirl export writes series "
        "for ParaView without it");
  }
  std::vector<std::string> words{renderer().string(),
                                 series.string(),
                                 to.string(),
                                 fmt::format("{}", size.first),
                                 fmt::format("{}", size.second),
                                 fmt::format("{}", rate),
                                 title};
  const char* display = std::getenv("DISPLAY");
  if (!display || *display == '\0') {
    words.insert(words.begin(), {"xvfb-run", "-a", "-s",
                                 fmt::format("-screen 0 {}x{}x24", size.first, size.second)});
  }
  const std::optional<int> status = run_program(words, output);
  if (!status) {
    fail("there is no display, and no xvfb-run (Debian packages xvfb and xauth) to do without");
  }
  if (*status != 0) {
    fail(fmt::format("VTK could not draw on {} (status {}): {}",
                     display && *display ? fmt::format("the display {}", display) : "Xvfb", *status,
                     last_words(output)));
  }
}

/// Makes a film .gif, played in a loop, of pictures NAME_0001.png, ...; VTK does not write it.
void make_gif(const fs::path& name, const fs::path& to, long rate, const fs::path& output) {
  const fs::path stem = fs::path(name).replace_extension("");
  std::vector<std::string> pictures;
  for (const auto& entry : fs::directory_iterator(name.parent_path())) {
    if (entry.path().extension() == ".png") pictures.push_back(entry.path().string());
  }
  std::sort(pictures.begin(), pictures.end());
  const std::vector<std::string> with_ffmpeg{
      "ffmpeg",
      "-y",
      "-framerate",
      fmt::format("{}", rate),
      "-i",
      stem.string() + "_%04d.png",
      "-filter_complex",
      "split[a][b];[a]palettegen=stats_mode=full[colors];[b][colors]paletteuse",
      to.string()};
  std::vector<std::string> with_imagemagick{"convert", "-delay",
                                            fmt::format("{:.3g}", 100.0 / rate), "-loop", "0"};
  with_imagemagick.insert(with_imagemagick.end(), pictures.begin(), pictures.end());
  with_imagemagick.insert(with_imagemagick.end(),
                          {"+dither", "+remap", "-layers", "OptimizeFrame", to.string()});
  bool is_there = false;
  for (const auto& words : {with_ffmpeg, with_imagemagick}) {
    const std::optional<int> status = run_program(words, output);
    if (status == 0 && fs::exists(to)) return;
    is_there = is_there || status.has_value();
  }
  throw FileError(
      is_there ? fmt::format("cannot make {}: {}", to.filename().string(), last_words(output))
               : "a .gif is made with ffmpeg or convert (Debian packages ffmpeg and "
                 "imagemagick), and neither is there; .ogv and .png need none of them");
}

Report run_animate(const Invocation& call) {
  const SceneSource source = scene_source(call);
  const fs::path out = call.text_or("out", fs::path(call.file).replace_extension(".ogv").string());
  const std::string ending = out.extension();
  if (ending != ".ogv" && ending != ".gif" && ending != ".png") {
    throw wrong("--out " + out.string(), "expected a film .ogv or .gif, or pictures .png");
  }
  FileReplacement{out, call.picture_replaces()};  // a wrong place is said before the work
  const auto size = size_of(call.text("size"));
  const long number = call.integer_or("mode", 0);
  std::vector<VtkFrame> frames;
  std::string title, shown;
  if (number == 0 && source.has_motion()) {
    const MotionSamples samples = source.samples(window_of(call), 4.0);
    frames = source.motion(samples, call.integer_or("frames", 120));
    title = source.model.title.empty() ? samples.text : source.model.title;
    shown = ", " + samples.text;
  } else {
    if (window_of(call).is_given()) {
      throw wrong("--revolutions, --from-revolution, --times",
                  "are of motions, and this is a mode");
    }
    const long wanted = std::max(1L, number);
    source.each_mode(wanted, static_cast<int>(call.integer_or("frames", 60)),
                     [&](int n, const Mode& mode, const std::vector<VtkFrame>& cycle) {
                       if (n != wanted) return;
                       frames = cycle;
                       title = told(n, mode);
                     });
    if (frames.empty()) throw wrong("--mode " + call.text_or("mode", "1"), "there is no such mode");
  }

  const Folder folder(out);
  const fs::path series = folder.path / "series.pvd";
  write_vtk_series(series, source.scene, frames);
  const long rate = call.integer("rate");
  const fs::path drawn = folder.path / (ending == ".gif" ? "film.png" : "film" + ending);
  render(series, drawn, size, rate, title, folder.path / "output.txt");
  if (ending == ".gif") make_gif(drawn, folder.path / "film.gif", rate, folder.path / "output.txt");

  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.path)) {
    const std::string name = entry.path().filename();
    if (entry.path().extension() != ending || name.rfind("film", 0) != 0) continue;
    const fs::path place = fs::path(out).replace_filename(out.stem().string() + name.substr(4));
    FileReplacement file(place, call.picture_replaces());
    fs::copy_file(entry.path(), file.temporary());
    mark_as_own(file.temporary());
    file.commit();
    files.push_back(place);
  }
  if (files.empty()) throw FileError("cannot draw " + out.string() + ": VTK drew nothing");
  std::sort(files.begin(), files.end());
  Report report{.record = begin_record(call, source.model)};
  Record list = Record::array();
  for (const fs::path& f : files) list.add(f.string());
  report.record.set("files", list);
  report.record.set("frames", static_cast<int>(frames.size()));
  report.text =
      fmt::format("  {}: {} frames{}, {}\n", files.front().string(), frames.size(), shown, title);
  return report;
}

}  // namespace

Verb animate_verb() {
  return {
      .name = "animate",
      .group = "Results",
      .summary = "a film of a motion or of a mode",
      .takes = "FILE",
      .example = "whirl animate run.h5 --out run.ogv",
      .options = {{"out", "FILE",
                   "film .ogv or .gif, or pictures .png, numbered; left out: .ogv beside FILE"},
                  {"mode", "N", "this mode; left out: the motion of a result, of others mode 1"},
                  from_revolution_option,
                  {"revolutions", "N",
                   "revolutions of a motion, given alone: the last ones; left out: 4"},
                  times_option,
                  {"frames", "N",
                   "pictures; left out: of a motion at most 120, of a mode's cycle 60"},
                  {"size", "WxH", "pixels", "960x540"},
                  {"rate", "N", "pictures per second of a film", "25"}},
      .run = run_animate,
  };
}

}  // namespace whirl::inline cli

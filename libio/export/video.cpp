#include "libio/export/video.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/system/program.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/results/temporary_folder.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline io {

namespace {

namespace fs = std::filesystem;

/// Where an animation is put together.
struct Folder : TemporaryFolder {
  explicit Folder(const fs::path& beside) : TemporaryFolder("animate", beside) {}

  fs::path output() const { return path() / "output.txt"; }  ///< of the programs that draw
  /// Files of an ending, in the order of their names.
  std::vector<fs::path> files(const std::string& ending) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(path())) {
      if (entry.path().extension() == ending) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
};

/// The program that draws, beside this one.
fs::path renderer() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).replace_filename("whirl_render");
}

/// Lets the renderer draw a series, on a display of its own where there is none.
void render(const fs::path& series, const fs::path& to, const VideoOptions& options,
            const fs::path& output) {
  const auto fail = [&](const std::string& why) {
    throw FileError(fmt::format("cannot draw {}: {}", options.place.string(), why));
  };
  if (!fs::exists(renderer())) {
    fail(
        "this build has no whirl_render, which needs VTK's rendering; whirl export writes series "
        "for ParaView without it");
  }
  const auto [width, height] = options.size;
  std::vector<std::string> words{renderer().string(),
                                 series.string(),
                                 to.string(),
                                 fmt::format("{}", width),
                                 fmt::format("{}", height),
                                 fmt::format("{}", options.rate),
                                 options.title};
  const char* display = std::getenv("DISPLAY");
  const bool has_display = display && *display != '\0';
  if (!has_display) {
    words.insert(words.begin(),
                 {"xvfb-run", "-a", "-s", fmt::format("-screen 0 {}x{}x24", width, height)});
  }
  const std::optional<int> status = run_program(words, output);
  if (!status) {
    fail("there is no display, and no xvfb-run (Debian packages xvfb and xauth) to do without");
  }
  if (*status != 0) {
    fail(fmt::format("VTK could not draw on {} (status {}): {}",
                     has_display ? fmt::format("the display {}", display) : "Xvfb", *status,
                     last_words(output)));
  }
}

/// Makes a video .gif, played in a loop, of the pictures video_0001.png, ...; VTK does not write
/// it.
void make_gif(const Folder& folder, long rate) {
  const std::string to = folder.path() / "video.gif";
  const std::vector<std::string> with_ffmpeg{
      "ffmpeg",
      "-y",
      "-framerate",
      fmt::format("{}", rate),
      "-i",
      (folder.path() / "video_%04d.png").string(),
      "-filter_complex",
      "split[a][b];[a]palettegen=stats_mode=full[colors];[b][colors]paletteuse",
      to};
  std::vector<std::string> with_imagemagick{
      "convert", "-delay", fmt::format("{:.3g}", 100.0 / static_cast<double>(rate)), "-loop", "0"};
  for (const fs::path& picture : folder.files(".png")) with_imagemagick.push_back(picture.string());
  with_imagemagick.insert(with_imagemagick.end(),
                          {"+dither", "+remap", "-layers", "OptimizeFrame", to});
  bool is_there = false;
  for (const auto& words : {with_ffmpeg, with_imagemagick}) {
    const std::optional<int> status = run_program(words, folder.output());
    if (status == 0 && fs::exists(to)) return;
    is_there = is_there || status.has_value();
  }
  throw FileError(is_there ? fmt::format("cannot make a .gif: {}", last_words(folder.output()))
                           : "a .gif is made with ffmpeg or convert (Debian packages ffmpeg and "
                             "imagemagick), and neither is there; .ogv and .png need none of them");
}

}  // namespace

Parsed<PixelSize> parse_pixels(std::string_view text) {
  constexpr int least = 64, most = 8192;
  const auto fits = [](int pixels) { return pixels >= least && pixels <= most; };
  PixelSize size;
  const char* const end = text.data() + text.size();
  const auto [at, first] = std::from_chars(text.data(), end, size.width);
  if (first == std::errc{} && at != end && *at == 'x') {
    const auto [last, second] = std::from_chars(at + 1, end, size.height);
    const bool is_read = second == std::errc{} && last == end;
    if (is_read && fits(size.width) && fits(size.height)) return size;
  }
  return Parsed<PixelSize>::failed(
      fmt::format("expected WIDTHxHEIGHT of {} to {} pixels, such as 960x540", least, most));
}

void require_video_place(const VideoOptions& options) {
  const std::string ending = options.place.extension();
  if (ending != ".ogv" && ending != ".gif" && ending != ".png") {
    throw wrong_option("out", options.place.string(),
                       "expected a video .ogv or .gif, or pictures .png");
  }
  FileReplacement{options.place, options.replaces};
}

std::vector<fs::path> write_video(const VtkScene& scene, const std::vector<VtkFrame>& frames,
                                  const VideoOptions& options) {
  require_video_place(options);
  const std::string ending = options.place.extension();
  const Folder folder(options.place);
  const fs::path series = folder.path() / "series.pvd";
  write_vtk_series(series, scene, frames);
  VideoOptions titled = options;
  if (!symbols_told(scene).empty()) {
    titled.title = "Broken plates: symbols of disks whose size is not given\n" + options.title;
  }
  render(series, folder.path() / (ending == ".gif" ? "video.png" : "video" + ending), titled,
         folder.output());
  if (ending == ".gif") make_gif(folder, options.rate);
  std::vector<fs::path> places;
  for (const fs::path& drawn : folder.files(ending)) {
    // "video_0001.png" is that of "NAME.png"
    const std::string name = drawn.filename().string().substr(std::string("video").size());
    places.push_back(
        fs::path(options.place).replace_filename(options.place.stem().string() + name));
    FileReplacement file(places.back(), options.replaces);
    std::error_code problem;
    fs::copy_file(drawn, file.temporary(), fs::copy_options::overwrite_existing, problem);
    if (problem) {
      throw FileError(
          fmt::format("cannot write {}: {}", places.back().string(), problem.message()));
    }
    mark_as_own(file.temporary());
    file.commit();
  }
  if (places.empty()) {
    throw FileError("cannot draw " + options.place.string() + ": VTK drew nothing");
  }
  return places;
}

}  // namespace whirl::inline io

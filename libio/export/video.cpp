#include "libio/export/video.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
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

/// How many pictures the renderer has told to be drawn, a dot each.
long drawn_so_far(const fs::path& output) {
  std::ifstream file(output);
  return std::count(std::istreambuf_iterator<char>(file), {}, '.');
}

/// Lets the renderer draw a series, on a display of its own where there is none.
void render(const fs::path& series, const fs::path& to, const VideoOptions& options,
            const fs::path& output, long frames) {
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
  const auto tell = [&] { options.progress(drawn_so_far(output), frames); };
  const std::optional<int> status =
      options.progress ? run_program(words, output, tell) : run_program(words, output);
  if (!status) {
    fail("there is no display, and no xvfb-run (Debian packages xvfb and xauth) to do without");
  }
  if (*status != 0) {
    fail(fmt::format("VTK could not draw on {} (status {}): {}",
                     has_display ? fmt::format("the display {}", display) : "Xvfb", *status,
                     last_words(output)));
  }
}

/// The call that makes a video of the pictures video_0001.png, ...
std::vector<std::string> maker(const Folder& folder, const std::string& ending, long rate,
                               bool has_ffmpeg) {
  const std::string to = (folder.path() / "video").string() + ending;
  if (!has_ffmpeg) {  // a .gif; one palette for all pictures would take ten times as long
    std::vector<std::string> words{"convert", "-delay",
                                   fmt::format("{:.3g}", 100.0 / static_cast<double>(rate)),
                                   "-loop", "0"};
    for (const fs::path& picture : folder.files(".png")) words.push_back(picture.string());
    words.insert(words.end(), {"+dither", "-colors", "64", to});
    return words;
  }
  std::vector<std::string> words{"ffmpeg",     "-y",
                                 "-loglevel",  "error",
                                 "-framerate", fmt::format("{}", rate),
                                 "-i",         (folder.path() / "video_%04d.png").string()};
  if (ending == ".gif") {
    words.insert(words.end(),
                 {"-filter_complex",
                  "split[a][b];[a]palettegen=stats_mode=full[colors];[b][colors]paletteuse"});
  } else {  // what players and slides take: even sides, colors halved
    words.insert(words.end(), {"-vf", "scale=trunc(iw/2)*2:trunc(ih/2)*2", "-c:v", "libx264",
                               "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart"});
  }
  words.push_back(to);
  return words;
}

/// Makes a video .gif, played in a loop, or .mp4 of the pictures; VTK writes neither.
void make_video(const Folder& folder, const std::string& ending, long rate) {
  const std::vector<std::string> words =
      maker(folder, ending, rate, program_named("ffmpeg").has_value());
  if (run_program(words, folder.output()) == 0) return;
  throw FileError(
      fmt::format("cannot make a {}: {}: {}", ending, words.front(), last_words(folder.output())));
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
  if (ending != ".mp4" && ending != ".gif" && ending != ".ogv" && ending != ".png") {
    throw wrong_option("out", options.place.string(),
                       "expected a video .mp4, .gif or .ogv, or pictures .png");
  }
  FileReplacement{options.place, options.replaces};
  const bool needs_ffmpeg = ending == ".mp4" || (ending == ".gif" && !program_named("convert"));
  if (needs_ffmpeg && !program_named("ffmpeg")) {
    throw FileError(fmt::format(
        "cannot write {}: a {} is made with ffmpeg{}, which is not there; .ogv and .png need none",
        options.place.string(), ending,
        ending == ".gif" ? " or ImageMagick (Debian packages ffmpeg, imagemagick)"
                         : " (Debian package ffmpeg)"));
  }
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
    titled.title = "Broken plates, not to scale: disks whose size is not given\n" + options.title;
  }
  const bool is_made_of_pictures = ending == ".gif" || ending == ".mp4";
  render(series, folder.path() / (is_made_of_pictures ? "video.png" : "video" + ending), titled,
         folder.output(), std::ssize(frames));
  if (is_made_of_pictures) make_video(folder, ending, options.rate);
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

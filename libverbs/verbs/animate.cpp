#include <fmt/format.h>

#include "libio/export/clip.hpp"
#include "libio/export/video.hpp"
#include "libverbs/command/invocation.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/result_input.hpp"

namespace whirl::inline cli {

namespace {

struct AnimateVerbOptions {
  Option<std::string> out = output_option(
      "out", "FILE",
      "video .mp4, .gif or .ogv, or pictures .png, numbered; left out: .ogv beside FILE");
  Option<long> mode{"mode", "N", "this mode; left out: the motion of a result, of others mode 1",
                    mode_range};
  WindowVerbOptions window{
      .revolutions = {"revolutions", "N",
                      "revolutions of a motion, given alone: the last ones; left out: 4",
                      revolution_range}};
  Option<long> frames{"frames", "N",
                      "pictures; left out: of a motion at most 120, of a mode's cycle 60",
                      Whole{1, 100'000}};
  Option<std::string> size{"size", "WxH", "pixels", "960x540"};
  Option<long> rate{"rate", "N", "pictures per second of a video", 25, Whole{1, 1000}};
  auto fields() { return std::tie(out, mode, window, frames, size, rate); }
};

Report run_animate(const Invocation& call, const AnimateVerbOptions& options) {
  const SceneSource source = scene_source(call);
  const std::filesystem::path beside = std::filesystem::path(call.file).replace_extension(".ogv");
  VideoOptions video{.place = options.out.value_or(beside.string()),
                     .size = parsed_option("size", *options.size, parse_pixels),
                     .rate = *options.rate,
                     .replaces = call.picture_replaces()};
  require_video_place(video);
  const Clip clip = clip_of(source, {.mode = options.mode.value,
                                     .window = window_of(options.window),
                                     .frames = options.frames.value});
  video.title = clip.title;
  const auto files = [&] {
    video.progress = progress_of(call, fmt::format("drawing {} pictures", clip.frames.size()));
    const auto written = write_video(source.scene, clip.frames, video);
    video.progress = {};  // the line is gone before the report
    return written;
  }();

  Report report = begin_report(call, source.model);
  report.record.set("files", file_list(files));
  report.record.set("frames", static_cast<int>(clip.frames.size()));
  report.text = fmt::format("  {}: {} frames{}, {}\n", files.front().string(), clip.frames.size(),
                            clip.shown.empty() ? "" : ", " + clip.shown, clip.title);
  return report;
}

}  // namespace

Verb animate_verb() {
  return {
      .name = "animate",
      .alias = "video",
      .group = "Results",
      .summary = "a video of a motion or of a mode",
      .takes = "FILE",
      .example = "whirl animate run.h5 --out run.gif",
      .run = run_animate,
  };
}

}  // namespace whirl::inline cli

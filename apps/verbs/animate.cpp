#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/result_input.hpp"
#include "libio/export/clip.hpp"
#include "libio/export/video.hpp"

namespace whirl::inline cli {

namespace {

Report run_animate(const Invocation& call) {
  const SceneSource source = scene_source(call);
  const std::filesystem::path beside = std::filesystem::path(call.file).replace_extension(".ogv");
  VideoOptions video{.place = call.text_or("out", beside.string()),
                     .size = call.parsed("size", parse_pixels),
                     .rate = call.integer("rate"),
                     .replaces = call.picture_replaces()};
  require_video_place(video);
  const Clip clip = clip_of(source, {.mode = number_given(call, "mode"),
                                     .window = window_of(call),
                                     .frames = number_given(call, "frames")});
  video.title = clip.title;
  const auto files = write_video(source.scene, clip.frames, video);

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
      .example = "whirl animate run.h5 --out run.ogv",
      .options = {{"out", "FILE",
                   "video .ogv or .gif, or pictures .png, numbered; left out: .ogv beside FILE"},
                  {"mode", "N", "this mode; left out: the motion of a result, of others mode 1"},
                  from_revolution_option,
                  {"revolutions", "N",
                   "revolutions of a motion, given alone: the last ones; left out: 4"},
                  times_option,
                  {"frames", "N",
                   "pictures; left out: of a motion at most 120, of a mode's cycle 60"},
                  {"size", "WxH", "pixels", "960x540"},
                  {"rate", "N", "pictures per second of a video", "25"}},
      .run = run_animate,
  };
}

}  // namespace whirl::inline cli

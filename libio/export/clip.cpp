#include "libio/export/clip.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline io {

namespace {

constexpr double usual_revolutions = 4.0;
constexpr long motion_frames = 120, cycle_frames = 60;

Clip clip_of_motion(const SceneSource& source, const ClipOptions& options) {
  const MotionSamples samples = source.samples(options.window, usual_revolutions);
  const std::string& title = source.model.title;
  return {source.motion(samples, options.frames.value_or(motion_frames)),
          title.empty() ? samples.text : title, samples.text};
}

Clip clip_of_mode(const SceneSource& source, long wanted, long frames) {
  Clip clip;
  source.each_mode(wanted, static_cast<int>(frames),
                   [&](int number, const Mode& mode, const std::vector<VtkFrame>& cycle) {
                     if (number == wanted) clip = {cycle, told(number, mode), ""};
                   });
  if (!clip.frames.empty()) return clip;
  throw wrong_option("mode", std::to_string(wanted), "there is no such mode");
}

}  // namespace

Clip clip_of(const SceneSource& source, const ClipOptions& options) {
  if (!options.mode && source.has_motion()) return clip_of_motion(source, options);
  if (options.window.is_given()) {
    throw wrong_window("are of motions, and this is a mode");
  }
  return clip_of_mode(source, options.mode.value_or(1), options.frames.value_or(cycle_frames));
}

}  // namespace whirl::inline io

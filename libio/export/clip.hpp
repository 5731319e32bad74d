#pragma once
/// What a video shows: a stretch of a motion, or a cycle of a mode.

#include <optional>
#include <string>
#include <vector>

#include "libio/export/scene_source.hpp"

namespace whirl::inline io {

struct ClipOptions {
  std::optional<long> mode{};    ///< its number from 1; left out: the motion, or mode 1 if none
  MotionWindow window{};         ///< of a motion; left open: its last four revolutions
  std::optional<long> frames{};  ///< left out: of a motion at most 120, of a mode 60
};

struct Clip {
  std::vector<VtkFrame> frames;
  std::string title;
  std::string shown;  ///< "revolutions 116 to 120 of 120, 1.57 to 1.63 s"; empty of a mode
};

/// The frames of a motion or mode.
/// @throws ModelError  if there is no such mode, and for a window of a mode
Clip clip_of(const SceneSource& source, const ClipOptions& options);

}  // namespace whirl::inline io

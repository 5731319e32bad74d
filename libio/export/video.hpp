#pragma once
/// Videos of a scene, drawn by whirl_render, a program of its own that has VTK's rendering.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "libio/export/vtk.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Width and height [pixels].
struct PixelSize {
  int width = 960, height = 540;
};
/// Reads a size such as 960x540.
Parsed<PixelSize> parse_pixels(std::string_view text);

struct VideoOptions {
  std::filesystem::path place;  ///< .mp4, .gif or .ogv, or .png: a picture per frame, numbered
  PixelSize size{};
  long rate = 25;       ///< frames per second
  std::string title{};  ///< in the picture
  Replaces replaces = Replaces::own_pictures;
  std::function<void(long done, long total)> progress{};  ///< frames that are drawn
};

/// Checks, before the work, that a video can be made and put at its place.
/// @throws ModelError  for another ending
/// @throws FileError   as FileReplacement; if a program that makes it is missing, naming its
/// package
void require_video_place(const VideoOptions& options);

/// Draws a video, on a display of its own where there is none; its files are replaced one by one,
/// each as a whole.
/// @return  the files, in the order of their names
/// @throws FileError  if the video cannot be drawn or written; names a program that is missing
std::vector<std::filesystem::path> write_video(const VtkScene& scene,
                                               const std::vector<VtkFrame>& frames,
                                               const VideoOptions& options);

}  // namespace whirl::inline io

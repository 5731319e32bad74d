// A model to other programs, and as frames of a video.

#include "libio/export/scene_export.hpp"

#include <gtest/gtest.h>

#include "libbase/error.hpp"
#include "libio/export/clip.hpp"
#include "libio/export/video.hpp"
#include "tests/io/result_folder.hpp"
#include "tests/io/shaft_model.hpp"

namespace whirl::test {
namespace scene_export_test {

constexpr const char* bearings = R"([[bearing]]
at = 0
stiffness = "1 MN/m"
[[bearing]]
at = 0.6
stiffness = "1 MN/m"
)";

template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "none";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ExportFormats, AreOursAndThoseOfMeshio) {
  EXPECT_EQ(export_format("vtk").ending, ".pvd");
  EXPECT_EQ(export_format("vtk").mesh, nullptr);
  EXPECT_EQ(export_format("abaqus").ending, ".inp");
  ASSERT_NE(export_format("abaqus").mesh, nullptr);
  EXPECT_TRUE(says(refusal([] { export_format("abacus"); }),
                   "unknown format, did you mean \"abaqus\"?; there are vtk, xdmf, csv, uff, mtx, "
                   "mat, abaqus,"));
}

using SceneExport = InResultFolder;

// An ending that this program knows is none of the name, any other point is.
TEST_F(SceneExport, WritesModesBesideTheNameWithoutItsEnding) {
  const SceneSource source(rotor(bearings));
  const ExportOptions options{
      .format = export_format("vtu"), .stem = folder / "a.b.toml", .modes = 2};
  const Exported written = export_scene(source, options);
  EXPECT_EQ(written.files, std::vector<std::filesystem::path>{folder / "a.b.vtu"});
  EXPECT_TRUE(says(written.text, "12 lines and 13 points"));
  EXPECT_TRUE(says(written.text, "mode2_90deg: mode 2 at "));
  EXPECT_EQ(files(), 1u);
}

TEST_F(SceneExport, RefusesWhatAModelDoesNotHold) {
  const SceneSource source(rotor(bearings));
  const auto with = [&](const char* format, const MotionWindow& window) {
    return refusal([&] {
      export_scene(source,
                   {.format = export_format(format), .stem = folder / "a", .window = window});
    });
  };
  EXPECT_TRUE(says(with("csv", {}), "a model holds no tables"));
  EXPECT_TRUE(says(with("vtk", {.revolutions = 2.0}), "this file holds none"));
  EXPECT_EQ(files(), 0u);
}

// Frames are at equal phases of the cycle: after half of it each point is on the other side.
TEST(Clips, OfAModelAreCyclesOfAMode) {
  const SceneSource source(rotor(bearings));
  const Clip clip = clip_of(source, {.frames = 8});
  ASSERT_EQ(clip.frames.size(), 8u);
  const Mat &first = clip.frames[0].motion, &opposite = clip.frames[4].motion;
  constexpr double rounding = 1e-12;
  EXPECT_GT(first.norm(), 0.0);
  EXPECT_LT((first + opposite).norm(), rounding * first.norm());
  EXPECT_TRUE(clip.title.starts_with("mode 1 at ")) << clip.title;
  EXPECT_EQ(clip_of(source, {.mode = 2}).frames.size(), 60u);
  EXPECT_TRUE(says(refusal([&] { clip_of(source, {.mode = 4711}); }), "there is no such mode"));
  EXPECT_TRUE(
      says(refusal([&] { clip_of(source, {.window = {.revolutions = 2.0}}); }), "this is a mode"));
}

TEST(Videos, HaveASizeInPixels) {
  EXPECT_EQ(parse_pixels("320x240")->width, 320);
  EXPECT_EQ(parse_pixels("320x240")->height, 240);
  for (const char* text : {"", "big", "1x1", "320", "320x", "320x240x", "320X240", "-320x240"}) {
    EXPECT_TRUE(says(parse_pixels(text).problem, "expected WIDTHxHEIGHT")) << text;
  }
}

using VideoPlace = InResultFolder;

TEST_F(VideoPlace, IsCheckedBeforeTheWork) {
  EXPECT_TRUE(says(refusal([&] { require_video_place({.place = folder / "m.avi"}); }),
                   "expected a video .mp4, .gif or .ogv, or pictures .png"));
  EXPECT_TRUE(says(problem_of([&] { require_video_place({.place = folder / "no" / "m.ogv"}); }),
                   "there is no directory"));
  require_video_place({.place = folder / "m.ogv"});
  EXPECT_EQ(files(), 0u);
}

}  // namespace scene_export_test
}  // namespace whirl::test

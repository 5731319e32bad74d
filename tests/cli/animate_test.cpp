// animate: videos and pictures, drawn without a screen.

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace animate_test {

const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";

class Animate : public Program {
 protected:
  /// Runs whirl as if there were no display.
  Outcome without_display(const std::string& words, const std::string& before = "") const {
    return wait(
        start("sh", {"-c", "unset DISPLAY; " + before + " " + WHIRL_PROGRAM + " " + words}));
  }
};

// A video is in the format that its name says and has many pictures; pictures have the size asked
// for, and a rotor that moves: each differs from the one before.
TEST_F(Animate, DrawsVideosAndPicturesWithoutAScreen) {
  if (!can_animate()) GTEST_SKIP() << "needs VTK's rendering and xvfb-run (xvfb, xauth)";
  const Outcome video = without_display("animate " + disks +
                                        " --out m.ogv --mode 2 --frames 6 "
                                        "--size 320x240");
  ASSERT_EQ(video.status, 0) << video.err;
  EXPECT_TRUE(has(video.out, "m.ogv: 6 frames, mode 2 at ")) << video.out;
  EXPECT_EQ(content(folder / "m.ogv").substr(0, 4), "OggS");

  ASSERT_EQ(whirl({"simulate", disks, "--revolutions", "4", "--discard", "1", "--out", "run.h5",
                   "--quiet"})
                .status,
            0);
  const Outcome pictures =
      without_display("animate run.h5 --out p.png --frames 3 --size 320x240 --json -");
  ASSERT_EQ(pictures.status, 0) << pictures.err;
  EXPECT_EQ(pictures.tree()["files"], (json::array({"p_0001.png", "p_0002.png", "p_0003.png"})));
  EXPECT_EQ(pictures.tree()["frames"], 3);
  const std::string first = content(folder / "p_0001.png");
  EXPECT_EQ(first.substr(1, 3), "PNG");
  EXPECT_EQ(first.substr(16, 8), std::string("\0\0\1\100\0\0\0\360", 8));  // 320 x 240
  EXPECT_NE(first, content(folder / "p_0002.png"));
  EXPECT_EQ(files(), (std::vector<std::string>{"m.ogv", "p_0001.png", "p_0002.png", "p_0003.png",
                                               "run.h5"}));
}

// Blocks of a GIF: a screen of the size asked for, a picture per frame, played for ever, each for
// 1 / rate.
TEST_F(Animate, DrawsGifs) {
  if (!can_animate()) GTEST_SKIP() << "needs VTK's rendering and xvfb-run (xvfb, xauth)";
  const Outcome video = without_display(
      "animate " + disks + " --out m.gif --mode 1 --frames 5 --size 320x240 --rate 20");
  if (video.status == 2 && has(video.err, "which is not there")) {
    GTEST_SKIP() << "needs ffmpeg or imagemagick";
  }
  ASSERT_EQ(video.status, 0) << video.err;
  EXPECT_EQ(files(), std::vector<std::string>{"m.gif"});
  const std::string gif = content(folder / "m.gif");
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(gif.at(at)); };
  const auto word = [&](std::size_t at) { return byte(at) + 256 * byte(at + 1); };
  const auto colors = [&](std::size_t flags) {
    return (byte(flags) & 0x80) != 0 ? std::size_t{3} << ((byte(flags) & 7) + 1) : 0;
  };
  EXPECT_EQ(gif.substr(0, 6), "GIF89a");
  EXPECT_EQ(word(6), 320);
  EXPECT_EQ(word(8), 240);
  int pictures = 0, centiseconds = 0;
  bool loops = false;
  for (std::size_t at = 13 + colors(10); byte(at) != 0x3b;) {
    if (byte(at) == 0x21) {  // an extension
      if (byte(at + 1) == 0xf9) centiseconds += word(at + 4);
      loops = loops || gif.substr(at + 3, 11) == "NETSCAPE2.0";
      at += 2;
    } else {
      ASSERT_EQ(byte(at), 0x2c);
      ++pictures;
      at += 10 + colors(at + 9) + 1;
    }
    while (byte(at) != 0) at += byte(at) + 1u;  // its data
    ++at;
  }
  EXPECT_EQ(without_display("animate " + disks + " --out m.gif --frames 2 --size 64x64").status, 0)
      << "an older video is replaced";
  EXPECT_EQ(pictures, 5);
  EXPECT_EQ(centiseconds, 25);
  EXPECT_TRUE(loops);
}

// A file of the MP4 family, by its first box.
TEST_F(Animate, DrawsMp4) {
  if (!can_animate()) GTEST_SKIP() << "needs VTK's rendering and xvfb-run (xvfb, xauth)";
  if (wait(start("sh", {"-c", "command -v ffmpeg"})).status != 0) GTEST_SKIP() << "needs ffmpeg";
  const Outcome video =
      without_display("animate " + disks + " --out m.mp4 --mode 1 --frames 5 --size 321x241");
  ASSERT_EQ(video.status, 0) << video.err;
  EXPECT_EQ(files(), std::vector<std::string>{"m.mp4"});
  EXPECT_EQ(content(folder / "m.mp4").substr(4, 4), "ftyp");
}

// Where there is nothing to draw on it is said, also where VTK ends the process; nothing is
// written.
TEST_F(Animate, TellsWhatIsMissing) {
  const Outcome no_xvfb = without_display("animate " + disks + " --out m.ogv", "PATH=/nowhere");
  EXPECT_EQ(no_xvfb.status, 2);
  EXPECT_TRUE(has(no_xvfb.err, "xvfb") || has(no_xvfb.err, "whirl_render")) << no_xvfb.err;
  const Outcome wrong_display =
      without_display("animate " + disks + " --out m.ogv", "DISPLAY=:4711");
  EXPECT_EQ(wrong_display.status, 2);
  EXPECT_TRUE(has(wrong_display.err, "cannot draw")) << wrong_display.err;
  for (const char* file : {"m.mp4", "m.gif"}) {  // before anything is drawn
    const Outcome no_ffmpeg =
        without_display("animate " + disks + " --out " + file, "PATH=/nowhere");
    EXPECT_EQ(no_ffmpeg.status, 2);
    EXPECT_TRUE(has(no_ffmpeg.err, "Debian package")) << no_ffmpeg.err;
    EXPECT_TRUE(has(no_ffmpeg.err, "ffmpeg")) << no_ffmpeg.err;
  }
  for (const auto& [words, message] : std::vector<std::pair<std::string, std::string>>{
           {"--out m.avi", "expected a video .mp4, .gif or .ogv, or pictures .png"},
           {"--out m.ogv --size big", "expected WIDTHxHEIGHT"},
           {"--out m.ogv --size 1x1", "expected WIDTHxHEIGHT"},
           {"--out m.ogv --mode 4711", "there is no such mode"},
           {"--out nowhere/m.ogv", "there is no directory nowhere"}}) {
    const Outcome outcome = without_display("animate " + disks + " " + words);
    EXPECT_EQ(outcome.status, 2) << words;
    EXPECT_TRUE(has(outcome.err, message)) << outcome.err;
  }
  EXPECT_TRUE(files().empty());
}

}  // namespace animate_test
}  // namespace whirl::test

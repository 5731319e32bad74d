// Files that this program wrote are told from others by what is in them.

#include "libio/results/own_file.hpp"

#include <cstdint>
#include <cstdlib>

#include "libio/drawing/svg.hpp"
#include "libio/model/model_schema.hpp"
#include "libio/text/record.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::own_file_test {

namespace fs = std::filesystem;
using test::content;
using test::write_example;

class OwnFile : public test::InResultFolder {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }
  Origin origin(const std::string& text) const { return origin_of(write("x", text)); }
};

TEST_F(OwnFile, AFileThatIsNotThereOrEmptyBelongsToNobody) {
  EXPECT_EQ(origin_of(folder / "none"), Origin::nowhere);
  EXPECT_EQ(origin(""), Origin::nowhere);
  EXPECT_EQ(origin_of("/dev/null"), Origin::nowhere);
  EXPECT_EQ(origin_of(folder), Origin::nowhere);
}

TEST_F(OwnFile, ResultsAreKnownByTheirVersion) {
  write_example(path);
  EXPECT_EQ(origin_of(path), Origin::result);
  {
    ResultWriter other(folder / "other.h5");  // as any HDF5 program writes it
    other.dataset("/points", Vec(Vec::Ones(3)), {"", "points", {}});
    other.commit();
  }
  EXPECT_EQ(origin_of(folder / "other.h5"), Origin::foreign);
  EXPECT_EQ(origin(content(path).substr(0, 600)), Origin::foreign);  // damaged
}

TEST_F(OwnFile, TextsAreKnownByTheirMark) {
  EXPECT_EQ(origin(Svg(10.0, 10.0, "a title").document()), Origin::picture);
  EXPECT_EQ(origin(model_schema().json()), Origin::picture);
  Record answer;
  answer.set("model", "m.toml").set("list", Record::array()).set(json_mark_key, json_mark);
  EXPECT_EQ(origin(answer.json()), Origin::picture);
}

// The first lines of files that version 0.1.0 wrote before there were marks.
TEST_F(OwnFile, FilesOfEarlyVersionsAreKnownToo) {
  const std::string svg = Svg(10.0, 10.0, "a title").document();
  const auto mark = svg.find(xml_mark);
  std::string early = svg;
  early.erase(mark, xml_mark.size() + 1);
  EXPECT_EQ(origin(early), Origin::picture);
  EXPECT_EQ(
      origin(
          "{\n  \"model\": \"a \\\"b\\\".toml\",\n  \"version\": \"0.1.0\",\n  \"files\": []\n}\n"),
      Origin::picture);
  EXPECT_EQ(origin("{\"model\": \"m.toml\", \"version\": \"0.1.0\", \"speed_rpm\": 0}\n"),
            Origin::picture);
}

TEST_F(OwnFile, WhatOthersWroteIsForeign) {
  for (const char* text :
       {"format = 1\n", "x,y\n1,2\n", "{\"model\": \"T\", \"name\": \"x\", \"version\": \"0.1.0\"}",
        "{\"model\": \"T\", \"version\": \"2.0\"}", "{}", "<?xml version=\"1.0\"?>\n<svg/>",
        "<!DOCTYPE html>\n<html><head></head></html>", "\x89PNG\r\n\x1a\n", "%PDF-1.7\n%%EOF\n",
        "GIF89a;", "OggS", "\x89HDF"}) {
    EXPECT_EQ(origin(text), Origin::foreign) << text;
  }
}

// The smallest PNG that there is, a pixel. Its mark leaves the chunks whole: lengths lead from one
// to the next, and every check sum is right, by the algorithm of ISO/IEC 15948, annex D.
TEST_F(OwnFile, PngsAreMarkedByATextChunk) {
  const std::string chunks =
      std::string("\x89PNG\r\n\x1a\n", 8) +
      std::string("\0\0\0\rIHDR\0\0\0\1\0\0\0\1\10\0\0\0\0\x3a\x7e\x9b\x55", 25) +
      std::string("\0\0\0\nIDAT\x78\x9c\x63\x60\0\0\0\2\0\1\x48\xaf\xa4\x71", 22) +
      std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  const fs::path png = write("x.png", chunks);
  EXPECT_EQ(origin_of(png), Origin::foreign);
  mark_as_own(png);
  EXPECT_EQ(origin_of(png), Origin::picture);
  const std::string marked = content(png);
  std::vector<std::string> names;
  for (std::size_t at = 8; at < marked.size();) {
    const auto number = [&](std::size_t place) {
      std::uint32_t n = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        n = n << 8u | static_cast<unsigned char>(marked.at(place + i));
      }
      return n;
    };
    const std::size_t length = number(at);
    std::uint32_t sum = 0xffffffffu;
    for (std::size_t i = at + 4; i < at + 8 + length; ++i) {
      sum ^= static_cast<unsigned char>(marked.at(i));
      for (int k = 0; k < 8; ++k) sum = (sum & 1u) != 0 ? 0xedb88320u ^ (sum >> 1u) : sum >> 1u;
    }
    names.push_back(marked.substr(at + 4, 4));
    if (names.back() != "IDAT") {  // of the example's only the others' sums are known by heart
      EXPECT_EQ(number(at + 8 + length), sum ^ 0xffffffffu) << names.back();
    }
    at += 12 + length;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"IHDR", "IDAT", "tEXt", "IEND"}));
}

// A comment extension before the trailer; a comment line before the last line of a PDF.
TEST_F(OwnFile, GifsAndPdfsAreMarkedByComments) {
  const fs::path gif = write("x.gif", "GIF89a....;");
  mark_as_own(gif);
  EXPECT_EQ(content(gif), std::string("GIF89a....\x21\xfe\x05whirl\0;", 20));
  EXPECT_EQ(origin_of(gif), Origin::picture);
  const fs::path pdf = write("x.pdf", "%PDF-1.5\n...\nstartxref\n12\n%%EOF\n");
  mark_as_own(pdf);
  EXPECT_EQ(content(pdf), "%PDF-1.5\n...\nstartxref\n12\n% written by whirl\n%%EOF\n");
  EXPECT_EQ(origin_of(pdf), Origin::picture);
}

}  // namespace whirl::own_file_test

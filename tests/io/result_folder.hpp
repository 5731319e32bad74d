#pragma once
// A folder for result files, and a file with one of everything.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "libio/results/hdf5.hpp"

namespace whirl::test {

class InResultFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
  }

  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("whirl_hdf5_test_" + std::to_string(::getpid()));
  const std::filesystem::path path = folder / "result.h5";
};

inline std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

template <class Action>
std::string problem_of(Action action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

/// A file with one of everything.
inline void write_example(const std::filesystem::path& path) {
  ResultWriter out(path, Replaces::anything);
  out.attribute("/", "whirl_version", "0.1.0");
  out.attribute("/model", "text", "title = \"Läufer\"\n");
  out.attribute("/model", "speed", 382.25);
  out.attribute("/model", "modes", 8);
  out.dataset("/trajectory/t", Vec(Vec::LinSpaced(4, 0.0, 3.0)), {"s", "time", {}});
  out.dataset("/trajectory/station", std::vector<std::string>{"seal", "Gehäuse", ""},
              {"", "station", {}});
  Mat x(4, 3);
  x << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
  out.dataset("/trajectory/x", x,
              {"m", "displacement in x", {"/trajectory/t", "/trajectory/station"}});
  CMat shape(2, 3);
  shape << Complex(1, -1), Complex(2, -2), 3, 4, 5, Complex(0, 6);
  out.dataset("/modes/shape", shape, {"m", "mode shape", {"", "/trajectory/station"}});
  out.dataset("/modes/eigenvalue", CVec(shape.col(0)), {"rad/s", "eigenvalue", {}});
  out.dataset("/modes/number", std::vector<int>{1, 2, -3}, {"", "number", {}});
  out.dataset("/modes/ratio", std::vector<double>{0.5, 1e-300}, {"", "damping ratio", {}});
  out.commit();
}

}  // namespace whirl::test

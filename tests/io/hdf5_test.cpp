// Result files: what is written is read back.

#include "libio/results/hdf5.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <thread>

#include "tests/io/result_folder.hpp"

namespace whirl::hdf5_test {

namespace fs = std::filesystem;
using test::content, test::problem_of, test::write_example;

class ResultFile : public test::InResultFolder {};

TEST_F(ResultFile, IsReadBack) {
  write_example(path);
  const ResultReader in(path);
  EXPECT_EQ(in.string_attribute("/", "whirl_version"), "0.1.0");
  EXPECT_EQ(in.string_attribute("/model", "text"), "title = \"Läufer\"\n");
  EXPECT_EQ(in.number_attribute("/model", "speed"), 382.25);
  EXPECT_EQ(in.number_attribute("/model", "modes"), 8.0);
  EXPECT_EQ(in.vector("/trajectory/t"), (Vec(4) << 0.0, 1.0, 2.0, 3.0).finished());
  EXPECT_EQ(in.strings("/trajectory/station"), (std::vector<std::string>{"seal", "Gehäuse", ""}));
  EXPECT_EQ(in.shape("/trajectory/x"), (std::vector<Eigen::Index>{4, 3}));
  EXPECT_EQ(in.matrix("/trajectory/x")(1, 2), 6.0);
  EXPECT_EQ(in.matrix("/trajectory/x")(3, 0), 10.0);
  EXPECT_EQ(in.complex_matrix("/modes/shape")(0, 1), Complex(2, -2));
  EXPECT_EQ(in.complex_matrix("/modes/shape")(1, 0), Complex(4, 0));
  EXPECT_EQ(in.complex_vector("/modes/eigenvalue"), (CVec(2) << Complex(1, -1), 4).finished());
  EXPECT_EQ(in.integers("/modes/number"), (std::vector<int>{1, 2, -3}));
  EXPECT_EQ(in.vector("/modes/number"), (Vec(3) << 1, 2, -3).finished());
  EXPECT_EQ(in.vector("/modes/ratio")(1), 1e-300);
}

// What stands along the dimensions, and what kind of numbers there are.
TEST_F(ResultFile, TellsAxesAndKinds) {
  {
    ResultWriter out(path);
    out.dataset("/a/time", std::vector<double>{1, 2}, {"s", "time", {}});
    out.dataset("/b/name", std::vector<std::string>{"u", "v", "w"}, {"", "name", {}});
    out.dataset("/a/x", Mat(Mat::Zero(3, 2)), {"m", "x", {"/b/name", "/a/time"}});
    out.dataset("/a/n", std::vector<int>{1, 2, 3}, {"", "count", {""}});
    out.dataset("/a/z", CVec(CVec::Zero(2)), {"", "complex", {}});
    out.commit();
  }
  const ResultReader in(path);
  EXPECT_EQ(in.axes("/a/x"), (std::vector<std::string>{"/b/name", "/a/time"}));
  EXPECT_EQ(in.axes("/a/n"), std::vector<std::string>{""});
  EXPECT_EQ(in.kind("/a"), ObjectKind::group);
  EXPECT_EQ(in.kind("/a/time"), ObjectKind::real);
  EXPECT_EQ(in.kind("/a/n"), ObjectKind::integer);
  EXPECT_EQ(in.kind("/a/z"), ObjectKind::complex);
  EXPECT_EQ(in.kind("/b/name"), ObjectKind::text);
  EXPECT_THROW(in.kind("/c"), FileError);
  EXPECT_THROW(in.axes("/a"), FileError);
}

// Numbers that come in pieces of any length, of a dataset that is compressed in chunks, and a
// stretch or a box of them.
TEST_F(ResultFile, IsWrittenAndReadInBlocks) {
  const std::vector<Eigen::Index> shape{7, 50, 9};
  std::vector<double> all(7 * 50 * 9), columns(400'000);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = 0.1 * static_cast<double>(i);
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = static_cast<double>(i % 1000) - 1.0;
  {
    ResultWriter out(path);
    auto x = out.dataset_blocks("/a/x", ObjectKind::real, shape, {"m", "x", {}});
    auto n = out.dataset_blocks("/a/n", ObjectKind::integer, {400'000}, {"", "n", {}});
    for (std::size_t at = 0, i = 0; at < all.size(); ++i) {  // both are open
      const std::size_t count = std::min<std::size_t>(all.size() - at, 1 + 211 * i % 997);
      x.add({all.data() + at, count});
      at += count;
    }
    for (std::size_t at = 0; at < columns.size(); at += 80'000)
      n.add({columns.data() + at, 80'000});
    x.finish();
    n.finish();
    out.dataset("/a/whole", columns, {"", "n", {}});
    out.commit();
  }
  const ResultReader in(path);
  EXPECT_EQ(in.numbers("/a/x"), all);
  EXPECT_EQ(in.kind("/a/n"), ObjectKind::integer);
  EXPECT_EQ(in.numbers("/a/n"), in.numbers("/a/whole"));
  for (const std::size_t first : {0ul, 8ul, 9ul, 449ul, 450ul, 3149ul}) {
    for (const std::size_t count : {1ul, 9ul, 10ul, 455ul, 1300ul}) {
      if (first + count > all.size()) continue;
      const auto from = all.begin() + static_cast<std::ptrdiff_t>(first);
      EXPECT_EQ(in.numbers("/a/x", first, count),
                std::vector<double>(from, from + static_cast<std::ptrdiff_t>(count)));
    }
  }
  const std::vector<double> box = in.numbers("/a/x", {{5, 2}, {48, 2}, {3, 4}});
  ASSERT_EQ(box.size(), 16u);
  EXPECT_EQ(box[0], all[(5 * 50 + 48) * 9 + 3]);
  EXPECT_EQ(box[15], all[(6 * 50 + 49) * 9 + 6]);
  std::vector<double> blocks;
  in.each_block("/a/n", [&](auto some) { blocks.insert(blocks.end(), some.begin(), some.end()); });
  EXPECT_EQ(blocks, columns);
  EXPECT_THROW(in.numbers("/a/x", 3000, 151), FileError);
  EXPECT_THROW(in.numbers("/a/x", {{5, 3}, {0, 1}, {0, 1}}), FileError);
  EXPECT_THROW(in.numbers("/a/x", {{5, 1}, {0, 1}}), FileError);

  ResultWriter other(folder / "other.h5");
  auto some = other.dataset_blocks("/a/x", ObjectKind::real, {3}, {"m", "x", {}});
  some.add(std::vector{1.0, 2.0});
  EXPECT_THROW(some.finish(), FileError);
  EXPECT_THROW(some.add(std::vector{3.0, 4.0}), FileError);
}

TEST_F(ResultFile, TellsWhatIsInIt) {
  write_example(path);
  const ResultReader in(path);
  EXPECT_EQ(in.list("/"), (std::vector<std::string>{"model", "modes", "trajectory"}));
  EXPECT_EQ(in.list("/modes"),
            (std::vector<std::string>{"eigenvalue", "number", "ratio", "shape"}));
  EXPECT_TRUE(in.has("/"));
  EXPECT_TRUE(in.has("/modes"));
  EXPECT_TRUE(in.has("/modes/shape"));
  EXPECT_TRUE(in.has_attribute("/modes/shape", "units"));
  EXPECT_FALSE(in.has(""));
  EXPECT_FALSE(in.has("/spectra"));
  EXPECT_FALSE(in.has("/spectra/x"));
  EXPECT_FALSE(in.has("/modes/shape/x"));
  EXPECT_FALSE(in.has_attribute("/modes/shape", "color"));
  EXPECT_FALSE(in.has_attribute("/spectra", "units"));
}

TEST_F(ResultFile, EveryDatasetHasUnitsAndALongName) {
  write_example(path);
  const ResultReader in(path);
  for (const char* group : {"/trajectory", "/modes"}) {
    for (const std::string& name : in.list(group)) {
      const std::string object = std::string(group) + '/' + name;
      EXPECT_TRUE(in.has_attribute(object, "units")) << object;
      EXPECT_FALSE(in.string_attribute(object, "long_name").empty()) << object;
    }
  }
  EXPECT_EQ(in.string_attribute("/trajectory/x", "units"), "m");
}

TEST_F(ResultFile, NumbersSurviveToTheLastBit) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> values = {0.1,
                                      -0.0,
                                      Limits::max(),
                                      Limits::denorm_min(),
                                      -1e9,
                                      Limits::infinity(),
                                      Limits::quiet_NaN()};
  ResultWriter out(path);
  out.dataset("/x", values, {"m", "x", {}});
  out.commit();
  const Vec back = ResultReader(path).vector("/x");
  ASSERT_EQ(back.size(), std::ssize(values));
  EXPECT_EQ(std::memcmp(back.data(), values.data(), sizeof(double) * values.size()), 0);
}

TEST_F(ResultFile, EmptyAndThinShapes) {
  ResultWriter out(path);
  out.dataset("/none", Vec(), {"s", "time", {}});
  out.dataset("/rows", Mat(0, 5), {"m", "x", {"/none"}});
  out.dataset("/columns", Mat(5, 0), {"m", "x", {}});
  out.dataset("/texts", std::vector<std::string>{}, {"", "names", {}});
  out.dataset("/one", Mat::Constant(1, 1, 3.0).eval(), {"", "one", {}});
  out.commit();
  const ResultReader in(path);
  EXPECT_EQ(in.vector("/none").size(), 0);
  EXPECT_EQ(in.matrix("/rows").cols(), 5);
  EXPECT_EQ(in.matrix("/columns").rows(), 5);
  EXPECT_TRUE(in.strings("/texts").empty());
  EXPECT_EQ(in.matrix("/one")(0, 0), 3.0);
}

TEST_F(ResultFile, LargeDatasetsAreCompressed) {
  // tall, wide with rows beyond a chunk, and a long vector
  const Mat tall = Mat::Random(30'000, 7), wide = Mat::Random(3, 300'000);
  const Mat smooth = Mat::Constant(1000, 1000, 3.0);
  const CVec pairs = CVec::Random(100'000);
  ResultWriter out(path);
  out.dataset("/tall", tall, {"m", "tall", {}});
  out.dataset("/wide", wide, {"m", "wide", {}});
  out.dataset("/pairs", pairs, {"m", "pairs", {}});
  out.commit();
  const ResultReader in(path);
  EXPECT_EQ(in.matrix("/tall"), tall);
  EXPECT_EQ(in.matrix("/wide"), wide);
  EXPECT_EQ(in.complex_vector("/pairs"), pairs);

  ResultWriter small(folder / "small.h5");
  small.dataset("/smooth", smooth, {"m", "smooth", {}});
  small.commit();
  EXPECT_LT(fs::file_size(folder / "small.h5"), 100'000u);  // of 8 MB
  EXPECT_EQ(ResultReader(folder / "small.h5").matrix("/smooth"), smooth);
}

TEST_F(ResultFile, SameCallsWriteSameBytes) {
  write_example(path);
  const std::string first = content(path);
  ::sleep(1);  // the resolution of HDF5's time stamps
  write_example(path);
  EXPECT_TRUE(content(path) == first);
}

TEST_F(ResultFile, AttributesMayBeSetAgainDatasetsMayNot) {
  ResultWriter out(path);
  out.attribute("/", "state", "running");
  out.attribute("/", "state", 3);
  out.dataset("/a/x", Vec(Vec::Ones(2)), {"m", "x", {}});
  out.attribute("/a/x", "station", "seal");
  EXPECT_EQ(problem_of([&] {
              out.dataset("/a/x", Vec(Vec::Ones(2)), {"m", "x", {}});
            }),
            path.string() + ": cannot write dataset /a/x: name already exists");
  out.commit();
  const ResultReader in(path);
  EXPECT_EQ(in.number_attribute("/", "state"), 3.0);
  EXPECT_EQ(in.string_attribute("/a/x", "station"), "seal");
}

TEST_F(ResultFile, AxesMustExistAndFit) {
  ResultWriter out(path);
  out.dataset("/t", Vec(Vec::Ones(3)), {"s", "time", {}});
  const Mat x = Mat::Ones(2, 3);
  EXPECT_EQ(problem_of([&] {
              out.dataset("/x", x, {"m", "x", {"/t"}});
            }),
            path.string() + ": cannot write dataset /x: its axis /t has another size");
  EXPECT_EQ(problem_of([&] {
              out.dataset("/y", x, {"m", "y", {"", "/s"}});
            }),
            path.string() + ": cannot write dataset /y: its axis /s is not written");
  EXPECT_EQ(problem_of([&] {
              out.dataset("/z", x, {"m", "z", {"", "/t", "/t"}});
            }),
            path.string() + ": cannot write dataset /z: more axes than dimensions");
}

TEST_F(ResultFile, OneAxisServesManyDatasets) {
  ResultWriter out(path);
  out.dataset("/t", Vec(Vec::Ones(3)), {"s", "time", {}});
  for (int i = 0; i < 500; ++i) {
    out.dataset("/x/" + std::to_string(i), Vec(Vec::Ones(3)), {"m", "x", {"/t"}});
  }
  out.commit();
  EXPECT_EQ(ResultReader(path).list("/x").size(), 500u);
}

TEST_F(ResultFile, WithoutCommitTheOldFileStays) {
  write_example(path);
  const std::string old = content(path);
  {
    ResultWriter out(path);
    out.dataset("/x", Mat(Mat::Random(1000, 100)), {"m", "x", {}});
  }
  EXPECT_TRUE(content(path) == old);
  EXPECT_EQ(files(), 1u);
}

TEST_F(ResultFile, ProblemsOfReadingAreExplained) {
  write_example(path);
  const ResultReader in(path);
  const std::string name = path.string();
  EXPECT_EQ(problem_of([&] { in.matrix("/trajectory/y"); }),
            name + ": cannot read dataset /trajectory/y: there is none");
  EXPECT_EQ(problem_of([&] { in.matrix("/trajectory/t"); }),
            name + ": cannot read dataset /trajectory/t: it has 1 dimensions, expected 2");
  EXPECT_EQ(problem_of([&] { in.matrix("/modes/shape"); }),
            name + ": cannot read dataset /modes/shape: it does not hold real numbers");
  EXPECT_EQ(problem_of([&] { in.complex_matrix("/trajectory/x"); }),
            name + ": cannot read dataset /trajectory/x: it does not hold complex numbers");
  EXPECT_EQ(problem_of([&] { in.integers("/trajectory/t"); }),
            name + ": cannot read dataset /trajectory/t: it does not hold integers");
  EXPECT_EQ(problem_of([&] { in.strings("/trajectory/t"); }),
            name + ": cannot read dataset /trajectory/t: it is not text");
  EXPECT_EQ(problem_of([&] { in.vector("/modes"); }),
            name + ": cannot read dataset /modes: not a dataset");
  EXPECT_EQ(problem_of([&] { in.list("/spectra"); }),
            name + ": cannot read group /spectra: there is none");
  EXPECT_EQ(problem_of([&] { in.string_attribute("/model", "author"); }),
            name + ": cannot read attribute /model@author: there is none");
  EXPECT_EQ(problem_of([&] { in.string_attribute("/model", "speed"); }),
            name + ": cannot read attribute /model@speed: it is not text");
  EXPECT_EQ(problem_of([&] { in.number_attribute("/model", "text"); }),
            name + ": cannot read attribute /model@text: it is not one number");
}

TEST_F(ResultFile, BadFilesAreExplained) {
  const auto problem = [](const fs::path& file) {
    return problem_of([&] { ResultReader in(file); });
  };
  EXPECT_EQ(problem(path), "cannot open " + path.string() + ": there is no such file");
  EXPECT_EQ(problem(folder), "cannot open " + folder.string() + ": not an HDF5 file");
  std::ofstream(path) << "format = 1\n";
  EXPECT_EQ(problem(path), "cannot open " + path.string() + ": not an HDF5 file");
  std::ofstream(path, std::ios::trunc).close();
  EXPECT_EQ(problem(path), "cannot open " + path.string() + ": not an HDF5 file");

  write_example(path);
  fs::resize_file(path, fs::file_size(path) / 2);
  EXPECT_NE(problem(path).find("damaged HDF5 file (truncated file"), std::string::npos)
      << problem(path);
  EXPECT_EQ(problem_of([&] { ResultWriter out(folder / "none" / "x.h5"); }),
            "cannot write " + (folder / "none/x.h5").string() + ": there is no directory " +
                (folder / "none").string());
}

TEST_F(ResultFile, ErrorsAreSilentInEveryThread) {
  write_example(path);
  testing::internal::CaptureStderr();
  std::thread([&] {
    const ResultReader in(path);
    problem_of([&] { in.vector("/modes"); });
    problem_of([&] { in.vector("/none"); });
  }).join();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// A reader's child copies what other threads hold: were one of them inside HDF5, the child would
// wait for it for ever, and this test with it.
TEST_F(ResultFile, IsReadWhileOtherThreadsWrite) {
  write_example(path);
  std::vector<std::jthread> writers;
  for (int i = 0; i < 3; ++i) {
    writers.emplace_back([&, i](const std::stop_token& end) {
      while (!end.stop_requested()) {
        ResultWriter out(folder / ("other" + std::to_string(i) + ".h5"));
        for (int j = 0; j < 50; ++j) {
          out.dataset("/" + std::to_string(j), CVec(CVec::Ones(3)), {"m", "ones"});
        }
      }
    });
  }
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(ResultReader(path).has("/modes"));
}

}  // namespace whirl::hdf5_test

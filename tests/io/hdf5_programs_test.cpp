// Result files and other programs: h5py, h5dump.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "libio/results/hdf5.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::hdf5_programs_test {

using test::write_example;

class ResultFileElsewhere : public test::InResultFolder {};

/// Runs a program; what it prints, and its exit status.
std::pair<std::string, int> run(const std::string& command) {
  std::string output;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) output += buffer.data();
  return {output, WEXITSTATUS(::pclose(pipe))};
}

TEST_F(ResultFileElsewhere, H5pyReadsIt) {
  const std::string python = "/usr/bin/python3 -c ";
  if (run(python + "'import h5py'").second != 0) GTEST_SKIP() << "h5py is not installed";
  write_example(path);
  const auto [output, status] = run(python + R"('
import h5py, numpy
f = h5py.File(")" + path.string() + R"(", "r")
assert f.attrs["whirl_version"] == "0.1.0"
assert f["model"].attrs["text"] == "title = \"Läufer\"\n"
assert f["model"].attrs["speed"] == 382.25 and f["model"].attrs["modes"] == 8
x = f["trajectory/x"]
assert x.shape == (4, 3) and x[1, 2] == 6.0 and x.dtype == numpy.float64
assert x.attrs["units"] == "m" and x.attrs["long_name"] == "displacement in x"
assert x.dims[0].label == "t" and x.dims[1].label == "station"
assert list(x.dims[0][0][:]) == [0, 1, 2, 3] and x.dims[0][0] == f["trajectory/t"]
assert list(x.dims[1][0].asstr()[:]) == ["seal", "Gehäuse", ""]
assert h5py.h5ds.is_scale(f["trajectory/t"].id) and not h5py.h5ds.is_scale(x.id)
shape = f["modes/shape"]
assert shape.dtype == numpy.complex128 and shape[0, 1] == 2 - 2j and shape[1, 2] == 6j
assert len(shape.dims[0]) == 0 and shape.dims[1][0] == f["trajectory/station"]
assert list(f["modes/number"]) == [1, 2, -3]
')");
  EXPECT_EQ(status, 0) << output;
}

TEST_F(ResultFileElsewhere, OtherProgramsFilesAreRead) {
  const std::string python = "/usr/bin/python3 -c ";
  if (run(python + "'import h5py'").second != 0) GTEST_SKIP() << "h5py is not installed";
  const auto [output, status] = run(python + R"('
import h5py, numpy
f = h5py.File(")" + path.string() + R"(", "w")
f.attrs["fixed"] = numpy.bytes_("abc")
f["fixed"] = numpy.array([b"seal", b"disk 1"])
f["float32"] = numpy.array([[0.5, 1.5]], dtype="float32")
f["big"] = numpy.array([1, 2], dtype=">i8")
f["complex64"] = numpy.array([1 + 2j], dtype="complex64")
')");
  ASSERT_EQ(status, 0) << output;
  const ResultReader in(path);
  EXPECT_EQ(in.string_attribute("/", "fixed"), "abc");
  EXPECT_EQ(in.strings("/fixed"), (std::vector<std::string>{"seal", "disk 1"}));
  EXPECT_EQ(in.matrix("/float32"), (Mat(1, 2) << 0.5, 1.5).finished());
  EXPECT_EQ(in.integers("/big"), (std::vector<int>{1, 2}));
  EXPECT_EQ(in.complex_vector("/complex64")(0), Complex(1, 2));
}

TEST_F(ResultFileElsewhere, H5dumpReadsIt) {
  if (run("h5dump --version").second != 0) GTEST_SKIP() << "hdf5-tools is not installed";
  write_example(path);
  const auto [output, status] = run("h5dump -H " + path.string());
  EXPECT_EQ(status, 0);
  for (const char* part : {"DATASET \"x\"", "DIMENSION_LIST", "REFERENCE_LIST", "units"}) {
    EXPECT_NE(output.find(part), std::string::npos) << part;
  }
}

}  // namespace whirl::hdf5_programs_test

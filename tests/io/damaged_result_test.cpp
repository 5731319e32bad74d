// Damaged files, and files that point to others: refused, never a signal, nothing read elsewhere.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>
#include <functional>
#include <random>

#include "libio/results/hdf5/checksum.hpp"
#include "libio/results/result_schema.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::damaged_result_test {

namespace fs = std::filesystem;
using hdf5::Seal;
using test::content, test::problem_of, test::write_example;

class DamagedResult : public test::InResultFolder {
 protected:
  void write(const std::string& bytes) const {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  }
  /// The example without its checksum, as older versions wrote it.
  std::string unsealed() const {
    write_example(path);
    const std::string bytes = content(path);
    return bytes.substr(0, bytes.rfind("\nwhirl: "));
  }
};

// CRC-32 finds every change within 32 neighboring bits.
TEST_F(DamagedResult, EveryChangedByteIsFound) {
  write_example(path);
  const std::string whole = content(path);
  EXPECT_EQ(hdf5::seal_of(path), Seal::whole);
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string bytes = whole;
    const std::size_t at = random() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ (1 + random() % 255));
    write(bytes);
    const std::string problem = problem_of([&] { ResultReader in(path); });
    EXPECT_TRUE(problem.starts_with("cannot open " + path.string() + ": damaged HDF5 file") ||
                problem.ends_with("not an HDF5 file"))
        << at << ": " << problem;
  }
}

TEST_F(DamagedResult, ACutFileIsFound) {
  write_example(path);
  const std::string whole = content(path);
  for (const std::size_t size : {whole.size() - 1, whole.size() - 20, whole.size() / 2}) {
    write(whole.substr(0, size));
    EXPECT_NE(problem_of([&] { ResultReader in(path); }).find("damaged HDF5 file"),
              std::string::npos);
  }
}

// The checksum of a published test vector would say nothing about where it is put: here it is the
// line itself that is pinned, so that files stay readable.
TEST_F(DamagedResult, TheChecksumIsALineBehindTheFile) {
  const std::string bare = unsealed();
  write_example(path);
  const std::string line = content(path).substr(bare.size());
  EXPECT_TRUE(line.starts_with("\nwhirl: " + std::to_string(bare.size()) + " bytes, crc32 "));
  EXPECT_TRUE(line.ends_with("\n"));
}

// What HDF5 itself ends or hangs on does so in a child process.
TEST_F(DamagedResult, WithoutAChecksumItIsReadOrRefused) {
  const std::string whole = unsealed();
  write(whole);
  EXPECT_EQ(hdf5::seal_of(path), Seal::none);
  EXPECT_EQ(problem_of([&] { EXPECT_EQ(ResultReader(path).matrix("/trajectory/x")(1, 2), 6.0); }),
            "none");
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 8; ++k) bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    write(bytes);
    problem_of([&] {
      const ResultReader in(path);
      in.list("/");
      in.strings("/trajectory/station");
      in.axes("/trajectory/x");
    });
  }
}

TEST_F(DamagedResult, AChangeByAnotherProgramIsNoDamage) {
  write_example(path);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t group = H5Gcreate2(file, "/notes", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Gclose(group);
  H5Fclose(file);
  EXPECT_EQ(hdf5::seal_of(path), Seal::none);
  EXPECT_TRUE(ResultReader(path).has("/notes"));
}

// Files of strangers on which reports ended by a signal: counts that overflow, empty and half datasets,
// codes without meaning, flipped bytes. Each is refused, or read as far as it is right.
TEST_F(DamagedResult, FilesThatOnceEndedAReportAreRefused) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(WHIRL_SOURCE_DIR "/tests/data/bad_results")) {
    ++files;
    const std::string problem = problem_of([&] { open_result(entry.path()); });
    EXPECT_TRUE(problem.find(entry.path().string()) != std::string::npos)
        << entry.path() << ": " << problem;
  }
  EXPECT_EQ(files, 5);
}

// ---- other files --------------------------------------------------------------------------------

TEST_F(DamagedResult, LinksAreNotFollowed) {
  const fs::path other = folder / "other.h5";
  write_example(other);
  for (const bool is_external : {true, false}) {
    unsealed();
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    if (is_external) {
      H5Lcreate_external(other.c_str(), "/modes", file, "/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
    } else {
      H5Lcreate_soft("/modes", file, "/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
    }
    H5Fclose(file);
    EXPECT_EQ(problem_of([&] { ResultReader in(path); }),
              "cannot open " + path.string() +
                  ": /elsewhere is a link to another place, which is not followed");
  }
}

// Bytes of a text file of this machine as the numbers of a dataset, as a crafted file showed them.
TEST_F(DamagedResult, ExternalStorageIsNotRead) {
  const fs::path secret = folder / "secret.txt";
  std::ofstream(secret) << "0123456789abcdef";
  unsealed();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hsize_t size = 16;
  const hid_t space = H5Screate_simple(1, &size, nullptr), how = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_external(how, secret.c_str(), 0, size);
  const hid_t dataset =
      H5Dcreate2(file, "/told", H5T_NATIVE_UCHAR, space, H5P_DEFAULT, how, H5P_DEFAULT);
  H5Dclose(dataset);
  H5Pclose(how);
  H5Sclose(space);
  H5Fclose(file);
  const ResultReader in(path);
  for (const auto& read : std::vector<std::function<void()>>{[&] { in.numbers("/told"); },
                                                             [&] { in.integers("/told"); },
                                                             [&] { in.shape("/told"); }}) {
    EXPECT_EQ(problem_of(read), path.string() +
                                    ": cannot read dataset /told: its numbers are in another file, "
                                    "which is not read");
  }
}

// 2^61 numbers of 8 bytes are 0 bytes to who multiplies without looking.
TEST_F(DamagedResult, SizesThatTheFileCannotHoldAreRefused) {
  for (const hsize_t size : {hsize_t{1} << 61, hsize_t{1} << 40, hsize_t{100'000'000}}) {
    unsealed();
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hsize_t chunk = 1000;
    const hid_t space = H5Screate_simple(1, &size, nullptr), how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(how, 1, &chunk);
    H5Pset_deflate(how, 1);
    const hid_t dataset =
        H5Dcreate2(file, "/vast", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT);
    ASSERT_GE(dataset, 0);
    H5Dclose(dataset);
    H5Pclose(how);
    H5Sclose(space);
    H5Fclose(file);
    const ResultReader in(path);
    EXPECT_NE(
        problem_of([&] { in.vector("/vast"); }).find("cannot read dataset /vast: it says to hold"),
        std::string::npos);
  }
}

}  // namespace whirl::damaged_result_test

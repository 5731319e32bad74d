// Damaged files, and files that point to others: refused, never a signal, nothing read elsewhere.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <random>

#include "libio/results/confined_child.hpp"
#include "libio/results/hdf5/checksum.hpp"
#include "libio/results/result_schema.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::damaged_result_test {

namespace fs = std::filesystem;
using hdf5::Seal;
using test::content, test::problem_of, test::write_example;

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

class DamagedResult : public test::InResultFolder {
 protected:
  void write(const std::string& bytes) const { write_bytes(path, bytes); }
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

// Files of strangers on which reports ended by a signal: counts that overflow, empty and half
// datasets, codes without meaning, flipped bytes. Each is refused, or read as far as it is right.
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

/// Makes the checksum of a changed file right again, as anybody can.
void forge_seal(const fs::path& path) {
  const std::string bytes = content(path);
  write_bytes(path, bytes.substr(0, bytes.rfind("\nwhirl: ")));
  hdf5::seal(path);
}

// A checksum says that nothing was damaged by chance; who changes a file writes the right one.
// Whatever HDF5 does then, it does not do it here.
TEST_F(DamagedResult, AForgedChecksumIsBelievedNothing) {
  write_example(path);
  const std::string whole = content(path);
  const std::size_t end = whole.rfind("\nwhirl: ");
  std::mt19937 random(11);
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 8; ++k)
      bytes[32 + random() % (end - 32)] = static_cast<char>(random() % 256);
    write(bytes);
    forge_seal(path);
    problem_of([&] {
      const ResultReader in(path);
      in.list("/");
      in.attributes("/");
      in.string_attribute("/model", "text");
      in.strings("/trajectory/station");
      in.axes("/trajectory/x");
    });
  }
}

/// Groups of which each has two links to the next one, so that 2^30 paths lead to the last.
void add_many_paths(hid_t file) {
  hid_t group = H5Gcreate2(file, "/g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  for (int i = 0; i < 30; ++i) {
    const hid_t next = H5Gcreate2(group, "a", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_hard(group, "a", group, "b", H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(group);
    group = next;
  }
  H5Gclose(group);
}

// Groups within themselves and groups to which 2^30 paths lead are looked into once.
TEST_F(DamagedResult, LoopsOfLinksEnd) {
  unsealed();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Lcreate_hard(file, "/trajectory", file, "/trajectory/again", H5P_DEFAULT, H5P_DEFAULT);
  add_many_paths(file);
  H5Fclose(file);
  const std::vector<std::string> found = ResultReader(path).datasets();
  EXPECT_EQ(std::count(found.begin(), found.end(), "/trajectory/x"), 1);
  EXPECT_LT(found.size(), 20u);
}

// h5py writes f["fs"] = 5000. as a dataset without dimensions, h5py.Empty as one without a space.
TEST_F(DamagedResult, DatasetsWithoutDimensionsAreRead) {
  unsealed();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  for (const bool is_null : {false, true}) {
    const hid_t space = H5Screate(is_null ? H5S_NULL : H5S_SCALAR);
    const hid_t dataset = H5Dcreate2(file, is_null ? "/null" : "/fs", H5T_NATIVE_DOUBLE, space,
                                     H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const double rate = 5000.0;
    if (!is_null) H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &rate);
    H5Dclose(dataset);
    H5Sclose(space);
  }
  H5Fclose(file);
  const ResultReader in(path);
  EXPECT_EQ(in.numbers("/fs"), std::vector<double>{5000.0});
  std::vector<double> blocks;
  in.each_block("/fs",
                [&](auto block) { blocks.insert(blocks.end(), block.begin(), block.end()); });
  EXPECT_EQ(blocks, std::vector<double>{5000.0});
  EXPECT_TRUE(in.numbers("/null").empty());
  EXPECT_EQ(in.shape("/null"), std::vector<Eigen::Index>{0});
}

// An axis without dimensions in a study ended a report with a message of the standard library.
TEST_F(DamagedResult, AnAxisWithoutDimensionsIsRefused) {
  fs::copy_file(WHIRL_SOURCE_DIR "/tests/fuzz/results/sweep.h5", path);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "/sweep/axis_1", H5P_DEFAULT);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t axis = H5Dcreate2(file, "/sweep/axis_1", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT,
                                H5P_DEFAULT, H5P_DEFAULT);
  const double value = 100.0;
  H5Dwrite(axis, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
  H5Dclose(axis);
  H5Sclose(space);
  H5Fclose(file);
  const std::string problem = problem_of([&] { open_result(path); });
  EXPECT_NE(problem.find("/sweep/axis_1 is damaged or of another program: it has 0 dimensions"),
            std::string::npos)
      << problem;
}

// A pipe holds nobody up, a device does not fill the memory: neither is a result.
TEST_F(DamagedResult, DevicesAndPipesAreNotOpened) {
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  for (const fs::path& place : {path, fs::path("/dev/zero")}) {
    EXPECT_EQ(problem_of([&] { ResultReader in(place); }),
              "cannot open " + place.string() + ": it is a device or a pipe, expected a file");
  }
}

// A child that is killed is an error of whoever asks it, each time.
TEST_F(DamagedResult, AnEndOfTheReadingIsAnError) {
  write_example(path);
  const OpenedFile file(path);
  const ConfinedChild child(file, "x.h5", "HDF5", [](const std::string& question) {
    if (question == "end") ::raise(SIGSEGV);
    if (question == "file") {
      const bool can_open = ::open("/etc/passwd", O_RDONLY) >= 0;
      open_nothing_more();
      return ConfinedChild::Letter{can_open && ::open("/etc/passwd", O_RDONLY) < 0 ? "no" : "yes"};
    }
    return ConfinedChild::Letter{question, {1.5}};
  });
  EXPECT_EQ(child.ask("one").bytes, "one");
  EXPECT_EQ(child.ask("two").numbers, std::vector<double>{1.5});
  EXPECT_EQ(child.ask("file").bytes, "no");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(problem_of([&] { child.ask("end"); }),
              "cannot open x.h5: damaged HDF5 file (reading it ends by signal 11)");
  }
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

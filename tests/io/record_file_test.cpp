// Records of measurements: every format reads back what it wrote, files of other writers are read,
// and what is wrong in a file is said with its place.

#include "libio/measured/record_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "libio/measured/channel_unit.hpp"
#include "libio/results/matlab_variables.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::record_file_test {

class RecordFile : public test::InResultFolder {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }
  /// What is said about a file.
  std::string problem(const std::string& name, const std::string& text) const {
    try {
      read_record(file(name, text));
    } catch (const ModelError& error) {
      return describe(error.problems().at(0));
    }
    return "none";
  }
  /// Whether it says this, of a file in the folder.
  void expect_problem(const std::string& name, const std::string& text,
                      const std::string& part) const {
    const std::string said = problem(name, text);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
};

MeasuredRecord example(double rate) {
  MeasuredRecord record{.rate = rate, .start = 0.25};
  record.channels = {{"left (DE) x", "m"}, {"2", "V"}, {"key [1]", ""}};
  record.samples.resize(101, 3);
  for (Eigen::Index j = 0; j < 101; ++j) {
    const double t = static_cast<double>(j) / 7.0;
    record.samples.row(j) << 1e-5 * std::sin(t), -8.0 + std::cos(t), j % 10 == 0 ? 1.0 : 0.0;
  }
  return record;
}

TEST_F(RecordFile, EveryFormatReadsBackWhatItWrote) {
  // a step of time that has more digits than universal files have for it
  const MeasuredRecord written = example(4483.0);
  for (const char* name : {"a.csv", "a.mat", "a.uff", "a.ufb", "a.h5", "a.wav"}) {
    write_record(folder / name, written, Replaces::own_pictures);
    write_record(folder / name, written,
                 name == std::string("a.wav") ? Replaces::anything : Replaces::own_pictures);
    const MeasuredRecord read = read_record(folder / name);
    EXPECT_NEAR(read.rate, written.rate, 1e-12 * written.rate) << name;
    ASSERT_EQ(read.channels.size(), 3u) << name;
    const bool is_text = name == std::string("a.uff");  // thirteen digits
    for (std::size_t c = 0; c < 3; ++c) {
      const auto index = static_cast<Eigen::Index>(c);
      const auto at = read.channel(written.channels[c].name);
      ASSERT_TRUE(at) << name << " " << written.channels[c].name;
      EXPECT_EQ(read.channels[static_cast<std::size_t>(*at)].unit, written.channels[c].unit);
      // a sound begins at zero
      if (name != std::string("a.wav")) {
        EXPECT_NEAR(read.start, written.start, 1e-12) << name;
      }
      const Vec error = read.samples.col(*at) - written.samples.col(index);
      EXPECT_LE(error.cwiseAbs().maxCoeff(),
                is_text ? 1e-12 * written.samples.col(index).cwiseAbs().maxCoeff() : 0.0)
          << name;
    }
  }
}

// ---- tables -------------------------------------------------------------------------------------

TEST_F(RecordFile, ReadsTablesOfLoggers) {
  const MeasuredRecord german = read_record(file("a.txt",
                                                 "Messung 12\r\nDatum;1.2.2026\r\n"
                                                 "Zeit;Weg\r\n"
                                                 "time [ms];s1 [µm];s2 [mV]\r\n"
                                                 "0,0;1,5;10\r\n0,5;;20\r\n1,0;2,5;30\r\n"));
  EXPECT_NEAR(german.rate, 2000.0, 1e-9);
  ASSERT_EQ(german.channels.size(), 2u);
  EXPECT_EQ(german.channels[0].name, "s1");
  EXPECT_EQ(german.channels[1].unit, "V");
  EXPECT_NEAR(german.samples(0, 0), 1.5e-6, 1e-20);
  EXPECT_TRUE(std::isnan(german.samples(1, 0)));
  EXPECT_NEAR(german.samples(2, 1), 0.03, 1e-16);

  const MeasuredRecord lines_of_units =
      read_record(file("b.csv", "t\tx\ty\ns\tum\tmil\n0\t1\t2\n0.1\t3\t4\n"));
  EXPECT_EQ(lines_of_units.channels[1].unit, "m");
  EXPECT_NEAR(lines_of_units.samples(1, 1), 4 * 25.4e-6, 1e-18);

  const MeasuredRecord bars = read_record(file("e.csv", "t [s]|x [um]\n0|1,5\n0,1|2,5\n"));
  EXPECT_EQ(bars.channels[0].name, "x");
  EXPECT_NEAR(bars.samples(1, 0), 2.5e-6, 1e-20);

  const MeasuredRecord rate = read_record(file("c.csv", "# Sample rate: 5 kHz\n1 2\n3 4\nnan 5\n"));
  EXPECT_EQ(rate.rate, 5000.0);
  EXPECT_EQ(rate.channels[1].name, "2");
  EXPECT_EQ(read_record(file("d.csv", "x,y,\n1,2,\n3,4,\n"), 10.0).channels.size(), 2u);
}

// Rows that are left out show in the times: their samples are missing ones.
TEST_F(RecordFile, PutsSamplesWhereTheirTimesAre) {
  std::string rows = "time [s],x [um]\n", kept = rows;
  for (int j = 0; j < 60; ++j) {
    const std::string row = fmt::format("{:.4f},{}\n", 0.5 + 0.001 * j, j);
    rows += row;
    if (j != 17 && j != 40 && j != 41) kept += row;
  }
  const MeasuredRecord record = read_record(file("a.csv", kept));
  const MeasuredRecord whole = read_record(file("b.csv", rows));
  EXPECT_NEAR(record.rate, 1000.0, 1e-6);
  ASSERT_EQ(record.samples.rows(), 60);
  for (Eigen::Index j = 0; j < 60; ++j) {
    const bool is_missing = j == 17 || j == 40 || j == 41;
    EXPECT_EQ(std::isnan(record.samples(j, 0)), is_missing) << j;
    if (!is_missing) {
      EXPECT_EQ(record.samples(j, 0), whole.samples(j, 0));
    }
  }
}

// A unit of time says which column is that of times, in any language and after a comma, too.
TEST_F(RecordFile, FindsTimesByTheirUnit) {
  for (const char* head : {"Zeit (s);s1 [um]", "\"Time, s\";\"s1, um\"", "aika [s];s1 [um]"}) {
    const MeasuredRecord record =
        read_record(file("a.csv", std::string(head) + "\n0;1,5\n0,5;2,5\n1;3\n"));
    EXPECT_NEAR(record.rate, 2.0, 1e-12) << head;
    ASSERT_EQ(record.channels.size(), 1u) << head;
    EXPECT_EQ(record.channels[0].name, "s1") << head;
    EXPECT_NEAR(record.samples(1, 0), 2.5e-6, 1e-20) << head;
  }
}

// Where the rate is known a channel in a unit of time is one like any other, and a last word is no
// unit.
TEST_F(RecordFile, LeavesNamesAndOtherChannelsAsTheyAre) {
  const std::string table = "Bearing 1 V,Bearing 1 H,period [ms]\n1,2,13\n3,4,12\n";
  const MeasuredRecord record = read_record(file("a.csv", table), 100.0);
  ASSERT_EQ(record.channels.size(), 3u);
  EXPECT_EQ(record.channels[0].name, "Bearing 1 V");
  EXPECT_EQ(record.channels[1].name, "Bearing 1 H");
  EXPECT_EQ(record.channels[2].name, "period");
  EXPECT_EQ(read_record(file("b.csv", "# fs = 100\n" + table)).channels.size(), 3u);
}

TEST_F(RecordFile, ReadsTablesInUtf16) {
  const std::string table = "time [s]\ts1 [\xB5m]\n0\t1\n0.5\t2\n";  // Latin-1
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char c : table) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& bytes : {little, big}) {
    const MeasuredRecord record = read_record(file("a.txt", bytes));
    EXPECT_NEAR(record.rate, 2.0, 1e-12);
    EXPECT_NEAR(record.samples(1, 0), 2e-6, 1e-20);
  }
  expect_problem("b.txt", little + "x", "begins as UTF-16 and is none");
}

TEST_F(RecordFile, TakesRatesThatAreThoseOfTheFile) {
  const std::filesystem::path record = file("a.csv", "time [s],x [um]\n0,1\n0.00033333,2\n");
  EXPECT_EQ(read_record(record, 3000.0).rate, 3000.0) << "with more digits";
  EXPECT_THROW(read_record(record, 2900.0), ModelError);
}

TEST_F(RecordFile, SaysWhatIsWrongInATable) {
  expect_problem("a.csv", "t,x\n0,1\n1,2\n1,3\n2,4\n", "sample 3 is at 1, the one before at 1");
  expect_problem("a.csv", "t,x\n0,1\n1,2\n2.3,2\n3,4\n", "sample 3 is at 2.3, expected 2");
  expect_problem("a.csv", "t,x,y\n0,0,1,5,2,5\n0,1,1,5,2,5\n", "a.csv:1:1: names 3 columns");
  expect_problem("a.csv", "t,x\n12:00:01 h,1\n12:00:02 h,1\n", "\"12:00:02 h\" in the last line");
  expect_problem("a.csv", "t,x\n0,1\n1,2\n2,3,4\n",
                 "a.csv:4:1: found 3 columns, expected 2 as in line 2");
  expect_problem("a.csv", "t,x\n0,1\n1,2\n2,three\n", "a.csv:4:3: x: found \"three\"");
  expect_problem("a.csv", "t,x\n0,1\n1,2\n5,3\n", "steps must be even");
  expect_problem("a.csv", "t,x\n0,1\n-1,2\n", "ascend");
  expect_problem("a.csv", "t [um],x\n0,1\n1,2\n", "time");
  expect_problem("a.csv", "x,y\n0,1\n1,2\n", "--rate says it");
  expect_problem("a.csv", "nothing\nat all\n", "expected a column for each channel");
  expect_problem("a.csv", "", "is empty");
}

// ---- universal files ----------------------------------------------------------------------------

/// The eleven records of a dataset as data loggers write them, with exponents of three digits.
std::string dataset_58(const std::string& head, int type, int count, bool is_even) {
  return "    -1\n" + head + "\nshaft x : um\nmade by hand\n30-Apr-20 19:12:52\nNONE\nNONE\n" +
         "    1         0    0         0 NONE              12   2 NONE               0   0\n" +
         fmt::format("{:10}{:10}{:10} 1.00000E+000 5.00000E-003 0.00000E+000\n", type, count,
                     is_even ? 1 : 0) +
         "        17    0    0    0 Time                 s                                \n"
         "         8    0    0    0 shaft x              um                               \n"
         "         0    0    0    0 NONE                 NONE                             \n"
         "         0    0    0    0 NONE                 NONE                             \n";
}

template <class Number>
std::string bytes_of(std::vector<double> values, bool is_big) {
  std::string bytes;
  for (const double value : values) {
    const auto number = static_cast<Number>(value);
    std::string one(sizeof number, '\0');
    std::memcpy(one.data(), &number, sizeof number);
    if (is_big) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

std::string binary_head(int order, std::size_t bytes) {
  return fmt::format("    58b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", order, 2, 11, bytes, 0, 0, 0,
                     0);
}

TEST_F(RecordFile, ReadsUniversalFilesOfOtherWriters) {
  const std::string text =
      dataset_58("    58", 2, 8, true) +
      " -3.81956E+00 -3.56616E+00 -2.98987E+00 -2.62207E+00 -3.22879E+00-3.63712E+100\n"
      "  1.00000E+00  2.00000E+00\n    -1\n";
  const MeasuredRecord record = read_record(file("a.unv", text));
  EXPECT_NEAR(record.rate, 200.0, 1e-9);
  EXPECT_EQ(record.start, 1.0);
  EXPECT_EQ(record.channels.at(0).name, "shaft x : um");
  EXPECT_NEAR(record.samples(0, 0), -3.81956e-6, 1e-18);
  EXPECT_NEAR(record.samples(7, 0), 2e-6, 1e-18);

  const std::vector<double> values{1.0, -2.5, 3.25, 0.0, 10.0};
  for (const bool is_big : {false, true}) {
    for (const int type : {2, 4}) {
      const std::string bytes =
          type == 2 ? bytes_of<float>(values, is_big) : bytes_of<double>(values, is_big);
      const std::string head = binary_head(is_big ? 2 : 1, bytes.size());
      const std::string one = dataset_58(head, type, 5, true) + bytes + "\n    -1\n";
      const MeasuredRecord binary = read_record(file("b.uff", one + one));
      ASSERT_EQ(binary.samples.cols(), 2);
      for (Eigen::Index j = 0; j < 5; ++j) {
        EXPECT_NEAR(binary.samples(j, 1), 1e-6 * values[static_cast<std::size_t>(j)], 1e-18);
      }
    }
  }
  const std::string times = bytes_of<double>({0.0, 1.0, 0.5, 2.0, 1.0, 3.0}, false);
  const MeasuredRecord uneven = read_record(
      file("c.uff", dataset_58(binary_head(1, times.size()), 4, 3, false) + times + "\n    -1\n"));
  EXPECT_NEAR(uneven.rate, 2.0, 1e-12);
  EXPECT_NEAR(uneven.samples(2, 0), 3e-6, 1e-18);
}

TEST_F(RecordFile, SaysWhatIsWrongInAUniversalFile) {
  const std::string head = dataset_58("    58", 2, 8, true);
  expect_problem("a.uff", head + "  1.00000E+00\n    -1\n", "ends after 1 numbers, expected 8");
  expect_problem("a.uff", head + "  1.00000E+00 one\n    -1\n",
                 "a.uff:14:1: dataset 1: found \"one\"");
  expect_problem("a.uff", dataset_58("    58", 2, 2000000000, true) + " 1\n", "do not fit into");
  expect_problem("a.uff", dataset_58(binary_head(1, 16), 4, 5, true) + std::string(60, 'x'),
                 "values take 16 bytes");
  expect_problem("a.uff", dataset_58("    58", 5, 8, true) + " 1\n", "complex values");
  expect_problem("a.uff", "    -1\n    58\nx\n", "is cut off, expected 11 records");
  expect_problem("a.uff", "    -1\n    15\n 1 2 3\n    -1\n", "it has dataset 1 (15)");
  expect_problem("a.uff", "", "none at all");
}

// ---- others -------------------------------------------------------------------------------------

/// A WAV file of 16 bits, as sound cards make it.
std::string wav_file(std::uint16_t bits, const std::string& data, std::uint32_t said) {
  std::string bytes = "RIFF\x01\x01\x01\x01WAVEfmt ";
  const auto add = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  add(std::uint32_t{16});
  add(std::uint16_t{1});
  add(std::uint16_t{2});
  add(std::uint32_t{48000});
  add(std::uint32_t{48000u * bits / 4u});
  add(static_cast<std::uint16_t>(bits / 4));
  add(bits);
  bytes += "LIST";
  add(std::uint32_t{3});
  bytes += "abc";
  bytes += '\0';  // chunks begin at even places
  bytes += "data";
  add(said);
  return bytes + data;
}

TEST_F(RecordFile, ReadsSoundFiles) {
  const std::string two_frames("\x00\x40\x00\xC0\xFF\x7F\x00\x80", 8);
  const MeasuredRecord record = read_record(file("a.wav", wav_file(16, two_frames, 8)));
  EXPECT_EQ(record.rate, 48000.0);
  EXPECT_EQ(record.samples(0, 0), 0.5);
  EXPECT_EQ(record.samples(0, 1), -0.5);
  EXPECT_EQ(record.samples(1, 0), 32767.0 / 32768.0);
  EXPECT_EQ(record.samples(1, 1), -1.0);
  EXPECT_EQ(record.channels[0].unit, share_of_full_scale);
  const std::string frame("\x00\x00\x40\x00\x00\xC0", 6);
  EXPECT_EQ(read_record(file("b.wav", wav_file(24, frame, 6))).samples(0, 1), -0.5);
  expect_problem("a.wav", wav_file(16, two_frames, 80), "is cut off");
  expect_problem("a.wav", wav_file(12, two_frames, 8), "with 12 bits");
  expect_problem("a.wav", "RIFFxxxxWAVE", "no samples");
  expect_problem("a.wav", wav_file(16, "", 0), "no samples");
  expect_problem("a.wav", wav_file(16, two_frames.substr(0, 3), 3),
                 "no samples: one of each channel takes 4 bytes, 3 are there");
  expect_problem("a.wav", "sound", "is no WAV file");
}

/// A MATLAB file with one matrix of two numbers, by its public layout.
std::string matlab_file(const std::string& name, std::uint32_t said) {
  std::string file("MATLAB 5.0 MAT-file");
  file.resize(124, ' ');
  file += std::string("\x00\x01IM", 4);
  const auto element = [](std::uint32_t kind, const std::string& bytes) {
    std::string all(8, '\0');
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(all.data(), &kind, 4);
    std::memcpy(all.data() + 4, &size, 4);
    return all + bytes + std::string((8 - bytes.size() % 8) % 8, '\0');
  };
  const auto bytes = [](auto first, auto second) {
    std::string all(2 * sizeof first, '\0');
    std::memcpy(all.data(), &first, sizeof first);
    std::memcpy(all.data() + sizeof first, &second, sizeof first);
    return all;
  };
  std::string matrix = element(6, bytes(6u, 0u)) + element(5, bytes(said, 1u));
  if (!name.empty()) matrix += element(1, name);
  return file + element(14, matrix + element(9, bytes(1.5, 2.5)));
}

TEST_F(RecordFile, ReadsMatlabFilesOfOtherWriters) {
  const MeasuredRecord record = read_record(file("a.mat", matlab_file("x", 2)), 10.0);
  EXPECT_EQ(record.channels.at(0).name, "x");
  EXPECT_EQ(record.samples(1, 0), 2.5);
  expect_problem("a.mat", matlab_file("x", 2000000000),
                 "x: says to hold 2000000000 values, the file has 2 of them");
  expect_problem("a.mat", matlab_file("", 2), "a.mat");
  const std::string whole = matlab_file("x", 2);
  for (const std::size_t bytes : {whole.size() - 1, whole.size() - 20, std::size_t(131)}) {
    expect_problem("a.mat", whole.substr(0, bytes), "is cut off");
  }
}

// matio fills values that a file does not have from memory that was used before: also in a
// compressed variable they are counted, and what is whole is read.
TEST_F(RecordFile, CountsTheValuesOfMatlabFiles) {
  const auto compressed = [](const std::string& file) {
    constexpr std::size_t head = 128, tag = 8;
    const std::string element = file.substr(head);
    uLongf size = compressBound(element.size());
    std::string bytes(size, '\0');
    compress(reinterpret_cast<Bytef*>(bytes.data()), &size,
             reinterpret_cast<const Bytef*>(element.data()), element.size());
    bytes.resize(size);
    std::string begin(tag, '\0');
    const std::uint32_t kind = 15, length = static_cast<std::uint32_t>(size);
    std::memcpy(begin.data(), &kind, 4);
    std::memcpy(begin.data() + 4, &length, 4);
    return file.substr(0, head) + begin + bytes;
  };
  EXPECT_EQ(read_record(file("a.mat", compressed(matlab_file("x", 2))), 10.0).samples(1, 0), 2.5);
  for (const bool is_compressed : {false, true}) {
    const std::string more = matlab_file("x", 3);
    expect_problem("a.mat", is_compressed ? compressed(more) : more,
                   "x: says to hold 3 values, the file has 2 of them: it is damaged");
  }
  std::string cut = compressed(matlab_file("x", 2));
  cut[cut.size() - 30] ^= 0x55;
  expect_problem("a.mat", cut, "a.mat");
}

// Names and units in cells, as MATLAB has texts, of the channels beside one of times; whole
// numbers.
TEST_F(RecordFile, ReadsCellsAndWholeNumbersOfMatlab) {
  const auto text = [](std::string of) {
    std::size_t size[] = {1, of.size()};
    return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, size, of.data(), 0);
  };
  const auto cells = [&](const char* name, const std::vector<std::string>& texts) {
    std::vector<matvar_t*> all;
    for (const std::string& one : texts) all.push_back(text(one));
    std::size_t size[] = {1, all.size()};
    return MatlabVariable(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, size, all.data(), 0),
                          &Mat_VarFree);
  };
  const auto write_file = [&](const std::vector<std::string>& units) {
    const std::string place = folder / "b.mat";
    std::filesystem::remove(place);
    const MatlabFile mat(Mat_CreateVer(place.c_str(), nullptr, MAT_FT_MAT5), &Mat_Close);
    std::int64_t rate = 1000;
    std::size_t one[] = {1, 1};
    std::vector<MatlabVariable> variables;
    variables.emplace_back(Mat_VarCreate("fs", MAT_C_INT64, MAT_T_INT64, 2, one, &rate, 0),
                           &Mat_VarFree);
    variables.push_back(matlab_numbers("t", {0.0, 0.001, 0.002}, 3, 1));
    variables.push_back(matlab_numbers("data", {1, 2, 3, 4, 5, 6}, 3, 2));
    variables.push_back(cells("channels", {"left", "right"}));
    variables.push_back(cells("units", units));
    for (const MatlabVariable& v : variables) {
      ASSERT_EQ(Mat_VarWrite(mat.get(), v.get(), MAT_COMPRESSION_NONE), 0);
    }
  };
  write_file({"um", "mm"});
  const MeasuredRecord record = read_record(folder / "b.mat");
  EXPECT_EQ(record.rate, 1000.0);
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.channels[1].name, "right");
  EXPECT_EQ(record.channels[1].unit, "m");
  EXPECT_NEAR(record.samples(2, 0), 3e-6, 1e-20);
  EXPECT_NEAR(record.samples(0, 1), 4e-3, 1e-17);
  write_file({"um", "mm", "V", "V"});
  try {
    read_record(folder / "b.mat");
    ADD_FAILURE();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("units: has 4 texts"), std::string::npos)
        << error.what();
  }
}

// Channels in a struct, beside a calibration of other length: their names are those of the fields.
TEST_F(RecordFile, ReadsStructsOfMatlabAndLeavesOtherVectorsOut) {
  std::vector<double> x(20), calibration{1, 2, 3, 4, 5};
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = std::cos(static_cast<double>(j));
  const std::string place = folder / "b.mat";
  {
    const MatlabFile mat(Mat_CreateVer(place.c_str(), nullptr, MAT_FT_MAT5), &Mat_Close);
    const char* fields[] = {"X", "calibration", "fs"};
    std::size_t one[] = {1, 1};
    const MatlabVariable run(Mat_VarCreateStruct("run", 2, one, fields, 3), &Mat_VarFree);
    const auto set = [&](const char* name, const std::vector<double>& values) {
      Mat_VarSetStructFieldByName(run.get(), name, 0,
                                  matlab_numbers(name, values, values.size(), 1).release());
    };
    set("X", x);
    set("calibration", calibration);
    set("fs", {1000.0});
    ASSERT_EQ(Mat_VarWrite(mat.get(), run.get(), MAT_COMPRESSION_NONE), 0);
  }
  const MeasuredRecord record = read_record(place);
  EXPECT_EQ(record.rate, 1000.0);
  ASSERT_EQ(record.channels.size(), 1u);
  EXPECT_EQ(record.channels[0].name, "X");
  EXPECT_EQ(record.samples(7, 0), x[7]);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0],
            "not as long as the 20 samples of the record, and left out: calibration (5)");
}

TEST_F(RecordFile, SaysWhatIsWrongInOtherFiles) {
  expect_problem("a.mat", "MATLAB 5.0 but no more", "a.mat");
  expect_problem("a.docx", "", "expected a record of a measurement");
  EXPECT_THROW(read_record(folder / "missing.csv"), FileError);
  EXPECT_THROW(read_record(file("a.h5", "no HDF5")), FileError);
  const MeasuredRecord odd = example(1000.5);
  EXPECT_THROW(write_record(folder / "a2.wav", odd, Replaces::own_pictures), FileError);
}

TEST(ChannelUnit, KnowsLengthsVoltagesAndGains) {
  EXPECT_EQ(channel_unit("mV").factor, 1e-3);
  EXPECT_EQ(channel_unit("[um]").name, "[um]") << "brackets are the header's";
  EXPECT_NEAR(parse_gain("7.87 V/mm")->value, 7870.0, 1e-9);
  EXPECT_NEAR(parse_gain("-8 mV/um")->value, -8000.0, 1e-9);
  EXPECT_NEAR(parse_gain("200mV/mil")->value, 0.2 / 25.4e-6, 1e-9);
  EXPECT_EQ(parse_gain("-1")->of, ProbeGain::Of::length);
  EXPECT_EQ(parse_gain("0.787 1/mm")->of, ProbeGain::Of::number);
  for (const char* wrong : {"0", "7 V", "V/mm", "7 V/s", "", "0 V/mm"}) {
    EXPECT_FALSE(parse_gain(wrong)) << wrong;
  }
}

}  // namespace whirl::record_file_test

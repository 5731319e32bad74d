// MATLAB files with structs, cells and channels of several lengths, of level 5 and 7.3 alike: a
// channel is called as in MATLAB, and is read at the times that stand beside it there.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "libdata/measured/probe_readings.hpp"
#include "libio/measured/record_file.hpp"
#include "libio/results/matlab_variables.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::matlab_record_test {

using Field = std::pair<const char*, matvar_t*>;

matvar_t* vector(std::vector<double> values) {
  const std::size_t n = values.size();
  return matlab_numbers(nullptr, std::move(values), n, 1).release();
}

/// Samples of a vibration.
matvar_t* wave(std::size_t n, double amplitude = 1.0) {
  std::vector<double> values;
  for (std::size_t j = 0; j < n; ++j) {
    values.push_back(amplitude * std::cos(0.3 * static_cast<double>(j)));
  }
  return vector(values);
}

matvar_t* times(std::size_t n, double step) {
  std::vector<double> values;
  for (std::size_t j = 0; j < n; ++j) values.push_back(step * static_cast<double>(j));
  return vector(values);
}

matvar_t* text(std::string of) {
  std::size_t size[] = {1, of.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, size, of.data(), 0);
}

/// A struct, or with several elements an array of them.
matvar_t* structure(const std::vector<std::vector<Field>>& elements) {
  std::vector<const char*> names;
  for (const Field& field : elements.front()) names.push_back(field.first);
  std::size_t size[] = {1, elements.size()};
  matvar_t* all =
      Mat_VarCreateStruct(nullptr, 2, size, names.data(), static_cast<unsigned>(names.size()));
  for (std::size_t k = 0; k < elements.size(); ++k) {
    for (const Field& field : elements[k]) {
      Mat_VarSetStructFieldByName(all, field.first, k, field.second);
    }
  }
  return all;
}

matvar_t* cells(std::vector<matvar_t*> all) {
  std::size_t size[] = {1, all.size()};
  return Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, size, all.data(), 0);
}

class MatlabRecord : public test::InResultFolder, public testing::WithParamInterface<mat_ft> {
 protected:
  void SetUp() override {
    test::InResultFolder::SetUp();
    const std::string place = folder / "probe.mat";
    const MatlabFile mat(Mat_CreateVer(place.c_str(), nullptr, GetParam()), &Mat_Close);
    if (!mat) GTEST_SKIP() << "matio writes no such files here";
  }
  MeasuredRecord read(const std::vector<Field>& variables, std::optional<double> rate = {}) const {
    const std::string place = folder / "a.mat";
    std::filesystem::remove(place);
    {
      const MatlabFile mat(Mat_CreateVer(place.c_str(), nullptr, GetParam()), &Mat_Close);
      for (const auto& [name, content] : variables) {
        const MatlabVariable v(content, &Mat_VarFree);
        v->name = ::strdup(name);
        EXPECT_EQ(Mat_VarWrite(mat.get(), v.get(), MAT_COMPRESSION_NONE), 0) << name;
      }
    }
    return read_record(place, rate);
  }
  std::string problem(const std::vector<Field>& variables) const {
    try {
      read(variables);
    } catch (const ModelError& error) {
      return describe(error.problems().at(0));
    }
    return "none";
  }
  static ProbeReadings probe(const MeasuredRecord& record, const std::string& channel) {
    return probe_readings(record, {.probes = {{{.name = "p"}, channel}}});
  }
};

INSTANTIATE_TEST_SUITE_P(Levels, MatlabRecord, testing::Values(MAT_FT_MAT5, MAT_FT_MAT73));

TEST_P(MatlabRecord, CallsChannelsAsMatlabDoes) {
  const MeasuredRecord record =
      read({{"fs", vector({1000.0})},
            {"rig", structure({{{"left", structure({{{"x", wave(20, 1)}, {"y", wave(20, 2)}}})},
                                {"right", structure({{{"x", wave(20, 3)}}})}}})},
            {"a", cells({wave(20, 4), structure({{{"b", wave(20, 5)}}}), text("remark")})},
            {"s", structure({{{"c", wave(20, 6)}}, {{"c", wave(20, 7)}}})}});
  EXPECT_EQ(record.rate, 1000.0);
  const auto first = [&](const char* name) {
    const auto at = record.channel(name);
    return at ? record.samples(0, *at) : 0.0;
  };
  EXPECT_EQ(record.channel_list().find("rig.left.y"), std::string::npos) << "y is enough";
  EXPECT_EQ(first("rig.left.x"), 1.0);
  EXPECT_EQ(first("y"), 2.0);
  EXPECT_EQ(first("rig.left.y"), 2.0);
  EXPECT_EQ(first("rig.right.x"), 3.0);
  EXPECT_EQ(first("a{1}"), 4.0);
  EXPECT_EQ(first("a{2}.b"), 5.0);
  EXPECT_EQ(first("b"), 5.0);
  EXPECT_EQ(first("s(2).c"), 7.0);
  EXPECT_FALSE(record.channel("x")) << "of two";
  EXPECT_TRUE(record.notes.empty());
}

// Rates and times of a struct are those of its own channels: the last one in the file was that of
// all.
TEST_P(MatlabRecord, ReadsEachStructAtItsOwnTimes) {
  const std::vector<Field> fast{
      {"X", wave(50)}, {"Y", wave(50)}, {"fs", vector({5000.0})}, {"units", text("um")}};
  const std::vector<Field> slow{{"T", wave(20)}, {"t", times(20, 0.1)}};
  const MeasuredRecord record = read({{"fast", structure({fast})}, {"slow", structure({slow})}});
  EXPECT_EQ(record.rate, 5000.0);
  EXPECT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.channels[0].unit, "m");
  EXPECT_EQ(probe(record, "X").rate, 5000.0);
  EXPECT_NEAR(probe(record, "T").rate, 10.0, 1e-9);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0], "not as long as the 50 samples of the record, and left out: T (20)");
  // a rate that contradicts times beside it
  EXPECT_NE(
      problem({{"a", structure({{{"X", wave(20)}, {"t", times(20, 0.1)}, {"fs", vector({50})}}})}})
          .find("the times say 10 samples per second, another line of the file says 50"),
      std::string::npos);
  EXPECT_NE(problem({{"X", wave(20)}, {"fs", vector({50})}, {"rate", vector({5000})}})
                .find("rate: says 5000 samples per second, another variable beside it 50"),
            std::string::npos);
}

// As MATLAB's timeseries have them, where they are plain structs.
TEST_P(MatlabRecord, NamesDataByTheirStruct) {
  const auto series = [](double amplitude) {
    return structure({{{"Time", times(20, 1e-3)}, {"Data", wave(20, amplitude)}}});
  };
  const MeasuredRecord record = read({{"X", series(1.0)}, {"Y", series(2.0)}});
  EXPECT_NEAR(record.rate, 1000.0, 1e-9);
  const ProbeReadings both =
      probe_readings(record, {.probes = {{{.name = "a"}, "X"}, {{.name = "b"}, "Y"}}});
  EXPECT_NEAR(both.displacement(0, 1), 2e-6, 1e-18);
  // signals of Simulink: times above, labels beside the values
  const MeasuredRecord signals = read(
      {{"out", structure({{{"time", times(20, 1e-3)},
                           {"signals",
                            structure({{{"values", wave(20, 3)}, {"label", text("DE")}},
                                       {{"values", wave(20, 4)}, {"label", text("NDE")}}})}}})}});
  EXPECT_NEAR(signals.rate, 1000.0, 1e-9);
  ASSERT_EQ(signals.channels.size(), 2u);
  EXPECT_EQ(signals.channels[1].name, "NDE");
  EXPECT_EQ(signals.samples(0, 1), 4.0);
}

TEST_P(MatlabRecord, SaysWhatIsNoChannel) {
  std::size_t size[] = {2, 2, 4};
  std::vector<double> values(16, 1.0);
  matvar_t* block = Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 3, size, values.data(), 0);
  const MeasuredRecord record = read(
      {{"X", wave(20)}, {"cube", block}, {"rig", text("RK 2")}, {"serial", vector({4711})}}, 100.0);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0], "left out: cube: it has 3 dimensions");
  const std::string said =
      problem({{"rig", text("RK 2")}, {"list", cells({text("a"), text("b")})}});
  EXPECT_NE(said.find("no vector or matrix of real numbers"), std::string::npos) << said;
  EXPECT_NE(said.find("rig"), std::string::npos) << said;
  EXPECT_NE(said.find("list"), std::string::npos) << said;
}

}  // namespace whirl::matlab_record_test

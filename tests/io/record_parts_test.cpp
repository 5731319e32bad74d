// Channels of several lengths in one file: those that the probes name are read, and every other one
// is told; none is read at the times of another.

#include "libio/measured/record_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libdata/measured/probe_readings.hpp"

namespace whirl::record_parts_test {

RawChannel channel(const std::string& name, std::size_t samples, std::optional<int> clock = {}) {
  RawChannel c{name, "um", {}, {"a.mat"}, clock};
  for (std::size_t j = 0; j < samples; ++j)
    c.samples.push_back(std::cos(0.3 * static_cast<double>(j)));
  return c;
}

MeasurementSetup probes(const std::vector<std::string>& names) {
  MeasurementSetup setup;
  for (const std::string& name : names) setup.probes.push_back({{.name = name}, name});
  return setup;
}

TEST(RecordParts, ReadsTheChannelsThatTheProbesName) {
  RawRecord raw{.file = "a.mat", .rate = 100.0};
  for (const char* name : {"T1", "T2", "T3"}) raw.channels.push_back(channel(name, 20));
  for (const char* name : {"X", "Y"}) raw.channels.push_back(channel(name, 50));
  raw.channels.push_back(channel("calibration", 4));
  const MeasuredRecord record = finished(raw, {});
  EXPECT_EQ(record.channels.size(), 3u) << "most channels";
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0],
            "not as long as the 20 samples of the record, and left out: X (50), Y (50), "
            "calibration (4)");
  const ProbeReadings named = probe_readings(record, probes({"Y", "X"}));
  ASSERT_EQ(named.displacement.rows(), 50);
  EXPECT_NEAR(named.displacement(49, 0), 1e-6 * std::cos(0.3 * 49), 1e-18);
  ASSERT_GE(named.notes.size(), 1u);
  EXPECT_NE(named.notes[0].find("left out: T1 (20), T2 (20), T3 (20), calibration (4)"),
            std::string::npos)
      << named.notes[0];
  try {
    probe_readings(record, probes({"X", "T1"}));
    ADD_FAILURE();
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("\"X\" has 50 samples at 100 per second, other "
                        "channels of the probes 20 at 100"),
              std::string::npos)
        << error.what();
  }
}

// Clocks of their own: each channel at its own rate, and one whose times are wrong does no harm.
TEST(RecordParts, KeepsChannelsOfOtherClocksApart) {
  RawRecord raw{.file = "a.mat"};
  RawClock uneven;
  uneven.times = {.name = "time", .unit = "s"};
  for (int j = 0; j < 30; ++j) uneven.times.samples.push_back(0.01 * j * j);
  raw.clocks = {{.rate = 1000.0, .start = 2.0}, {.rate = 10.0}, uneven};
  raw.channels = {channel("X", 30, 0), channel("Y", 30, 0), channel("T", 30, 1),
                  channel("U", 30, 2)};
  const MeasuredRecord record = finished(raw, {});
  EXPECT_EQ(record.rate, 1000.0);
  EXPECT_EQ(record.start, 2.0);
  EXPECT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.notes.at(0),
            "at other times than the 30 samples of the record, and left out: T (30), U (30)");
  EXPECT_EQ(probe_readings(record, probes({"T"})).rate, 10.0);
  try {
    probe_readings(record, probes({"U"}));
    ADD_FAILURE();
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("\"U\" was left out"), std::string::npos);
  }
}

// Every part names the others: a file of very many does not take the square of their number.
TEST(RecordParts, ReadsSomePartsOfAFileOfVeryMany) {
  RawRecord raw{.file = "a.mat", .rate = 100.0};
  for (std::size_t n = 16; n < 216; ++n) raw.channels.push_back(channel("X", n));
  const MeasuredRecord record = finished(raw, {});
  EXPECT_EQ(record.samples.rows(), 215) << "the longest";
  EXPECT_EQ(record.others.size(), 63u);
  EXPECT_NE(record.notes.at(0).find("and 187 more"), std::string::npos) << record.notes[0];
}

// Times that no channel goes with are those of something else.
TEST(RecordParts, RefusesTimesWithoutSamples) {
  RawRecord raw{.file = "a.mat"};
  raw.channels = {channel("X", 40), channel("Y", 40)};
  RawChannel times{.name = "t", .unit = "s"};
  for (int j = 0; j < 20; ++j) times.samples.push_back(0.001 * j);
  raw.channels.push_back(times);
  try {
    finished(raw, {});
    ADD_FAILURE();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("has 20 times, and no channel has as many samples: X "
                        "has 40"),
              std::string::npos)
        << error.what();
  }
}

// A rate in the header in kHz that is read in Hz would be off by a thousand.
TEST(RecordParts, RefusesARateThatIsNotThatOfTheTimes) {
  RawRecord raw{.file = "a.csv", .rate = 5.0};
  raw.channels = {channel("X", 20)};
  RawChannel times{.name = "t", .unit = "s"};
  for (int j = 0; j < 20; ++j) times.samples.push_back(2e-4 * j);
  raw.channels.push_back(times);
  EXPECT_THROW(finished(raw, {}), ModelError);
  raw.rate = 5000.5;
  EXPECT_EQ(finished(raw, {}).rate, 5000.5) << "it may have more digits";
}

}  // namespace whirl::record_parts_test

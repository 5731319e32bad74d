// Tables as loggers and oscilloscopes write them: times of the day, settings above and beside the
// numbers, statistics below, words for samples that are none. A number that may be off by a factor
// is refused or told.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "libbase/error.hpp"
#include "libio/measured/day_time.hpp"
#include "libio/measured/record_file.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::logger_tables_test {

class LoggerTables : public test::InResultFolder {
 protected:
  MeasuredRecord read(const std::string& text, std::optional<double> rate = {}) const {
    std::ofstream(folder / "a.csv", std::ios::binary) << text;
    return read_record(folder / "a.csv", rate);
  }
  void expect_problem(const std::string& text, const std::string& part) const {
    std::string said = "none";
    try {
      read(text);
    } catch (const ModelError& error) {
      said = describe(error.problems().at(0));
    }
    EXPECT_NE(said.find(part), std::string::npos) << said << "\nexpected " << part;
  }
  static bool has_note(const MeasuredRecord& record, const std::string& part) {
    for (const std::string& note : record.notes) {
      if (note.find(part) != std::string::npos) return true;
    }
    return false;
  }
};

constexpr double digits = 1e-9;  ///< of a rate that follows from times of some digits

/// Lines of a table of 20 samples.
std::string lines(const std::string& head, const std::function<std::string(int)>& line) {
  std::string text = head;
  for (int j = 0; j < 20; ++j) text += line(j) + "\n";
  return text;
}

// ---- times of the day ---------------------------------------------------------------------------

TEST(DayTime, ReadsDatesAndTimes) {
  EXPECT_EQ(day_of("1970-01-02"), 1);
  EXPECT_EQ(day_of("2024/03/01").value() - day_of("2024-02-28").value(), 2);
  EXPECT_FALSE(day_of("2023-02-29"));
  EXPECT_FALSE(day_of("01.05.2024"));
  EXPECT_NEAR(time_of_day("12:03:04.0005").value(), 43384.0005, 1e-11);
  EXPECT_NEAR(time_of_day("2:03:04,5").value(), 7384.5, 1e-11);
  EXPECT_EQ(time_of_day("00:01"), 60.0);
  for (const char* wrong : {"12", "24:00:00", "12:60:00", "12:3:4", "12:03:04.5x", ""}) {
    EXPECT_FALSE(time_of_day(wrong)) << wrong;
  }
  for (const char* noon : {"2024-05-01 12:00:00", "2024-05-01T12:00:00Z", "01.05.2024 12:00:00",
                           "5/1/2024 12:00:00 PM", "12:00:00pm"}) {
    ASSERT_TRUE(stamp_of(noon)) << noon;
    EXPECT_EQ(stamp_of(noon)->time, 43200.0) << noon;
  }
  EXPECT_EQ(stamp_of("12:30:00 AM")->time, 1800.0);
  EXPECT_FALSE(stamp_of("13:30:00 AM"));
  EXPECT_FALSE(stamp_of("2024-05-01"));
  EXPECT_FALSE(stamp_of("1.5"));
  EXPECT_EQ(seconds_between({{}, 86399.0}, {{}, 1.0}), 2.0) << "past midnight";
  EXPECT_EQ(seconds_between({1, 86399.0}, {3, 1.0}), 86402.0);
}

TEST_F(LoggerTables, ReadsTimesOfTheDayPastMidnight) {
  // 23:59:59.9955 and on, half a millisecond apart
  const auto time = [](int j) {
    const double s = 59.9955 + 0.0005 * j;
    return s < 60.0 - 1e-9 ? fmt::format("23:59:{:07.4f}", s)
                           : fmt::format("00:00:{:07.4f}", s - 60.0);
  };
  const auto day = [&](int j) { return time(j)[0] == '2' ? "2024-05-01" : "2024-05-02"; };
  const std::vector<std::pair<std::string, std::function<std::string(int)>>> ways{
      {"Time,x [um]\n", [&](int j) { return fmt::format("{},{}.5", time(j), j % 7); }},
      {"Zeitpunkt;x [um]\n", [&](int j) { return fmt::format("{};{},5", time(j), j % 7); }},
      {"Time,x [um]\n", [&](int j) { return fmt::format("{} {},{}.5", day(j), time(j), j % 7); }},
      {"Time,x [um]\n", [&](int j) { return fmt::format("{}T{},{}.5", day(j), time(j), j % 7); }},
      {"Date,Time,x [um]\n",
       [&](int j) { return fmt::format("{},{},{}.5", day(j), time(j), j % 7); }},
      {"Date Time x [um]\n",
       [&](int j) { return fmt::format("{} {} {}.5", day(j), time(j), j % 7); }},
      {"", [&](int j) { return fmt::format("{},{}.5", time(j), j % 7); }}};
  for (const auto& [head, line] : ways) {
    SCOPED_TRACE(head + line(0));
    const MeasuredRecord record = read(lines(head, line));
    EXPECT_NEAR(record.rate, 2000.0, 2000.0 * digits);
    EXPECT_EQ(record.start, 0.0);
    ASSERT_EQ(record.channels.size(), 1u);
    EXPECT_EQ(record.channels[0].name, head.empty() ? "1" : "x");
    EXPECT_NEAR(record.samples(8, 0), head.empty() ? 1.5 : 1.5e-6, 1e-17);
    EXPECT_TRUE(has_note(record, "and go on past midnight"));
  }
  expect_problem("Date,x\n2024-05-01,1\n2024-05-01,2\n", "Date: found \"2024-05-01\", a date");
  expect_problem("Time,x\n12:00:00.1,1\n0.2,2\n0.3,2\n",
                 "found \"0.2\", expected a date or a time");
  expect_problem("Time,x\n12:00:00,1\n12:00:00,2\n12:00:01,2\n", "with all their digits");
  expect_problem("Time,x\n12:00:01,1\n12:00:00,2\n11:59:59,2\n", "expected times that ascend");
}

// ---- settings -----------------------------------------------------------------------------------

TEST_F(LoggerTables, ReadsRatesAndStepsInTheirUnits) {
  const std::vector<std::pair<std::string, double>> ways{
      {"Sample rate: 5 kHz", 5000.0},
      {"Sampling rate [kHz]: 5", 5000.0},
      {"Sample rate;5;kHz", 5000.0},
      {"# fs = 5000", 5000.0},
      {"Sample Rate (S/s),5000", 5000.0},
      {"Abtastrate: 0,005 MHz", 5000.0},
      {"Sample rate: 5 kS/s", 5000.0},
      {"Sampling frequency = 5e3 samples/s", 5000.0},
      {"Sample Interval: 0.2 ms", 5000.0},
      {"Delta_X\t0.0002", 5000.0},
      {"Delta_X 2e-4", 5000.0},
      {"dt = 200 us", 5000.0},
      {"X Increment,2E-4 s", 5000.0},
      {"Sample interval [ms];0,2", 5000.0}};
  for (const auto& [line, rate] : ways) {
    const MeasuredRecord record = read(line + "\nx [um];y [um]\n1;2\n3;4\n");
    EXPECT_NEAR(record.rate, rate, rate * digits) << line;
    EXPECT_EQ(record.channels.at(1).name, "y") << line;
  }
  EXPECT_EQ(read("Delta_X: 0.2 ms\nX0: 0.5 s\nx;y\n1;2\n3;4\n").start, 0.5);
  EXPECT_TRUE(has_note(read("Delta_X 2e-4\nx;y\n1;2\n3;4\n"), "has no unit: taken as seconds"));
  EXPECT_TRUE(has_note(read("fs = 51.2\nx;y\n1;2\n3;4\n"), "taken as samples per second"));
  EXPECT_TRUE(read("fs = 5000\nx;y\n1;2\n3;4\n").notes.empty());
}

TEST_F(LoggerTables, RefusesRatesThatMayBeOthers) {
  const std::string table = "\nx;y\n1;2\n3;4\n";
  expect_problem("Sample rate: 5" + table,
                 "line 1 says Sample rate 5 without unit, which are so "
                 "many per second, or 5000 in kHz");
  EXPECT_EQ(read("Sample rate: 5" + table, 5000.0).rate, 5000.0) << "--rate says it";
  expect_problem("Sample interval: 0.2" + table, "which are seconds, or 0.0002 s in ms");
  expect_problem("Sample rate: 10,000 Hz" + table, "write 10000 or 10.000");
  expect_problem("Sample rate: 1,234.5" + table, "without marks of thousands");
  expect_problem("Sample rate: 5 kilo" + table, "a.csv:1:1: Sample rate: is in \"kilo\"");
  expect_problem("Sample interval: 5 mV" + table, "expected a unit of time");
  expect_problem("Sample rate: 5 kHz\nSample interval: 0.2 s" + table,
                 "says 5 samples per second, line 1 says 5000");
  // times beside the rate decide, or contradict it
  EXPECT_NEAR(read("Sample rate: 5\nt [s];x\n0;1\n0,0002;2\n0,0004;2\n").rate, 5000.0, 1e-6);
  expect_problem("Sample rate: 50 Hz\nt [s];x\n0;1\n0,0002;2\n0,0004;2\n",
                 "the times say 5000 samples per second, another line of the file says 50");
}

// ---- oscilloscopes ------------------------------------------------------------------------------

TEST_F(LoggerTables, ReadsRigolsTables) {
  for (const char* end : {",,", ",", ""}) {
    const MeasuredRecord record = read(
        lines("X,CH1,CH2,Start,Increment,\nSequence,Volt,mV,-6.000000e-03,2.000000e-04\n",
              [&](int j) { return fmt::format("{},{:.2e},{:.2e}{}", j, 0.1 * j, 5.0 + j, end); }));
    EXPECT_NEAR(record.rate, 5000.0, 5000.0 * digits);
    EXPECT_NEAR(record.start, -6e-3, 1e-15);
    ASSERT_EQ(record.channels.size(), 2u);
    EXPECT_EQ(record.channels[0].name, "CH1");
    EXPECT_EQ(record.channels[0].unit, "V");
    EXPECT_NEAR(record.samples(2, 0), 0.2, 1e-15);
    EXPECT_NEAR(record.samples(2, 1), 7e-3, 1e-15);
    EXPECT_TRUE(record.notes.empty());
  }
  const MeasuredRecord newer = read(lines("CH1V,CH2V,t0 =-5.0e-04, tInc = 2.0e-04,\n", [](int j) {
    return fmt::format("{:.2e},{:.2e},,", 0.1 * j, 5.0 + j);
  }));
  EXPECT_NEAR(newer.rate, 5000.0, 5000.0 * digits);
  EXPECT_NEAR(newer.start, -5e-4, 1e-15);
  EXPECT_EQ(newer.channels.at(1).name, "CH2V");
  const MeasuredRecord plain = read(lines("Time(s),CH1(V),CH2(mV)\n", [](int j) {
    return fmt::format("{:.4e},{:.2e},{:.2e}", 2e-4 * j, 0.1 * j, 5.0 + j);
  }));
  EXPECT_NEAR(plain.rate, 5000.0, 5000.0 * digits);
  EXPECT_EQ(plain.channels.at(0).unit, "V");
  EXPECT_NEAR(plain.samples(2, 1), 7e-3, 1e-15);
}

// Older ones write settings beside the first samples: these count, too.
TEST_F(LoggerTables, ReadsTektronixColumns) {
  const std::vector<std::string> settings{"Record Length,2.000000e+01",
                                          "Sample Interval,2.000000e-04",
                                          "Trigger Point,1.0e+01",
                                          ",",
                                          ",",
                                          ",",
                                          "Source,CH2",
                                          "Vertical Units,mV",
                                          "Vertical Scale,1.0e+00",
                                          "Vertical Offset,0.0e+00",
                                          "Horizontal Units,s",
                                          "Horizontal Scale,5.0e-03"};
  const auto line = [&](int j) {
    const auto k = static_cast<std::size_t>(j);
    return fmt::format("{},,{:.6f},{:.5f},", k < settings.size() ? settings[k] : ",",
                       -2e-3 + 2e-4 * j, 100.0 + j);
  };
  const MeasuredRecord record = read(lines("", line));
  ASSERT_EQ(record.samples.rows(), 20);
  EXPECT_NEAR(record.rate, 5000.0, 5000.0 * digits);
  EXPECT_NEAR(record.start, -2e-3, 1e-12);
  EXPECT_EQ(record.channels.at(0).name, "CH2");
  EXPECT_NEAR(record.samples(0, 0), 0.1, 1e-15) << "in V";
  EXPECT_NEAR(record.samples(19, 0), 0.119, 1e-15);
  std::string other = lines("", line);
  other.replace(other.find("2.000000e-04"), 12, "2.000000e-03");
  expect_problem(other, "the times say 5000 samples per second, another line of the file says 500");
  expect_problem(lines("", line) + "1,2,3\n", "a.csv:21:1: found 3 columns");
}

TEST_F(LoggerTables, ReadsTektronixTablesBelowSettings) {
  const std::string head =
      "Model,MSO2024\nFirmware Version,1.52\n\nPoint Format,Y,\nHorizontal Units,S,\n"
      "Horizontal Scale,4e-06,\nSample Interval,2e-04,\nRecord Length,20,\nGating,0.0% to 100.0%,\n"
      "Probe Attenuation,10,1\nVertical Units,V,mV\nVertical Scale,0.5,0.5\nLabel,,\n"
      "TIME,CH1,CH2\n";
  const auto line = [](int j) { return fmt::format("{:.6e},{},{}", 2e-4 * j, 0.5 * j, j); };
  const MeasuredRecord record = read(lines(head, line));
  EXPECT_NEAR(record.rate, 5000.0, 5000.0 * digits);
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.channels[0].unit, "V");
  EXPECT_NEAR(record.samples(3, 1), 3e-3, 1e-15);
  EXPECT_TRUE(record.notes.empty());
  std::string cut = lines(head, line);
  cut.resize(cut.find("2.000000e-03,"));
  EXPECT_TRUE(has_note(read(cut), "Record Length says 20 samples, 10 are there"));
  const MeasuredRecord keysight = read(lines("x-axis,1\nsecond,Volt\n", [](int j) {
    return fmt::format("{:.6e},{}", 2e-4 * j, 0.5 * j);
  }));
  EXPECT_NEAR(keysight.rate, 5000.0, 5000.0 * digits);
  EXPECT_EQ(keysight.channels.at(0).unit, "V");
}

// ---- below and between the numbers --------------------------------------------------------------

TEST_F(LoggerTables, LeavesOutStatisticsBelowTheNumbers) {
  const std::vector<std::string> ways{
      "Min;-1,5;0\nMax;2;9\nMean;0,1;3\nRMS;1;1\nStd. Dev.;0,5;0,5\n",
      "\nStatistics\nMinimum:;-1,5;0\nPeak to Peak;2;9\n", ";Max;9\n;Min;0\n"};
  for (const std::string& below : ways) {
    const MeasuredRecord record = read(
        lines("t [ms];x;y\n", [](int j) { return fmt::format("{};{},5;{}", j, j, j); }) + below);
    EXPECT_EQ(record.samples.rows(), 20) << below;
    EXPECT_EQ(record.samples(19, 0), 19.5);
  }
  const MeasuredRecord blanks = read(
      lines("t x\n", [](int j) { return fmt::format("0.0{:02} {}", j, j); }) + "Max 0.019 19\n");
  EXPECT_EQ(blanks.samples.rows(), 20);
  // any other word before numbers is none
  expect_problem("t;x\n0;1\n1;2\n2;3\nLast;4\n", "a.csv:5:1: t: found \"Last\"");
}

TEST_F(LoggerTables, TakesWordsOfInstrumentsForMissingSamples) {
  const std::vector<std::string> words{"Over Range", "OVERFLOW", "-Inf", "#N/A", "OL", "+OVER"};
  for (const std::string& word : words) {
    const MeasuredRecord record = read(lines("t [ms];x;y\n", [&](int j) {
      return fmt::format("{};{};{}", j, j == 4 || j == 9 ? word : fmt::format("{},5", j), j);
    }));
    ASSERT_EQ(record.samples.rows(), 20) << word;
    EXPECT_TRUE(std::isnan(record.samples(4, 0)) && std::isnan(record.samples(9, 0)));
    EXPECT_EQ(record.samples(5, 0), 5.5);
    EXPECT_TRUE(
        has_note(record, fmt::format("channel \"x\": 2 cells say \"{}\" instead of a number, "
                                     "the first one in line 6",
                                     word)))
        << word;
  }
  EXPECT_TRUE(read("t;x\n0;1\n1;nan\n2;3\n").notes.empty()) << "the gap itself is told elsewhere";
  expect_problem("t;x\n0;1\n1;2\n2;broken\n3;3\n", "found \"broken\"");
}

}  // namespace whirl::logger_tables_test

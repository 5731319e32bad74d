// LabVIEW measurement files, written here line by line as National Instruments' specification has
// them: channels with their units at their times, segments joined where they follow each other, and
// refused where a number could be off.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "libdata/measured/probe_readings.hpp"
#include "libio/measured/record_file.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::lvm_record_test {

class LvmRecord : public test::InResultFolder {
 protected:
  MeasuredRecord read(const std::string& text, std::optional<double> rate = {}) const {
    std::ofstream(folder / "a.lvm", std::ios::binary) << text;
    return read_record(folder / "a.lvm", rate);
  }
  void expect_problem(const std::string& text, const std::string& part) const {
    try {
      read(text);
      ADD_FAILURE() << "read, expected: " << part;
    } catch (const ModelError& error) {
      const std::string said = describe(error.problems().at(0));
      EXPECT_NE(said.find(part), std::string::npos) << said;
    }
  }
};

constexpr double digits = 1e-12;  ///< numbers are read to all their digits, and scaled once

std::string head(const std::string& x_columns, const std::string& separator = "Tab",
                 const std::string& decimal = ".") {
  const std::string s = separator == "Tab" ? "\t" : ",";
  return "LabVIEW Measurement" + s + "\r\nWriter_Version" + s + "2\r\nReader_Version" + s +
         "2\r\nSeparator" + s + separator + "\r\nDecimal_Separator" + s + decimal +
         "\r\nMulti_Headings" + s + "Yes\r\nX_Columns" + s + x_columns + "\r\nTime_Pref" + s +
         "Relative\r\nOperator" + s + "rig\r\nDate" + s + "2024/05/01\r\nTime" + s +
         "12:03:04.5\r\n***End_of_Header***" + s + "\r\n" + s + "\r\n";
}

/// The header of a segment of two channels and its line of names.
std::string segment(const std::string& x0, const std::string& delta, const std::string& units,
                    const std::string& time = "12:03:04.5") {
  return "Channels\t2\t\t\r\nSamples\t4\t4\t\r\nDate\t2024/05/01\t2024/05/01\t\r\nTime\t" + time +
         "\t" + time + "\t\r\nY_Unit_Label\t" + units + "\t\r\nX_Dimension\tTime\tTime\t\r\nX0\t" +
         x0 + "\t" + x0 + "\t\r\nDelta_X\t" + delta + "\t" + delta +
         "\t\r\n***End_of_Header***\t\t\t\r\nX_Value\tDE x\tDE y\tComment\r\n";
}

TEST_F(LvmRecord, ReadsOneColumnOfTimesAndUnits) {
  const MeasuredRecord record =
      read(head("One") + segment("0.0E+0", "2.000000E-4", "Volts\tmm") +
           "0.000000\t1.5\t0.25\tstarted here\r\n0.000200\t-1.5\t0.5\r\n0.000400\t\tNaN\r\n"
           "0.000600\t3\t1\r\n");
  EXPECT_NEAR(record.rate, 5000.0, 5000.0 * digits);
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.channels[0].name, "DE x");
  EXPECT_EQ(record.channels[0].unit, "V");
  EXPECT_EQ(record.channels[1].unit, "m");
  ASSERT_EQ(record.samples.rows(), 4);
  EXPECT_EQ(record.samples(0, 0), 1.5);
  EXPECT_TRUE(std::isnan(record.samples(2, 0)) && std::isnan(record.samples(2, 1)));
  EXPECT_NEAR(record.samples(3, 1), 1e-3, digits);
}

// Without times the first column is empty; the rate is that of Delta_X. Decimal commas.
TEST_F(LvmRecord, ReadsNoColumnOfTimes) {
  const MeasuredRecord record =
      read(head("No", "Tab", ",") + segment("5,0000000000000000E-1", "3,906250E-5", "um\tum") +
           "\t0,5\t1,25\r\n\t1,5\t2,25\r\n\t\t\r\n\t2,5\t3,25\r\n\r\n");
  EXPECT_NEAR(record.rate, 25600.0, 25600.0 * digits);
  EXPECT_EQ(record.start, 0.5);
  ASSERT_EQ(record.samples.rows(), 4) << "a row of empty cells is one of missing samples";
  EXPECT_NEAR(record.samples(1, 1), 2.25e-6, 1e-6 * digits);
  EXPECT_TRUE(std::isnan(record.samples(2, 0)));
}

TEST_F(LvmRecord, ReadsAColumnOfTimesForEachChannel) {
  const std::string header =
      "Channels,2,,,\nSamples,3,,3,\nDate,2024/05/01,,2024/05/01,\nTime,12:00:00.0,,12:00:00.0,\n"
      "Y_Unit_Label,g,,V,\nX0,0.0E+0,,0.0E+0,\nDelta_X,0.000250,,0.000250,\n"
      "***End_of_Header***,,,,\nX_Value,ax,X_Value,ay,Comment\n";
  const MeasuredRecord record =
      read(head("Multi", "Comma") + header +
           "0.00000,1,0.00000,2\n0.00025,3,0.00025,4\n0.00050,5,0.00050,6\n");
  EXPECT_NEAR(record.rate, 4000.0, 4000.0 * digits);
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.channels[0].unit, "g");
  EXPECT_EQ(record.samples(2, 1), 6.0);
  expect_problem(head("Multi", "Comma") + header + "0.0,1,0.0,2\n0.00025,3,0.00035,4\n",
                 "ay: is at 0.00035, and ax is at 0.00025");
}

/// Four rows of two channels, with times from `first`.
std::string rows(double first, int from) {
  std::string text;
  for (int j = 0; j < 4; ++j) {
    text += fmt::format("{:.6f}\t{}\t{}\r\n", first + 0.001 * j, from + j, -from - j);
  }
  return text + "\r\n";
}

// Segments whose times go on are one record. So are segments whose times begin anew where their
// times of day say that they follow; special blocks between are passed over.
TEST_F(LvmRecord, JoinsSegmentsThatFollowEvenly) {
  const std::string special = "***Start_Special***\t\r\nanything\t1\r\n***End_Special***\t\r\n";
  const MeasuredRecord going_on =
      read(head("One") + segment("0.0E+0", "0.001000", "um\tum") + rows(0.0, 0) + special +
           segment("4.0E-3", "0.001000", "um\tum") + rows(0.004, 4));
  const MeasuredRecord anew =
      read(head("One") + segment("0.0E+0", "0.001000", "um\tum", "12:03:04.998") + rows(0.0, 0) +
           segment("0.0E+0", "0.001000", "um\tum", "12:03:05.002") + rows(0.0, 4));
  const MeasuredRecord without_times =
      read(head("No") + segment("0.0E+0", "0.001000", "um\tum") + "\t0\t0\r\n\t1\t1\r\n" +
           segment("2.0E-3", "0.001000", "um\tum") + "\t2\t2\r\n\t3\t3\r\n");
  ASSERT_EQ(without_times.samples.rows(), 4);
  EXPECT_NEAR(without_times.samples(3, 1), 3e-6, 1e-17);
  for (const MeasuredRecord& record : {going_on, anew}) {
    ASSERT_EQ(record.samples.rows(), 8);
    EXPECT_NEAR(record.rate, 1000.0, 1000.0 * digits);
    for (int j = 0; j < 8; ++j) EXPECT_NEAR(record.samples(j, 0), 1e-6 * j, 1e-17);
  }
}

TEST_F(LvmRecord, RefusesSegmentsThatDoNotFollow) {
  const std::string first = head("One") + segment("0.0E+0", "0.001000", "um\tum") + rows(0.0, 0);
  const std::string hint = "save each segment as a file";
  expect_problem(first + segment("1.0E-2", "0.001000", "um\tum") + rows(0.010, 4),
                 "segment 2 begins at 0.01, expected 0.004");
  expect_problem(first + segment("0.0E+0", "0.001000", "um\tum", "12:03:04.6") + rows(0.0, 4),
                 "segment 2 begins at 0.1 by its date and time, expected 0.004");
  expect_problem(first + segment("4.0E-3", "0.001000", "um\tmm") + rows(0.004, 4),
                 "other channels, units or steps than that of line 14");
  expect_problem(head("One") + segment("0.0E+0", "0.001000", "um\tum"), "a segment has no samples");
}

// Delta_X in the header and the column of times say the same, or nothing is read: one of both is in
// another unit. 1 is what LabVIEW writes for a rate that it does not know.
TEST_F(LvmRecord, RefusesTimesThatContradictEachOther) {
  expect_problem(head("One") + segment("0.0E+0", "1.0", "um\tum") + rows(0.0, 0),
                 "the times say 1000 samples per second, another line of the file says 1");
  const std::string unknown =
      head("No") + segment("0.0E+0", "1.000000", "um\tum") + "\t1\t2\r\n\t3\t4\r\n";
  expect_problem(unknown, "Delta_X is 1, which LabVIEW writes where it does not know the rate");
  EXPECT_EQ(read(unknown, 5000.0).rate, 5000.0);
  // the digits of Delta_X may be few: the column of times has more, and so has --rate
  std::string thirds;
  for (int j = 0; j < 300; ++j) thirds += fmt::format("{:.6f}\t{}\t0\r\n", j / 3000.0, j % 7);
  constexpr double digits_of_times = 1e-6 / 0.1;  // of the last time, over all of them
  EXPECT_NEAR(read(head("One") + segment("0.0E+0", "0.000333", "um\tum") + thirds).rate, 3000.0,
              3000.0 * digits_of_times);
  const std::string rounded =
      head("No") + segment("0.0E+0", "0.000333", "um\tum") + "\t1\t2\r\n\t3\t4\r\n";
  const MeasuredRecord open = read(rounded);
  ASSERT_EQ(open.notes.size(), 1u);
  EXPECT_NE(open.notes[0].find("leave the rate open to 0.15 %"), std::string::npos)
      << open.notes[0];
  EXPECT_EQ(read(rounded, 3000.0).rate, 3000.0);
  EXPECT_THROW(read(rounded, 3100.0), ModelError);
}

// A channel that has other times than the others is told, not read beside them.
TEST_F(LvmRecord, LeavesOutChannelsAtOtherTimes) {
  const std::string text =
      head("One") +
      "Channels\t4\nSamples\t3\t1\t0\t3\nX0\t0\t0\t0\t0.1\nDelta_X\t0.1\t1.0\t0.1\t0.1\n"
      "***End_of_Header***\nX_Value\tx\tflow\tspare\tlate\tComment\n"
      "0.0\t1\t7\t\t5\n0.1\t2\t\t\t6\n0.2\t3\t\t\t7\n";
  const MeasuredRecord record = read(text);
  ASSERT_EQ(record.channels.size(), 1u);
  ASSERT_EQ(record.notes.size(), 3u);
  EXPECT_NE(record.notes[0].find("\"flow\" is left out: its Delta_X is 1.0, that of x is 0.1"),
            std::string::npos);
  EXPECT_NE(record.notes[1].find("Samples is 0"), std::string::npos);
  EXPECT_NE(record.notes[2].find("its X0 is 0.1"), std::string::npos);
  try {
    probe_readings(record, {.probes = {{{.name = "f"}, "flow"}}});
    ADD_FAILURE();
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("was left out: its Delta_X is 1.0"), std::string::npos)
        << error.what();
  }
}

TEST_F(LvmRecord, SaysWhatIsWrong) {
  const std::string good = head("One") + segment("0.0E+0", "0.001000", "um\tum");
  expect_problem("LabVIEW Measurement\t\nX_Columns\tOne\n", "no ***End_of_Header*** follows");
  expect_problem(head("Some"), "a.lvm:7:1: X_Columns is \"Some\", expected No, One or Multi");
  expect_problem(head("One"), "no header of a segment follows");
  expect_problem(head("One") + "Channels\t2\n", "the header of a segment does not end");
  expect_problem(head("One", "Comma", ","), "\",\" separates columns and decimals");
  expect_problem(good + "0.0\t1\t2\n0.001\tthree\t4\n",
                 "a.lvm:25:1: DE x: found \"three\" in column 2, expected a number");
  expect_problem(good + "0.0\t1,5\t2\n0.001\t3\t4\n", "found \"1,5\"");
  expect_problem(good + "0.0\t1\t2\n***Start_Special***\n", "no ***End_Special*** ends it");
  expect_problem(head("One") + "Channels\t3\n***End_of_Header***\nX_Value\ta\tb\n0\t1\t2\n",
                 "says 3 channels, and the line of names has 2");
  std::string frequency = good;
  frequency.replace(frequency.find("X_Dimension\tTime"), 16, "X_Dimension\tFrequency");
  expect_problem(frequency + "0\t1\t2\n1\t2\t3\n", "X_Dimension is Frequency, expected Time");
  // cells that are no reading are missing samples, and told
  const MeasuredRecord over = read(good + "0.0\t1\t2\n0.001\t-Inf\t4\n0.002\tInf\t4\n");
  ASSERT_EQ(over.notes.size(), 1u);
  EXPECT_NE(over.notes[0].find("\"DE x\": 2 cells say \"-Inf\" instead of a number, the first one "
                               "in line 25"),
            std::string::npos)
      << over.notes[0];
}

// LabVIEW writes such files without headers, too: a table of numbers, whose first column is times.
TEST_F(LvmRecord, ReadsTablesWithoutHeader) {
  std::string text;
  for (int j = 0; j < 20; ++j) text += fmt::format("{:.6f}\t{}.5\n", 0.001 * j, j % 3);
  const MeasuredRecord record = read(text);
  EXPECT_NEAR(record.rate, 1000.0, 1e-6);
  ASSERT_EQ(record.channels.size(), 1u);
  EXPECT_EQ(record.samples(2, 0), 2.5);
}

// It is read only.
TEST_F(LvmRecord, IsNotWritten) {
  EXPECT_THROW(require_record_ending(folder / "b.lvm"), ModelError);
  EXPECT_NO_THROW(require_record_ending(folder / "b.uff"));
}

}  // namespace whirl::lvm_record_test

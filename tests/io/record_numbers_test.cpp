// Numbers, columns and units of records that may be read in two ways: what the file itself says
// decides, or both readings are told. None is chosen in silence, as one of them is wrong by a
// thousand or a million.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "libdata/measured/probe_readings.hpp"
#include "libio/measured/record_file.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::record_numbers_test {

class RecordNumbers : public test::InResultFolder {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }
  MeasuredRecord read(const std::string& text, std::optional<double> rate = {}) const {
    return read_record(file("a.csv", text), rate);
  }
  std::string problem(const std::string& text, std::optional<double> rate = {}) const {
    try {
      read(text, rate);
    } catch (const ModelError& error) {
      return describe(error.problems().at(0));
    }
    return "none";
  }
};

/// Lines of a table of 20 samples.
std::string lines(const std::string& head, const std::function<std::string(int)>& line) {
  std::string text = head;
  for (int j = 0; j < 20; ++j) text += line(j) + "\n";
  return text;
}

// "50.000" beside "0,001" is 50 000 or 50: a spreadsheet's marks of thousands made 50 um of 50 nm.
TEST_F(RecordNumbers, TellsBothReadingsOfMarksOfThousands) {
  EXPECT_NE(
      problem("Zeit [s];X [nm]\n0,000;50.000\n0,001;47.553\n")
          .find("a.csv:2:7: X: the point in \"50.000\" may be that of thousands or of decimals, "
                "and other numbers of this table have decimal commas; write 50000 or 50,0"),
      std::string::npos);
  // the evidence may come last
  EXPECT_NE(problem("t [s];X [nm]\n0;50.000\n1;47.553\n2;0,5\n").find("write 50000 or 50,0"),
            std::string::npos);
  EXPECT_NE(problem("t [s];X [nm]\n0;50,000\n1;47,553\n").find("write 50000 or 50.0"),
            std::string::npos);
  EXPECT_NE(problem("t [s];X [nm]\n0.1;50,000\n0.2;47,553\n").find("write 50000 or 50.0"),
            std::string::npos);
  for (const char* number : {"1.234,5", "1,234.5", "1.234.567", "1,234,567", "1'234"}) {
    EXPECT_NE(problem(fmt::format("t [s];X [nm]\n0,1;5\n0,2;6\n0,3;{}\n", number))
                  .find("without marks of thousands"),
              std::string::npos)
        << number;
  }
  // a blank of thousands is none between columns
  EXPECT_NE(problem("t [s]\tX [nm]\n0,1\t50 000\n0,2\t47 553\n").find("\"47 553\""),
            std::string::npos);
}

// Where nothing says what points are they are decimal ones, as in whirl, and that is said.
TEST_F(RecordNumbers, SaysThatPointsAreTakenAsDecimalOnes) {
  const MeasuredRecord record = read("X [V]\tY [V]\n-9.123\t8.250\n-9.250\t8.125\n", 100.0);
  EXPECT_EQ(record.samples(0, 0), -9.123);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_NE(record.notes[0].find("(-9.123)"), std::string::npos) << record.notes[0];
  EXPECT_TRUE(read("X [V]\tY [V]\n-9.123\t8.25\n-9.250\t8.125\n", 100.0).notes.empty());
  EXPECT_TRUE(read("X [V],Y [V]\n-9.123,8.250\n-9.250,8.125\n", 100.0).notes.empty());
}

// Decimal commas that come only after lines of whole numbers are decimal ones all the same.
TEST_F(RecordNumbers, ReadsDecimalCommasBehindWholeNumbers) {
  const MeasuredRecord record = read("Zeit [ms];X [um];Y [um]\n0;0;0\n1;0;0\n2;40,4508;-23,5114\n");
  EXPECT_NEAR(record.rate, 1000.0, 1e-9);
  EXPECT_NEAR(record.samples(2, 0), 40.4508e-6, 1e-20);
  EXPECT_NEAR(record.samples(2, 1), -23.5114e-6, 1e-20);
}

// Commas between whole numbers are those between columns, or of decimals: names of columns tell.
TEST_F(RecordNumbers, RefusesCommasThatMayBeDecimalOnes) {
  EXPECT_NE(
      problem("1,5\n2,25\n", 10.0).find("2 columns of whole numbers, or be decimal ones of 1"),
      std::string::npos);
  EXPECT_NE(problem("x [um]\n1,5\n2,25\n", 10.0).find("names 1 column, and the lines"),
            std::string::npos);
  EXPECT_EQ(read("x,y\n1,5\n2,25\n", 10.0).samples(1, 1), 25.0);
  EXPECT_EQ(read("1,-5\n2,25\n", 10.0).samples(1, 1), 25.0);
  EXPECT_EQ(read("1,5\n2,0.5\n", 10.0).samples(1, 1), 0.5);
}

// Windows-1252, as spreadsheets save tables in Western Europe, and UTF-16 without a mark.
TEST_F(RecordNumbers, ReadsTextInOtherEncodings) {
  const MeasuredRecord record = read("Zeit (s);L\xE4nge (\xB5m)\n0,0;1,5\n0,5;2,5\n");
  EXPECT_EQ(record.channels.at(0).name, "L\u00e4nge");
  EXPECT_NEAR(record.samples(1, 0), 2.5e-6, 1e-20);
  std::string wide;
  for (const char c : std::string("time [s]\tx [um]\n0\t1\n0.5\t2\n")) wide += {c, '\0'};
  EXPECT_NEAR(read(wide).samples(1, 0), 2e-6, 1e-20);
  EXPECT_NE(problem("t;x\n0;1\n1;\x81\n").find("none of UTF-8, UTF-16 and Windows-1252"),
            std::string::npos);
}

// A column of times without a name was a channel of the first probe, and the rotor turned backward.
TEST_F(RecordNumbers, TakesAFirstColumnThatAscendsForTimesOrRefuses) {
  const auto table = [](double step) {
    return lines("", [&](int j) {
      return fmt::format("{:.4f}\t{:.4f}\t{:.4f}", step * j, std::cos(j), std::sin(j));
    });
  };
  for (const auto& rate : {std::optional<double>(), std::optional(1000.0)}) {
    const MeasuredRecord record = read(table(0.001), rate);
    EXPECT_NEAR(record.rate, 1000.0, 1e-9);
    ASSERT_EQ(record.channels.size(), 2u);
    EXPECT_EQ(record.channels[0].name, "1") << "as if there were no times";
    EXPECT_NEAR(record.samples(0, 0), 1.0, 1e-12);
    ASSERT_EQ(record.notes.size(), 1u);
    EXPECT_NE(record.notes[0].find("taken as times in seconds"), std::string::npos);
  }
  // in milliseconds, or numbers of samples
  EXPECT_NE(problem(table(1.0)).find("times in seconds would be far apart"), std::string::npos);
  EXPECT_NE(problem(table(1.0), 1000.0).find("do not fit 1000 samples per second"),
            std::string::npos);
  // a unit of time that ascends is one of times, whatever --rate says
  const std::string named =
      lines("aika [ms];x\n", [](int j) { return fmt::format("{};{}", j, j % 3); });
  EXPECT_EQ(read(named, 1000.0).channels.size(), 1u);
  EXPECT_THROW(read(named, 900.0), ModelError);
}

// Whatever a format calls it: a probe does not read times.
TEST_F(RecordNumbers, NotesAChannelThatOnlyAscendsAndReadingsOfMetres) {
  const MeasuredRecord record =
      read(lines("a,b [m]\n", [](int j) { return fmt::format("{},{}", 0.25 * j, j % 2); }), 100.0);
  const ProbeReadings readings = probe_readings(
      record, {.probes = {{{.name = "x"}, "a", {}, 1e-6, true}, {{.name = "y"}, "b"}}});
  ASSERT_EQ(readings.notes.size(), 2u);
  EXPECT_NE(readings.notes[0].find("channel \"a\" ascends from every sample"), std::string::npos);
  EXPECT_NE(readings.notes[1].find("probe \"y\" reads 1 m"), std::string::npos);
}

// What people write beside and below a table is no sample; a sample that is missing first is one.
TEST_F(RecordNumbers, LeavesOutRemarksAndNotes) {
  for (const char* rows : {"t;x;remark\n0;1,5;started\n1;2,5;\n2;3,5;still on\n",
                           "t;x;remark\n0;1,5;\n1;2,5;\n2;3,5;stopped\n",
                           "t;x\n0;1,5\n1;2,5\n2;3,5\nmeasured by hand;\nat night\n"}) {
    const MeasuredRecord record = read(rows);
    ASSERT_EQ(record.channels.size(), 1u) << rows;
    EXPECT_EQ(record.channels[0].name, "x");
    EXPECT_EQ(record.samples.rows(), 3);
    EXPECT_EQ(record.samples(2, 0), 3.5);
  }
  const MeasuredRecord late = read("t;x;y\n0;1,5;\n1;2,5;4\n2;3,5;5\n");
  ASSERT_EQ(late.channels.size(), 2u);
  EXPECT_TRUE(std::isnan(late.samples(0, 1)));
  EXPECT_EQ(late.samples(2, 1), 5.0);
  EXPECT_NE(problem("t;x\n0;1\n1;2\n2;end 3\n").find("found \"end 3\""), std::string::npos);
}

// A title of as many words as there are columns is none of names, and names with their units are no
// units.
TEST_F(RecordNumbers, TakesNoTitleForNames) {
  const MeasuredRecord record =
      read("Rotor, 3. Mai\nZeit [s];x (DE) [um];y [um]\n0;1,5;2\n0,1;2,5;3\n0,2;3,5;4\n");
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.channels[0].name, "x (DE)");
  EXPECT_EQ(record.channels[0].unit, "m");
}

// ---- universal files ----

/// A dataset 58 of displacements.
std::string dataset_58(int ordinate, const std::string& unit, const std::string& time = "s") {
  return "    -1\n    58\nX\nNONE\n30-Apr-20 19:12:52\nNONE\nNONE\n"
         "    1         0    0         0 NONE              12   2 NONE               0   0\n"
         "         2         2         1  0.00000E+00  5.00000E-03  0.00000E+00\n" +
         fmt::format("        17    0    0    0 Time                 {:20}\n", time) +
         fmt::format("{:10}    0    0    0 x                    {:20}\n", ordinate, unit) +
         "         0    0    0    0 NONE                 NONE                             \n"
         "         0    0    0    0 NONE                 NONE                             \n"
         "  5.00000E+01  4.00000E+01\n    -1\n";
}

// A universal file without unit was read in metres, whatever the probe said: 45 m where 45 um are
// right.
TEST_F(RecordNumbers, LeavesTheUnitOfUniversalFilesWithoutOneToTheProbe) {
  const MeasuredRecord record = read_record(file("a.uff", dataset_58(8, "NONE")));
  EXPECT_EQ(record.channels.at(0).unit, "");
  EXPECT_EQ(record.samples(0, 0), 50.0);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_NE(record.notes[0].find("no unit of the displacements in dataset 1"), std::string::npos);
  const ProbeReadings readings =
      probe_readings(record, {.probes = {{{.name = "x"}, "X", {}, 25.4e-6, true}}});
  EXPECT_NEAR(readings.displacement(0, 0), 50 * 25.4e-6, 1e-15);

  const std::string millimetres =
      "    -1\n   164\n         5mm                          2\n"
      "  1.00000000000000000D+03  1.00000000000000000D+03  1.00000000000000000D+00\n"
      "  2.73149999999999977D+02\n    -1\n";
  const MeasuredRecord said = read_record(file("b.uff", millimetres + dataset_58(8, "NONE")));
  EXPECT_NEAR(said.samples(0, 0), 50e-3, 1e-15);
  EXPECT_TRUE(said.notes.empty());
}

TEST_F(RecordNumbers, TakesNoAccelerationForALengthAndNoUnitOfTimeForSeconds) {
  EXPECT_EQ(read_record(file("a.uff", dataset_58(12, "NONE"))).channels.at(0).unit, "m/s^2");
  EXPECT_EQ(read_record(file("a.uff", dataset_58(11, "NONE"))).channels.at(0).unit, "m/s");
  EXPECT_NEAR(read_record(file("b.uff", dataset_58(8, "um", "msec"))).rate, 2e5, 1e-6);
  EXPECT_THROW(read_record(file("b.uff", dataset_58(8, "um", "ticks"))), ModelError);
}

}  // namespace whirl::record_numbers_test

// TDMS files, written here byte by byte as National Instruments' description of the format has
// them, by code that shares nothing with the reader: every layout gives the same samples, scales
// are applied, and what could be off by a factor is left out or refused.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "libdata/measured/probe_readings.hpp"
#include "libio/measured/record_file.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::tdms_record_test {

constexpr std::uint32_t metadata = 2, new_list = 4, raw_data = 8, interleaved = 32, big = 64,
                        daqmx = 128, all = metadata | new_list | raw_data;
constexpr std::uint32_t none = 0xFFFFFFFF;

/// Bytes in either order.
struct Bytes {
  bool is_big = false;
  std::string text{};

  template <class Number>
  Bytes& add(Number value) {
    std::string one(sizeof value, '\0');
    std::memcpy(one.data(), &value, sizeof value);
    if (is_big) std::reverse(one.begin(), one.end());
    text += one;
    return *this;
  }
  Bytes& add_text(const std::string& value) {
    add(static_cast<std::uint32_t>(value.size()));
    text += value;
    return *this;
  }
};

/// A property of a channel.
struct Property {
  std::string name, text{};
  double number = 0.0;
};

/// An object of a segment: channel, group or file.
struct Object {
  std::string path;
  std::uint32_t type = 10, index = 20;  ///< index: size, 0 as before, none
  std::uint64_t count = 0;
  std::vector<Property> properties{};
};

std::string head_of(const std::vector<Object>& objects, bool is_big = false) {
  Bytes bytes{is_big};
  bytes.add(static_cast<std::uint32_t>(objects.size()));
  for (const Object& object : objects) {
    bytes.add_text(object.path).add(object.index);
    if (object.index != none && object.index != 0) {
      bytes.add(object.type).add(std::uint32_t{1}).add(object.count);
      if (object.type == 0x20) bytes.add(std::uint64_t{4});
    }
    bytes.add(static_cast<std::uint32_t>(object.properties.size()));
    for (const Property& p : object.properties) {
      bytes.add_text(p.name);
      if (p.text.empty()) {
        bytes.add(std::uint32_t{10}).add(p.number);
      } else {
        bytes.add(std::uint32_t{0x20}).add_text(p.text);
      }
    }
  }
  return bytes.text;
}

std::string segment(std::uint32_t contents, const std::string& head, const std::string& raw,
                    std::uint64_t size = 0) {
  std::string bytes = "TDSm" + Bytes{}.add(contents).text;
  Bytes lead{(contents & big) != 0};
  lead.add(std::uint32_t{4713});
  lead.add(size > 0 ? size : std::uint64_t{head.size() + raw.size()});
  lead.add(static_cast<std::uint64_t>(head.size()));
  return bytes + lead.text + head + raw;
}

template <class Number>
std::string samples(std::initializer_list<double> values, bool is_big = false) {
  Bytes bytes{is_big};
  for (const double value : values) bytes.add(static_cast<Number>(value));
  return bytes.text;
}

const std::vector<Property> millisecond{{"wf_increment", "", 1e-3}, {"unit_string", "um"}};

class TdmsRecord : public test::InResultFolder {
 protected:
  MeasuredRecord read(const std::string& bytes, std::optional<double> rate = {}) const {
    std::ofstream(folder / "a.tdms", std::ios::binary) << bytes;
    return read_record(folder / "a.tdms", rate);
  }
  std::string problem(const std::string& bytes) const {
    try {
      read(bytes);
    } catch (const ModelError& error) {
      return describe(error.problems().at(0));
    }
    return "none";
  }
  void expect_problem(const std::string& bytes, const std::string& part) const {
    const std::string said = problem(bytes);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
  /// Whether a record has these samples of its channels x and y [um].
  static void expect_samples(const MeasuredRecord& record, const std::vector<double>& x,
                             const std::vector<double>& y) {
    const auto cx = record.channel("x"), cy = record.channel("y");
    ASSERT_TRUE(cx && cy) << record.channel_list();
    ASSERT_EQ(record.samples.rows(), std::ssize(x));
    EXPECT_NEAR(record.rate, 1000.0, 1e-9);
    for (std::size_t j = 0; j < x.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      EXPECT_NEAR(record.samples(row, *cx), 1e-6 * x[j], 1e-17) << j;
      EXPECT_NEAR(record.samples(row, *cy), 1e-6 * y[j], 1e-17) << j;
    }
  }
};

Object channel(const std::string& name, std::uint64_t count, std::uint32_t type = 10) {
  return {"/'rig'/'" + name + "'", type, 20, count, millisecond};
}

TEST_F(TdmsRecord, ReadsEveryTypeInBothOrdersOfBytes) {
  const std::vector<std::pair<std::uint32_t, std::string (*)(std::initializer_list<double>, bool)>>
      types{{1, samples<std::int8_t>},   {2, samples<std::int16_t>},  {3, samples<std::int32_t>},
            {4, samples<std::int64_t>},  {5, samples<std::uint8_t>},  {6, samples<std::uint16_t>},
            {7, samples<std::uint32_t>}, {8, samples<std::uint64_t>}, {9, samples<float>},
            {10, samples<double>},       {0x19, samples<float>},      {0x1A, samples<double>}};
  for (const auto& [type, write] : types) {
    for (const bool is_big : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {}", type, is_big));
      const std::string head = head_of({channel("x", 3, type), channel("y", 3, type)}, is_big);
      const std::string raw = write({1, 2, 100}, is_big) + write({5, 6, 7}, is_big);
      expect_samples(read(segment(all | (is_big ? big : 0), head, raw)), {1, 2, 100}, {5, 6, 7});
    }
  }
  const std::string negative = segment(all, head_of({channel("x", 1, 2), channel("y", 1, 1)}),
                                       samples<std::int16_t>({-300}) + samples<std::int8_t>({-3}));
  expect_samples(read(negative), {-300}, {-3});
}

// Channels one after the other, or sample by sample; several chunks of one segment; segments that
// have as before, more channels, other numbers, or no metadata at all.
TEST_F(TdmsRecord, ReadsEveryLayout) {
  const std::string head = head_of({channel("x", 2), channel("y", 2)});
  const auto chunk = [](double first) {
    return samples<double>({first, first + 1, 10 * first, 10 * first + 1});
  };
  const std::vector<double> x{1, 2, 3, 4}, y{10, 11, 30, 31};
  expect_samples(read(segment(all, head, chunk(1) + chunk(3))), x, y);
  expect_samples(read(segment(all, head, chunk(1)) + segment(raw_data, "", chunk(3))), x, y);
  const std::string as_before = head_of({{"/'rig'/'x'", 10, 0}, {"/'rig'/'y'", 10, 0}});
  expect_samples(read(segment(all, head, chunk(1)) + segment(all, as_before, chunk(3))), x, y);
  const std::string mixed = samples<double>({1, 10, 2, 11, 3, 30, 4, 31});
  expect_samples(read(segment(all | interleaved, head, mixed)), x, y);
  // the order of the list stays where metadata names one channel alone
  const std::string one = head_of({channel("y", 3)});
  const std::string x_first =
      segment(all, head_of({channel("x", 2), channel("y", 1)}), samples<double>({1, 2, 10})) +
      segment(metadata | raw_data, one, samples<double>({3, 4, 11, 30, 31}));
  expect_samples(read(x_first), x, y);
  // a new list in another order, and a channel of the list without samples
  const std::string other_order =
      segment(all, head, chunk(1)) +
      segment(all, head_of({channel("y", 2), channel("x", 2)}), samples<double>({30, 31, 3, 4}));
  expect_samples(read(other_order), x, y);
  const std::string apart =
      segment(all, head_of({channel("x", 4)}), samples<double>({1, 2, 3, 4})) +
      segment(metadata | raw_data, head_of({{"/'rig'/'x'", 10, none}, channel("y", 4)}),
              samples<double>({10, 11, 30, 31}));
  expect_samples(read(apart), x, y);
  // metadata alone, and objects of the file and a group
  const std::string first =
      segment(metadata | new_list,
              head_of({{"/", 10, none, 0, {{"name", "test"}}}, {"/'rig'", 10, none}}), "");
  expect_samples(read(first + segment(metadata | raw_data, head, chunk(1) + chunk(3))), x, y);
}

// ---- scales -------------------------------------------------------------------------------------

std::vector<Property> scaled(std::vector<Property> more) {
  more.insert(more.end(), millisecond.begin(), millisecond.end());
  return more;
}

/// What three samples 1, 2, 3 are by the properties of their channel, in um; none: it is left out.
TEST_F(TdmsRecord, AppliesScales) {
  const auto sample_2 = [&](std::vector<Property> properties) {
    const Object x{"/'rig'/'x'", 2, 20, 3, scaled(std::move(properties))};
    return read(segment(all, head_of({x}), samples<std::int16_t>({1, 2, 3})));
  };
  const std::vector<Property> linear{{"NI_Scaling_Status", "unscaled"},
                                     {"NI_Number_Of_Scales", "", 1},
                                     {"NI_Scale[0]_Scale_Type", "Linear"},
                                     {"NI_Scale[0]_Linear_Slope", "", 0.25},
                                     {"NI_Scale[0]_Linear_Y_Intercept", "", -3.0}};
  const MeasuredRecord by_line = sample_2(linear);
  EXPECT_NEAR(by_line.samples(1, 0), (0.25 * 2 - 3) * 1e-6, 1e-17);
  EXPECT_TRUE(by_line.notes.empty());

  auto is_scaled = linear;
  is_scaled[0].text = "scaled";
  EXPECT_NEAR(sample_2(is_scaled).samples(1, 0), 2e-6, 1e-17);
  auto is_silent = linear;
  is_silent.erase(is_silent.begin());
  const MeasuredRecord doubtful = sample_2(is_silent);
  EXPECT_NEAR(doubtful.samples(1, 0), -2.5e-6, 1e-17);
  ASSERT_EQ(doubtful.notes.size(), 1u);
  EXPECT_NE(doubtful.notes[0].find("nothing says whether the samples of x are scaled already"),
            std::string::npos);

  const std::vector<Property> polynomial{{"NI_Scaling_Status", "unscaled"},
                                         {"NI_Scale[0]_Scale_Type", "Polynomial"},
                                         {"NI_Scale[0]_Polynomial_Coefficients_Size", "", 3},
                                         {"NI_Scale[0]_Polynomial_Coefficients[0]", "", 1},
                                         {"NI_Scale[0]_Polynomial_Coefficients[1]", "", 10},
                                         {"NI_Scale[0]_Polynomial_Coefficients[2]", "", 100},
                                         {"NI_Scale[0]_Polynomial_Input_Source", "", 4294967295.0}};
  EXPECT_NEAR(sample_2(polynomial).samples(1, 0), 421e-6, 1e-16);
  // the last scale takes what the first one gives
  auto both = polynomial;
  both.insert(both.end(), {{"NI_Scale[1]_Scale_Type", "Linear"},
                           {"NI_Scale[1]_Linear_Slope", "", 2},
                           {"NI_Scale[1]_Linear_Y_Intercept", "", 1},
                           {"NI_Scale[1]_Linear_Input_Source", "", 0}});
  EXPECT_NEAR(sample_2(both).samples(1, 0), 843e-6, 1e-16);
}

// A scale that is no polynomial, or not whole: raw numbers would be off by any factor.
TEST_F(TdmsRecord, LeavesOutChannelsWithOtherScales) {
  const std::vector<std::pair<std::vector<Property>, std::string>> cases{
      {{{"NI_Scale[0]_Scale_Type", "Thermocouple"}}, "NI_Scale[0] is \"Thermocouple\", expected"},
      {{{"NI_Scale[0]_Scale_Type", "Linear"}, {"NI_Scale[0]_Linear_Slope", "", 2}},
       "its scale NI_Scale[0] is not whole"},
      {{{"NI_Number_Of_Scales", "", 2},
        {"NI_Scale[1]_Scale_Type", "Linear"},
        {"NI_Scale[1]_Linear_Slope", "", 2},
        {"NI_Scale[1]_Linear_Y_Intercept", "", 2},
        {"NI_Scale[1]_Linear_Input_Source", "", 0}},
       "its scale NI_Scale[0] is not in the file"},
      {{{"NI_Number_Of_Scales", "", 2},
        {"NI_Scale[1]_Scale_Type", "Linear"},
        {"NI_Scale[1]_Linear_Slope", "", 2},
        {"NI_Scale[1]_Linear_Y_Intercept", "", 2},
        {"NI_Scale[1]_Linear_Input_Source", "", 1}},
       "takes scale 1, expected a scale before it"},
      {{{"NI_Scaling_Status", "half"}, {"NI_Scale[0]_Scale_Type", "Linear"}},
       "its NI_Scaling_Status is \"half\""},
      {{{"NI_Number_Of_Scales", "", 1e9}}, "scales"},
      {{{"NI_UnitDescription", "mm"}}, "its unit_string is \"um\", its NI_UnitDescription \"mm\""}};
  for (const auto& [properties, why] : cases) {
    const Object x{"/'rig'/'x'", 2, 20, 1, scaled(properties)};
    const MeasuredRecord record =
        read(segment(all, head_of({x, channel("y", 1, 2)}), samples<std::int16_t>({1, 2})));
    ASSERT_EQ(record.channels.size(), 1u) << why;
    EXPECT_EQ(record.channels[0].name, "y");
    ASSERT_EQ(record.notes.size(), 1u);
    EXPECT_NE(record.notes[0].find(why), std::string::npos) << record.notes[0];
    for (const char* name : {"x", "rig/x"}) {
      try {
        probe_readings(record, {.probes = {{{.name = "p"}, name}}});
        ADD_FAILURE();
      } catch (const OptionError& error) {
        EXPECT_NE(std::string(error.what()).find("was left out: "), std::string::npos);
      }
    }
  }
  expect_problem(segment(all, head_of({{"/'rig'/'x'", 2, 20, 1, scaled(cases[0].first)}}),
                         samples<std::int16_t>({1})),
                 "has no channel that can be read: x: its scale");
}

// ---- names and times ----------------------------------------------------------------------------

TEST_F(TdmsRecord, NamesChannelsByTheirGroupsWhereThatIsNeeded) {
  Object first = channel("x", 1), second = channel("x", 1), third = channel("it''s", 1);
  second.path = "/'other'/'x'";
  const MeasuredRecord record =
      read(segment(all, head_of({first, second, third}), samples<double>({1, 2, 3})));
  ASSERT_EQ(record.channels.size(), 3u);
  EXPECT_EQ(record.channels[0].name, "rig/x");
  EXPECT_EQ(record.channels[1].name, "other/x");
  EXPECT_EQ(record.channels[2].name, "it's");
  EXPECT_EQ(record.channel("rig/it's"), 2) << "where the name alone would do, too";
  EXPECT_FALSE(record.channel("x"));
}

// Channels of other rates are others; a start offset and times of start move a channel.
TEST_F(TdmsRecord, KeepsRatesAndStartsApart) {
  const auto at = [](const std::string& name, double step, double start, std::uint64_t count) {
    return Object{"/'rig'/'" + name + "'",
                  1,
                  20,
                  count,
                  {{"wf_increment", "", step}, {"wf_start_offset", "", start}}};
  };
  const std::string raw = samples<std::int8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  const MeasuredRecord record = read(segment(
      all, head_of({at("x", 1e-3, 0.5, 4), at("y", 1e-3, 0.5, 4), at("z", 1e-3, 0.6, 4)}), raw));
  EXPECT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.start, 0.5);
  ASSERT_EQ(record.others.size(), 0u) << "of four samples";
  EXPECT_NE(record.notes.at(0).find("at other times than the 4 samples of the record"),
            std::string::npos);
  Object unknown = at("x", 1.0, 0.0, 2);
  const std::string one = segment(all, head_of({unknown}), samples<std::int8_t>({1, 2}));
  expect_problem(one, "wf_increment is 1, which LabVIEW writes where it does not know the rate");
  EXPECT_EQ(read(one, 500.0).rate, 500.0);
  unknown.properties[0].number = -1.0;
  expect_problem(segment(all, head_of({unknown}), samples<std::int8_t>({1, 2})),
                 "its wf_increment is -1");
  unknown.properties = {{"wf_increment", "", 2.0}, {"wf_xunit_string", "Hz"}};
  expect_problem(segment(all, head_of({unknown}), samples<std::int8_t>({1, 2})),
                 "its samples are in steps of \"Hz\", expected steps of time");
  // steps below the rounding of the start
  expect_problem(segment(all, head_of({at("x", 5e-23, 0.5, 2)}), samples<std::int8_t>({1, 2})),
                 "times of neighbors are the same number");
  // milliseconds
  unknown.properties = {{"wf_increment", "", 2.0}, {"wf_xunit_string", "ms"}};
  EXPECT_NEAR(read(segment(all, head_of({unknown}), samples<std::int8_t>({1, 2}))).rate, 500.0,
              1e-9);
}

std::string stamps(std::initializer_list<double> seconds, bool is_big) {
  Bytes bytes{is_big};
  for (const double s : seconds) {
    const auto part = static_cast<std::uint64_t>(std::ldexp(s - std::floor(s), 64));
    const std::int64_t whole = 3'800'000'000 + static_cast<std::int64_t>(std::floor(s));
    is_big ? bytes.add(whole).add(part) : bytes.add(part).add(whole);
  }
  return bytes.text;
}

// Without wf_increment a channel of time stamps says the times of the others.
TEST_F(TdmsRecord, TakesTimeStampsForTimes) {
  for (const bool is_big : {false, true}) {
    const std::vector<Property> unit{{"unit_string", "um"}};
    const std::string head = head_of({{"/'rig'/'when'", 0x44, 20, 3},
                                      {"/'rig'/'x'", 10, 20, 3, unit},
                                      {"/'rig'/'y'", 10, 20, 3, unit}},
                                     is_big);
    const std::string raw =
        stamps({0.999, 1.0, 1.001}, is_big) + samples<double>({1, 2, 3, 4, 5, 6}, is_big);
    expect_samples(read(segment(all | (is_big ? big : 0), head, raw)), {1, 2, 3}, {4, 5, 6});
  }
  // beside channels that say their rate themselves they are none
  const std::string head =
      head_of({{"/'rig'/'when'", 0x44, 20, 2}, channel("x", 2), channel("y", 2)});
  expect_samples(read(segment(all, head, stamps({0, 1}, false) + samples<double>({1, 2, 4, 5}))),
                 {1, 2}, {4, 5});
  expect_problem(segment(all, head_of({{"/'rig'/'x'", 10, 20, 2}}), samples<double>({1, 2})),
                 "no channel has a wf_increment; --rate says it, too");
}

// ---- what is not whole --------------------------------------------------------------------------

TEST_F(TdmsRecord, ReadsWhatAKilledRunLeft) {
  const std::string head = head_of({channel("x", 2), channel("y", 2)});
  const std::string good = segment(all, head, samples<double>({1, 2, 10, 11}));
  const std::string rest = samples<double>({3, 4, 30, 31, 5, 6});
  const auto expect_killed = [&](const std::string& bytes, const std::vector<double>& x,
                                 const std::vector<double>& y, const std::string& note) {
    const MeasuredRecord record = read(bytes);
    expect_samples(record, x, y);
    ASSERT_EQ(record.notes.size(), 1u);
    EXPECT_NE(record.notes[0].find("segment 2 is not whole"), std::string::npos);
    EXPECT_NE(record.notes[0].find(note), std::string::npos) << record.notes[0];
  };
  const std::vector<double> x{1, 2}, y{10, 11}, longer_x{1, 2, 3, 4}, longer_y{10, 11, 30, 31};
  // the size of the last segment was never written
  expect_killed(good + segment(raw_data, "", rest, ~std::uint64_t{0}), longer_x, longer_y,
                "its last 16 bytes, which are no whole sample of each channel, are left out");
  expect_killed(good + segment(raw_data, "", rest.substr(0, 32), ~std::uint64_t{0}), longer_x,
                longer_y, "as far as they are there");
  // or the file is shorter than it says
  expect_killed(good + segment(raw_data, "", rest, 4096), longer_x, longer_y, "16 bytes");
  expect_killed(good + segment(all, head, "").substr(0, 40), x, y, "its metadata is cut off");
  expect_killed(good + "TDSm\x0e", x, y, "its 5 bytes are left out");
  // samples that all channels have: one and a half of y
  expect_killed(good + segment(raw_data, "", rest.substr(0, 28), ~std::uint64_t{0}), {1, 2, 3},
                {10, 11, 30}, "its last 12 bytes");
  expect_killed(good + segment(raw_data | interleaved, "", rest.substr(0, 20), ~std::uint64_t{0}),
                {1, 2, 3}, {10, 11, 4}, "its last 4 bytes");
}

TEST_F(TdmsRecord, SaysWhatIsWrong) {
  const std::string head = head_of({channel("x", 2), channel("y", 2)});
  const std::string good = segment(all, head, samples<double>({1, 2, 10, 11}));
  expect_problem("sound", "is no TDMS file: expected TDSm");
  expect_problem("TDSm", "segment 1, at byte 0: is cut off");
  expect_problem(good + std::string(40, 'x'), "expected TDSm at its begin: the file is damaged");
  expect_problem(segment(all | daqmx, head, samples<double>({1, 2, 10, 11})),
                 "has raw data as DAQmx logs them");
  expect_problem(segment(all, head_of({{"/'rig'/'x'", 10, 0x1269, 2}}), ""), "as DAQmx logs them");
  expect_problem(segment(all, head, samples<double>({1, 2, 10})) + good,
                 "which are no whole number of samples of its channels");
  expect_problem(segment(raw_data, "", "12345678"), "no object says of which channel");
  expect_problem(segment(all, head_of({{"/'rig'/'x'", 10, 0}}), ""), "there were none before");
  expect_problem(segment(all, head_of({{"x", 10, 20, 1}}), "12345678"), "expected one such as");
  expect_problem(segment(all, head_of({{"/'a'/'b'/'c'", 10, 20, 1}}), "12345678"), "such as");
  expect_problem(segment(all, head_of({{"/'rig'/'x'", 0x55, 20, 1}}), "12345678"), "of type 0x55");
  expect_problem(segment(all, head_of({{"/'rig'/'x'", 10, 24, 1}}), "12345678"),
                 "a raw data index of 24 bytes");
  // counts are those of the file's bytes, whatever it says
  const std::uint64_t many = ~std::uint64_t{0} / 2;
  expect_problem(segment(all, head_of({channel("x", many)}), samples<double>({1, 2})) + good,
                 "no whole number");
  std::string objects = head;
  objects[3] = '\x7f';
  expect_problem(segment(all, objects, ""), "its metadata is cut off");
  EXPECT_THROW(read(""), ModelError);
}

TEST_F(TdmsRecord, LeavesOutTextsAndChannelsThatChange) {
  Object text{"/'rig'/'remark'", 0x20, 28, 1};
  const MeasuredRecord record =
      read(segment(all, head_of({channel("x", 1), text, channel("y", 1)}),
                   samples<double>({1}) + "\x01" + std::string(3, '\0') + samples<double>({2})));
  expect_samples(record, {1}, {2});
  EXPECT_NE(record.notes.at(0).find("left out: rig/remark: its samples are texts"),
            std::string::npos);
  Object changed = channel("x", 1);
  changed.properties[0].number = 1e-4;
  expect_problem(segment(all, head_of({channel("x", 1)}), samples<double>({1})) +
                     segment(all, head_of({changed}), samples<double>({1})),
                 "its wf_increment changes within the file");
}

}  // namespace whirl::tdms_record_test

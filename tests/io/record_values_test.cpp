// What options say about records of measurements.

#include "libio/measured/record_values.hpp"

#include <gtest/gtest.h>

namespace whirl::record_values_test {

TEST(RecordValues, AShareOfASignalIsAPercentageOrANumber) {
  for (const char* text : {"1%", "0.01", "1e0%"}) EXPECT_EQ(*parse_noise_share(text), 0.01) << text;
  EXPECT_EQ(*parse_noise_share("0"), 0.0);
  for (const char* text : {"", "%", "-1%", "x%", "2um", "1%%"}) {
    EXPECT_EQ(parse_noise_share(text).problem, "expected a share of the signal, such as 1% or 0.01")
        << text;
  }
}

TEST(RecordValues, NoiseOfProbesIsALengthOrAPercentage) {
  const auto share = parse_probe_noise("1%"), length = parse_probe_noise("2um");
  EXPECT_TRUE(share->is_relative);
  EXPECT_EQ(share->value, 0.01);
  EXPECT_FALSE(length->is_relative);
  EXPECT_DOUBLE_EQ(length->value, 2e-6);
  for (const char* text : {"", "%", "0%", "-2um", "2um%", "1kg"}) {
    EXPECT_EQ(parse_probe_noise(text).problem,
              "expected a length such as 2um, or a share such as 1%")
        << text;
  }
}

TEST(RecordValues, SamplingRatesAreNumbersOrFrequencies) {
  EXPECT_EQ(*parse_sampling_rate("5000"), 5000.0);
  EXPECT_DOUBLE_EQ(*parse_sampling_rate("5 kHz"), 5000.0);
  EXPECT_FALSE(parse_sampling_rate("0"));
  EXPECT_FALSE(parse_sampling_rate("5 m"));
}

TEST(RecordValues, OrdersStandOnceEach) {
  EXPECT_EQ(*parse_orders("1,2,1,0.5"), (std::vector<double>{1.0, 2.0, 0.5}));
  EXPECT_FALSE(parse_orders("1,0"));
  EXPECT_FALSE(parse_orders(""));
}

}  // namespace whirl::record_values_test

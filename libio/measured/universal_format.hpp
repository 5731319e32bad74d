#pragma once
/// What reading and writing universal files have in common.

#include <string_view>

namespace whirl::inline io::universal {

constexpr std::string_view universal_record_head = "    -1\n   164\n         1whirl: SI (m, N)";
constexpr std::string_view block_mark = "    -1";
/// Begins the second line of datasets that this program writes, which says the rate: steps of time
/// have only six digits in the format.
constexpr std::string_view rate_mark = "sample rate [Hz]: ";
constexpr double step_digits = 1e-5;  ///< relative error of a rate that a step of time says

/// Numbers of the format.
struct RecordCode {
  static constexpr long real_single = 2, real_double = 4, complex_single = 5, complex_double = 6;
  static constexpr long general = 0, time_response = 1;                 // kinds of functions
  static constexpr long any_quantity = 1, displacement = 8, time = 17;  // of axes; 0 is unknown
  static constexpr long velocity = 11, acceleration = 12;
  static constexpr long reaction_force = 9, excitation_force = 13, frequency = 18;
  static constexpr long frequency_response = 4;  // a kind of function
  static constexpr long little_endian = 1, ieee = 2;
};

}  // namespace whirl::inline io::universal

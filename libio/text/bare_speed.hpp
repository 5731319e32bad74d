#pragma once
/// A speed without a unit: 3000 is 28 648 rpm, which few mean.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace whirl::inline io {

/// A speed that was given as a bare number.
struct BareSpeed {
  std::string option;    ///< "--speed", "--over operation.speed="
  std::string value;     ///< "3000", "0:8000:50"
  std::string readings;  ///< "3000 rad/s = 28 648 rpm"

  /// "speed: 3000 rad/s = 28 648 rpm (no unit given; for revolutions per minute write 3000rpm)".
  std::string reading() const;
  /// A sentence that names the option.
  std::string warning() const;
};

/// Whether a value, a range or a list of values is of bare numbers.
bool is_bare(std::string_view text);

/// What was given by an option, if it is a bare speed. Zero is none, as it is the same in every
/// unit, nor is what is no number, which its reader tells.
std::optional<BareSpeed> bare_speed(const std::string& option, const std::string& value);

/// Where a command line gives speeds; empty: not there.
struct SpeedOptions {
  std::string speed{};              ///< --speed
  std::vector<std::string> sets{};  ///< --set, without what --speed sets
  std::string speeds{};             ///< --speeds
  std::vector<std::string> over{};  ///< --over
  std::string at{};                 ///< --at, along the only --over
  /// Further options that are a speed each: name with dashes, value.
  std::vector<std::pair<std::string, std::string>> others{};
};

/// The bare speeds among these options; of options with a path, only those of operation.speed.
std::vector<BareSpeed> bare_speeds(const SpeedOptions& given);

}  // namespace whirl::inline io

#pragma once
/// Dates and times of the day, as loggers write them.

#include <optional>
#include <string_view>

namespace whirl::inline io {

constexpr double seconds_of_a_day = 86400.0;

/// Days since 1970-01-01 of "2024-05-01" or "2024/05/01"; nothing: the text is no such date. Other
/// orders of day, month and year cannot be told apart.
std::optional<long> day_of(std::string_view text);

/// Seconds since midnight of "12:03:04.0005", "12:03:04,5", "12:03:04" or "12:03" [s]; nothing: the
/// text is no such time.
std::optional<double> time_of_day(std::string_view text);

/// What a stamp says.
struct Stamp {
  std::optional<long> day{};  ///< since 1970-01-01; none: of the time alone
  double time = 0.0;          ///< since midnight [s]
};

/// Seconds from one stamp to another [s]; of stamps without a day within half a day.
double seconds_between(const Stamp& from, const Stamp& to);

/// The stamp "2024-05-01 12:03:04.0005", "2024-05-01T12:03:04Z" or a time of the day alone;
/// nothing: the text is none.
std::optional<Stamp> stamp_of(std::string_view text);

}  // namespace whirl::inline io

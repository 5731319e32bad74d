#include "libio/measured/day_time.hpp"

#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <string>

namespace whirl::inline io {

namespace {

/// Takes a whole number of so many digits off a text.
std::optional<int> take_digits(std::string_view& text, std::size_t fewest, std::size_t most) {
  std::size_t count = 0;
  int value = 0;
  while (count < text.size() && count < most && text[count] >= '0' && text[count] <= '9') {
    value = 10 * value + (text[count] - '0');
    ++count;
  }
  if (count < fewest) return std::nullopt;
  text.remove_prefix(count);
  return value;
}

bool take_sign(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// Takes ".0005" off a text; 0 where nothing of that kind stands there.
double take_fraction(std::string_view& text) {
  std::string_view digits = text;
  if (!take_sign(digits, ".,")) return 0.0;
  std::size_t count = 0;
  while (count < digits.size() && digits[count] >= '0' && digits[count] <= '9') ++count;
  if (count == 0) return 0.0;
  const std::string number = "0." + std::string(digits.substr(0, count));
  double value = 0.0;
  std::from_chars(number.data(), number.data() + number.size(), value);
  text = digits.substr(count);
  return value;
}

std::optional<long> take_day(std::string_view& text) {
  std::string_view rest = text;
  const auto year = take_digits(rest, 4, 4);
  const bool has_first = year && take_sign(rest, "-/");
  const auto month = has_first ? take_digits(rest, 1, 2) : std::nullopt;
  const bool has_second = month && take_sign(rest, "-/");
  const auto day = has_second ? take_digits(rest, 1, 2) : std::nullopt;
  if (!day) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  text = rest;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// Takes a date off a text whose day, month and year stand in another order, such as 5/1/2024 and
/// 01.05.24.
bool take_other_day(std::string_view& text) {
  std::string_view rest = text;
  for (int part = 0; part < 3; ++part) {
    if (part > 0 && !take_sign(rest, "./-")) return false;
    if (!take_digits(rest, 1, part < 2 ? 2 : 4)) return false;
  }
  text = rest;
  return true;
}

/// 'a' or 'p' of " AM", "pm"; nothing: the text is no such word.
std::optional<char> half_of_day(std::string_view text) {
  while (take_sign(text, " ")) {
  }
  if (text.size() != 2) return std::nullopt;
  const auto half = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  const bool is_half = (half == 'a' || half == 'p') && (text[1] == 'm' || text[1] == 'M');
  return is_half ? std::optional(half) : std::nullopt;
}

std::optional<double> take_time(std::string_view& text) {
  constexpr double minute = 60.0, hour = 3600.0;
  std::string_view rest = text;
  const auto hours = take_digits(rest, 1, 2);
  const bool has_first = hours && *hours < 24 && take_sign(rest, ":");
  const auto minutes = has_first ? take_digits(rest, 2, 2) : std::nullopt;
  if (!minutes || *minutes > 59) return std::nullopt;
  double seconds = 0.0;
  if (take_sign(rest, ":")) {
    const auto whole = take_digits(rest, 2, 2);
    if (!whole || *whole > 60) return std::nullopt;  // 60: a leap second
    seconds = *whole + take_fraction(rest);
  }
  text = rest;
  return hour * *hours + minute * *minutes + seconds;
}

}  // namespace

std::optional<long> day_of(std::string_view text) {
  const auto day = take_day(text);
  return text.empty() ? day : std::nullopt;
}

std::optional<double> time_of_day(std::string_view text) {
  const auto time = take_time(text);
  return text.empty() ? time : std::nullopt;
}

double seconds_between(const Stamp& from, const Stamp& to) {
  const double seconds = to.time - from.time;
  if (from.day && to.day)
    return static_cast<double>(*to.day - *from.day) * seconds_of_a_day + seconds;
  return seconds - seconds_of_a_day * std::round(seconds / seconds_of_a_day);
}

std::optional<Stamp> stamp_of(std::string_view text) {
  Stamp stamp;
  stamp.day = take_day(text);
  const bool has_day = stamp.day || take_other_day(text);
  if (has_day && !take_sign(text, " T_")) return std::nullopt;
  while (take_sign(text, " ")) {
  }
  auto time = take_time(text);
  if (!time) return std::nullopt;
  if (const auto half = half_of_day(text)) {
    constexpr double hour = 3600.0, noon = 12.0 * hour;
    if (!(*time < noon + hour)) return std::nullopt;
    *time = std::fmod(*time, noon) + (*half == 'p' ? noon : 0.0);
    text = {};
  }
  stamp.time = *time;
  if (has_day) take_sign(text, "Z");
  if (!text.empty()) return std::nullopt;
  return stamp;
}

}  // namespace whirl::inline io

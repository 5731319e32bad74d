#include "libio/text/vendor_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

using Spelling = std::pair<std::string_view, std::string_view>;

/// Whole units, in lower case.
constexpr Spelling wholes[] = {
    {"rpm", "rpm"},       {"cpm", "rpm"},      {"r/min", "rpm"},    {"1/min", "rpm"},
    {"min^-1", "rpm"},    {"min-1", "rpm"},    {"u/min", "rpm"},    {"rev/min", "rpm"},
    {"hz", "Hz"},         {"tr/min", "rpm"},   {"giri/min", "rpm"}, {"rot/min", "rpm"},
    {"degrees", "deg"},   {"cps", "Hz"},       {"rps", "Hz"},       {"rev/s", "Hz"},
    {"rad/sec", "rad/s"}, {"rads/s", "rad/s"}, {"rad/s", "rad/s"}};

/// Words of units, in lower case.
constexpr Spelling words[] = {
    {"lb", "lbf"},    {"lbs", "lbf"},    {"lbf", "lbf"},   {"klb", "klbf"},  {"klbs", "klbf"},
    {"klbf", "klbf"}, {"kip", "klbf"},   {"kips", "klbf"}, {"sec", "s"},     {"secs", "s"},
    {"in", "in"},     {"ft", "ft"},      {"mm", "mm"},     {"mils", "mil"},  {"inch", "in"},
    {"inches", "in"}, {"ns", "N.s"},     {"nm", "N.m"},    {"nms", "N.m.s"}, {"kns", "kN.s"},
    {"knm", "kN.m"},  {"msec", "ms"},    {"msecs", "ms"},  {"second", "s"},  {"seconds", "s"},
    {"micron", "um"}, {"microns", "um"}, {"kgm", "kg.m"},  {"gmm", "g.mm"}};

/// Pounds as masses, in lower case.
constexpr Spelling masses[] = {{"lb", "lb"}, {"lbs", "lb"}, {"lbm", "lb"}};

bool is_latin_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

/// What stands beside a spelling in a list; none: nothing does.
template <std::size_t N>
std::optional<std::string> meant_by(const std::string& text, const Spelling (&list)[N]) {
  for (const auto& [written, meant] : list) {
    if (text == written) return std::string(meant);
  }
  return std::nullopt;
}

/// Without the brackets of a product that divides: "N/(m/s)" is "N/m.s", as "/" divides by the next
/// factor alone.
std::string without_brackets(std::string_view text) {
  std::string result;
  bool is_inside = false;
  for (const char c : text) {
    const bool begins = c == '(' && !is_inside && result.ends_with('/');
    const bool ends = c == ')' && is_inside;
    if (begins || ends) {
      is_inside = begins;
    } else if (is_inside && c == '/') {
      result += '.';
    } else if (is_inside && (c == '.' || c == '*' || c == '-')) {
      result += '/';
    } else {
      result += c;
    }
  }
  return is_inside ? std::string(text) : result;
}

/// A vendor's unit in the spelling of parse_as: words replaced, "-" between words a product.
/// @param has_masses  pounds are masses, not forces
std::string respelled(std::string_view text, bool has_masses) {
  if (const auto whole = meant_by(lower_case(text), wholes)) return *whole;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_latin_letter(text[end])) ++end;
    if (end > i) {
      const std::string word(text.substr(i, end - i));
      const auto mass = has_masses ? meant_by(lower_case(word), masses) : std::nullopt;
      result += mass ? *mass : meant_by(lower_case(word), words).value_or(word);
      i = end;
      continue;
    }
    const bool joins =
        text[i] == '-' && i > 0 && i + 1 < text.size() && is_latin_letter(text[i + 1]);
    result += joins ? '.' : text[i];
    ++i;
  }
  return result;
}

}  // namespace

Parsed<std::string> unit_in_table(std::string_view text, std::string_view si_unit) {
  using Result = Parsed<std::string>;
  const auto as_written = parse_as(fmt::format("1 {}", text), si_unit);
  if (as_written) return std::string(text);
  const std::string plain = without_brackets(text);
  for (const bool has_masses : {false, true}) {
    const std::string meant = respelled(plain, has_masses);
    if (parse_as("1 " + meant, si_unit)) return meant;
  }
  return Result::failed(as_written.problem);
}

std::string vendor_hint(const std::string& quantity, std::string_view si_unit) {
  char* rest = nullptr;
  std::strtod(quantity.c_str(), &rest);
  const std::string number = quantity.substr(0, static_cast<std::size_t>(rest - quantity.c_str()));
  const std::string unit(rest + std::strspn(rest, " "));
  if (number.empty() || unit.empty()) return "";
  const Parsed<std::string> meant = unit_in_table(unit, si_unit);
  if (!meant || *meant == unit) return "";
  return fmt::format("; did you mean \"{} {}\"?", number, *meant);
}

}  // namespace whirl::inline io

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libio/model/model_schema.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// Spelling of a number in a range; the signs of zero are let through.
std::string number_pattern(Range range) {
  const std::string exponent = R"((?:[eE][-+]?\d+)?)";
  const std::string unsigned_number = R"((?:\d+\.?\d*|\.\d+))";
  switch (range) {
    case Range::positive:
      return R"(\+?(?:\d*[1-9]\d*\.?\d*|\d*\.\d*[1-9]\d*))" + exponent;
    case Range::nonnegative:
      return R"(\+?)" + unsigned_number + exponent;
    case Range::any:
      break;
  }
  return "(?:[-+]|\u2212)?" + unsigned_number + exponent;
}

/// Spelling of a unit: a symbol of the right dimension, or anything made of several factors.
std::string unit_pattern(const std::string& unit) {
  std::vector<std::string> symbols;
  for (const std::string& symbol : unit_symbols()) {
    if (!parse_as("1 " + symbol, unit)) continue;
    symbols.push_back(symbol);
    if (symbol.size() > 1 && symbol.front() == 'u') {
      symbols.push_back("\u00b5" + symbol.substr(1));
      symbols.push_back("\u03bc" + symbol.substr(1));
    }
    if (symbol == "deg") symbols.emplace_back("\u00b0");
  }
  const std::string letters = "(?:[A-Za-z]|\u00b5|\u03bc|\u00b0)+";
  const std::string power = "(?:\\^?[-+]?\\d+(?:\\.\\d+)?|\u00b2|\u00b3)";
  const std::string times = "(?: *(?:[./*]|\u00b7|\u22c5) *| +)";
  const std::string further = fmt::format("(?:{}{}{}?)", times, letters, power);
  return fmt::format("(?:{}{}{}{}{}*|{}{}+|(?:1 *)?/ *{}{}?{}*)", fmt::join(symbols, "|"),
                     symbols.empty() ? "" : "|", letters, power, further, letters, further, letters,
                     power, further);
}

}  // namespace

std::string quantity_definition(const std::string& unit, Range range) {
  std::string name(quantity_name(dimension_of(unit)));
  if (name.empty()) name = unit.empty() ? "number" : "in " + unit;
  name = (range == Range::positive      ? "positive "
          : range == Range::nonnegative ? "nonnegative "
                                        : "") +
         name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '/' || c == '^'; }, '-');
  return name;
}

Record quantity_schema(const std::string& unit, Range range) {
  Record number, text;
  number.set("type", "number");
  if (range == Range::positive) number.set("exclusiveMinimum", 0);
  if (range == Range::nonnegative) number.set("minimum", 0);
  const std::string with_unit = unit.empty() ? "" : fmt::format("(?: *{})?", unit_pattern(unit));
  text.set("type", "string");
  text.set("pattern", fmt::format("^ *{}{} *$", number_pattern(range), with_unit));
  Record either = Record::array();
  either.add(number);
  either.add(text);
  Record schema;
  schema.set("description",
             expected_quantity(unit) + (range == Range::positive      ? " above zero"
                                        : range == Range::nonnegative ? ", zero or more"
                                                                      : ""));
  schema.set("anyOf", either);
  return schema;
}

}  // namespace whirl::inline io

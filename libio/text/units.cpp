#include "libio/text/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "libio/text/nearest.hpp"

namespace whirl::inline io {

namespace {

// ---- known units ----

/// factor * 10^tens SI units; apart, so that 9 mm becomes 9 / 1000 and not 9 * 0.001.
struct Unit {
  std::string_view symbol;
  double factor;
  int tens;
  Dimension dimension;
  std::string_view prefixes;  ///< those it may carry
};

struct Prefix {
  char letter;
  int tens;
};

constexpr Prefix prefixes[] = {{'n', -9}, {'u', -6}, {'m', -3}, {'c', -2},
                               {'k', 3},  {'M', 6},  {'G', 9}};

constexpr Dimension dim(int kg, int m, int s, int angle = 0, int K = 0, int A = 0) {
  return {{2 * kg, 2 * m, 2 * s, 2 * K, 2 * angle, 2 * A}};
}

constexpr double pi = std::numbers::pi;
constexpr double lbf = 4.4482216152605;          // [N]
constexpr double psi = lbf / (0.0254 * 0.0254);  // [Pa]

// An exact entry wins over prefix and symbol: "min" is a minute, "ft" a foot.
constexpr Unit units[] = {
    {"m", 1, 0, dim(0, 1, 0), "numck"},
    {"in", 254, -4, dim(0, 1, 0), ""},
    {"ft", 3048, -4, dim(0, 1, 0), ""},
    {"mil", 254, -7, dim(0, 1, 0), ""},
    {"thou", 254, -7, dim(0, 1, 0), ""},
    {"g", 1, -3, dim(1, 0, 0), "umkM"},
    {"t", 1, 3, dim(1, 0, 0), ""},
    {"lb", 45359237, -8, dim(1, 0, 0), ""},
    {"lbm", 45359237, -8, dim(1, 0, 0), ""},
    {"oz", 28349523125, -12, dim(1, 0, 0), ""},
    {"slug", lbf / 0.3048, 0, dim(1, 0, 0), ""},
    {"s", 1, 0, dim(0, 0, 1), "num"},
    {"min", 60, 0, dim(0, 0, 1), ""},
    {"h", 3600, 0, dim(0, 0, 1), ""},
    {"N", 1, 0, dim(1, 1, -2), "numkMG"},
    {"lbf", lbf, 0, dim(1, 1, -2), "k"},
    {"dyn", 1, -5, dim(1, 1, -2), ""},
    {"W", 1, 0, dim(1, 2, -3), "mkM"},
    {"J", 1, 0, dim(1, 2, -2), "mkM"},
    {"hp", 550.0 * lbf * 0.3048, 0, dim(1, 2, -3), ""},
    {"Pa", 1, 0, dim(1, -1, -2), "numkMG"},
    {"bar", 1, 5, dim(1, -1, -2), "m"},
    {"psi", psi, 0, dim(1, -1, -2), ""},
    {"ksi", psi, 3, dim(1, -1, -2), ""},
    {"P", 1, -1, dim(1, -1, -1), "mc"},
    {"reyn", psi, 0, dim(1, -1, -1), "um"},
    {"rad", 1, 0, dim(0, 0, 0, 1), "numk"},
    {"deg", pi / 180, 0, dim(0, 0, 0, 1), ""},
    {"rev", 2 * pi, 0, dim(0, 0, 0, 1), ""},
    {"rpm", pi / 30, 0, dim(0, 0, -1, 1), "k"},
    {"cpm", pi / 30, 0, dim(0, 0, -1, 1), "k"},
    {"Hz", 2 * pi, 0, dim(0, 0, -1, 1), "mkM"},
    {"K", 1, 0, dim(0, 0, 0, 0, 1), ""},
    {"A", 1, 0, dim(0, 0, 0, 0, 0, 1), "um"},
    {"V", 1, 0, dim(1, 2, -3, 0, 0, -1), "um"},
    {"H", 1, 0, dim(1, 2, -2, 0, 0, -2), "um"},
    {"ohm", 1, 0, dim(1, 2, -3, 0, 0, -2), "mkM"},
};

std::optional<Unit> find_unit(std::string_view symbol) {
  for (const Unit& unit : units) {
    if (unit.symbol == symbol) return unit;
  }
  for (const Unit& unit : units) {
    for (const Prefix& prefix : prefixes) {
      if (unit.prefixes.find(prefix.letter) == std::string_view::npos) continue;
      if (symbol.front() != prefix.letter || symbol.substr(1) != unit.symbol) continue;
      Unit found = unit;
      found.tens += prefix.tens;
      return found;
    }
  }
  return std::nullopt;
}

/// ", did you mean ...?" or nothing. A force, pressure or mass may lack the dot behind it: "Nm".
std::string suggestion(std::string_view symbol) {
  for (std::size_t i = 1; i < symbol.size() && i < 4; ++i) {
    const auto left = find_unit(symbol.substr(0, i)), right = find_unit(symbol.substr(i));
    if (!left || !right) continue;
    if (left->symbol == "N" || left->symbol == "Pa" || left->symbol == "g") {
      return fmt::format(", did you mean \"{}.{}\"?", symbol.substr(0, i), symbol.substr(i));
    }
  }
  const auto meant = nearest(symbol, unit_symbols());
  return meant ? fmt::format(", did you mean \"{}\"?", *meant) : "";
}

// ---- reading ----

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

void skip_blanks(std::string_view& rest) {
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
}

/// Signs beyond ASCII, in their plain spelling.
std::string plain(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> spellings[] = {
      {"\u00b5", "u"},  {"\u03bc", "u"}, {"\u00b7", "*"},   {"\u22c5", "*"}, {"\u00b2", "^2"},
      {"\u00b3", "^3"}, {"\u2212", "-"}, {"\u00b0", "deg"}, {"\u00a0", " "}, {"\u202f", " "}};
  std::string result;
  while (!text.empty()) {
    const auto* known = std::find_if(std::begin(spellings), std::end(spellings),
                                     [&](const auto& s) { return text.starts_with(s.first); });
    const bool is_known = known != std::end(spellings);
    result += is_known ? known->second : text.substr(0, 1);
    text.remove_prefix(is_known ? known->first.size() : 1);
  }
  return result;
}

/// Product of the factors read so far.
struct Product {
  double factor = 1.0;
  double tens = 0.0;
  Dimension dimension;

  void multiply(const Unit& unit, int twice_exponent) {
    const double exponent = 0.5 * twice_exponent;
    factor *= twice_exponent == 2 ? unit.factor : std::pow(unit.factor, exponent);
    tens += exponent * unit.tens;
    for (std::size_t i = 0; i < dimension.twice.size(); ++i) {
      dimension.twice[i] += unit.dimension.twice[i] / 2 * twice_exponent;
    }
  }

  /// number * factor * 10^tens; powers of ten up to 22 are exact, and are divided by if negative.
  double times(double number) const {
    const double power = std::pow(10.0, std::abs(tens));
    return tens < 0.0 ? number * factor / power : number * factor * power;
  }
};

/// Takes an exponent off the front: "^2", "**2", "^-1.5" or a plain "2"; none is 1. Twice its
/// value.
std::optional<int> take_exponent(std::string_view& rest) {
  const bool has_stars = rest.starts_with("**");
  const bool has_hat = rest.starts_with('^') || has_stars;
  if (!has_hat && (rest.empty() || !is_digit(rest.front()))) return 2;
  if (has_hat) rest.remove_prefix(has_stars ? 2 : 1);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  std::size_t size = rest.starts_with('-') ? 1 : 0;
  while (size < rest.size() && is_digit(rest[size])) ++size;
  // a point belongs to the number only if a digit follows: m^2.s is m^2 times s
  const bool has_fraction =
      has_hat && size + 1 < rest.size() && rest[size] == '.' && is_digit(rest[size + 1]);
  if (has_fraction) {
    ++size;
    while (size < rest.size() && is_digit(rest[size])) ++size;
  }
  double exponent = 0.0;
  const auto [end, code] = std::from_chars(rest.data(), rest.data() + size, exponent);
  if (code != std::errc{} || end != rest.data() + size) return std::nullopt;
  rest.remove_prefix(size);
  constexpr double largest = 12.0;
  if (std::abs(exponent) > largest || 2.0 * exponent != std::round(2.0 * exponent)) {
    return std::nullopt;
  }
  return static_cast<int>(2.0 * exponent);
}

/// Reads a unit in plain spelling; `whole` is the text to be quoted.
Parsed<Product> parse_unit(std::string_view rest, std::string_view whole) {
  using Result = Parsed<Product>;
  constexpr int most_factors = 16;
  Product product;
  if (rest.starts_with('1')) {
    std::string_view after = rest.substr(1);
    skip_blanks(after);
    if (after.starts_with('/')) rest = after;
  }
  for (int factors = 0;; ++factors) {
    skip_blanks(rest);
    if (rest.empty()) return product;
    int sign = 1;
    const char c = rest.front();
    if (c == '/' || (factors > 0 && (c == '.' || c == '*'))) {
      sign = c == '/' ? -1 : 1;
      rest.remove_prefix(1);
      skip_blanks(rest);
    }
    std::size_t size = 0;
    while (size < rest.size() && is_letter(rest[size])) ++size;
    if (size == 0 && !rest.empty() && rest.front() == ',') {
      return Result::failed(
          fmt::format("found a comma in {}, decimals follow a point", in_quotes(whole)));
    }
    if (size == 0 || factors == most_factors) {
      return Result::failed(fmt::format("cannot read the unit in {}", in_quotes(whole)));
    }
    const std::string_view symbol = rest.substr(0, size);
    rest.remove_prefix(size);
    const auto unit = find_unit(symbol);
    if (!unit) {
      return Result::failed(fmt::format("unknown unit {} in {}{}", in_quotes(symbol),
                                        in_quotes(whole), suggestion(symbol)));
    }
    const auto twice_exponent = take_exponent(rest);
    if (!twice_exponent) {
      return Result::failed(fmt::format("the exponent of \"{}\" in {} is not a multiple of 0.5",
                                        symbol, in_quotes(whole)));
    }
    product.multiply(*unit, sign * *twice_exponent);
  }
}

/// N.m and N.m.s, per rad or not: of these alone the angle may be left out.
bool is_torsional(const Dimension& d) {
  const int angle = d.twice[4];
  return d.twice[0] == 2 && d.twice[1] == 4 && (d.twice[2] == -4 || d.twice[2] == -2) &&
         d.twice[3] == 0 && (angle == 0 || angle == -2);
}

bool fits(Dimension found, Dimension expected) {
  if (is_torsional(found) && is_torsional(expected)) found.twice[4] = expected.twice[4];
  return found == expected;
}

}  // namespace

const std::vector<std::string>& unit_symbols() {
  static const std::vector<std::string> known = [] {
    std::vector<std::string> all;
    for (const Unit& unit : units) all.emplace_back(unit.symbol);
    for (const Unit& unit : units) {
      for (const char prefix : unit.prefixes) all.push_back(prefix + std::string(unit.symbol));
    }
    return all;
  }();
  return known;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string shown(text.substr(0, longest));
  if (text.size() > longest) {
    // not within a character: its further bytes are 10xxxxxx
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    shown = std::string(text.substr(0, end)) + "...";
  }
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  return '"' + shown + '"';
}

Parsed<Quantity> parse_quantity(std::string_view text) {
  using Result = Parsed<Quantity>;
  const std::string spelled = plain(text);
  std::string_view rest = spelled;
  skip_blanks(rest);
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);

  // the number; from_chars alone would also take nan and inf
  if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
  const std::size_t first = rest.starts_with('-') ? 1 : 0;
  const bool is_number = rest.size() > first && (is_digit(rest[first]) || rest[first] == '.');
  double number = 0.0;
  const auto [end, code] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (!is_number || code == std::errc::invalid_argument) {
    return Result::failed(fmt::format("{} is not a number", in_quotes(text)));
  }
  const std::string too_large = fmt::format("{} is beyond the range of numbers", in_quotes(text));
  if (code != std::errc{}) return Result::failed(too_large);
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  skip_blanks(rest);
  if (rest.empty()) return Quantity{.value = number};

  const auto unit = parse_unit(rest, text);
  if (!unit) return Result::failed(unit.problem);
  const double value = unit->times(number);
  if (!std::isfinite(value)) return Result::failed(too_large);
  return Quantity{.value = value, .dimension = unit->dimension, .unit = std::string(rest)};
}

Parsed<double> parse_as(std::string_view text, std::string_view si_unit) {
  using Result = Parsed<double>;
  const auto quantity = parse_quantity(text);
  if (!quantity) {
    const bool is_question = quantity.problem.ends_with('?');
    return Result::failed(
        is_question ? quantity.problem
                    : fmt::format("{}, expected {}", quantity.problem, expected_quantity(si_unit)));
  }
  if (!quantity->unit.empty() && !fits(quantity->dimension, dimension_of(si_unit))) {
    return Result::failed(
        fmt::format("found {}, expected {}", in_quotes(text), expected_quantity(si_unit)));
  }
  return quantity->value;
}

Dimension dimension_of(std::string_view si_unit) {
  const auto unit = parse_unit(si_unit, si_unit);
  if (!unit) throw std::invalid_argument(unit.problem);
  const bool is_si = unit->times(1.0) == 1.0;
  if (!is_si) throw std::invalid_argument(in_quotes(si_unit) + " is not an SI unit");
  return unit->dimension;
}

std::string_view quantity_name(const Dimension& dimension) {
  struct Name {
    Dimension dimension;
    std::string_view name;
  };
  static const Name names[] = {
      {dimension_of("m"), "length"},
      {dimension_of("m^2"), "area"},
      {dimension_of("m^4"), "second moment of area"},
      {dimension_of("kg"), "mass"},
      {dimension_of("s"), "time"},
      {dimension_of("K"), "temperature"},
      {dimension_of("rad"), "angle"},
      {dimension_of("rad/s"), "speed"},
      {dimension_of("rad/s^2"), "angular acceleration"},
      {dimension_of("1/s"), "rate"},
      {dimension_of("m/s"), "velocity"},
      {dimension_of("m/s^2"), "acceleration"},
      {dimension_of("N"), "force"},
      {dimension_of("N.m"), "torque or moment"},
      {dimension_of("W"), "power"},
      {dimension_of("N/m"), "stiffness"},
      {dimension_of("N.s/m"), "damping"},
      {dimension_of("N.m/rad"), "tilt stiffness"},
      {dimension_of("N.m.s/rad"), "tilt damping"},
      {dimension_of("N/m^1.5"), "Hertz stiffness"},
      {dimension_of("s/m"), "dissipation factor"},
      {dimension_of("N.m^2"), "bending stiffness"},
      {dimension_of("Pa"), "pressure or modulus"},
      {dimension_of("Pa.s"), "viscosity"},
      {dimension_of("kg/m^3"), "density"},
      {dimension_of("kg/m"), "line density"},
      {dimension_of("kg.m"), "unbalance"},
      {dimension_of("kg.m^2"), "moment of inertia"},
      {dimension_of("A"), "current"},
      {dimension_of("A/m"), "current per displacement"},
      {dimension_of("A.s/m"), "current per velocity"},
      {dimension_of("A/m/s"), "current per displacement and time"},
      {dimension_of("N/A"), "force per current"},
      {dimension_of("V"), "voltage"},
      {dimension_of("H"), "inductance"},
      {dimension_of("ohm"), "resistance"},
  };
  for (const Name& entry : names) {
    if (entry.dimension == dimension) return entry.name;
  }
  return "";
}

std::string expected_quantity(std::string_view si_unit) {
  const Dimension dimension = dimension_of(si_unit);
  if (dimension == Dimension{}) return "a number without unit";
  const std::string_view name = quantity_name(dimension);
  if (name.empty()) return fmt::format("a value in {}", si_unit);
  const bool is_vowel = std::string_view("aeiou").find(name.front()) != std::string_view::npos;
  return fmt::format("{} {} ({})", is_vowel ? "an" : "a", name, si_unit);
}

}  // namespace whirl::inline io

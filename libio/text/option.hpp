#pragma once
/// Options of a command line: members of a struct, whose `fields()` lists them in the order of the
/// help.
///
///   struct CampbellVerbOptions {
///     Option<int> modes{"modes", "N", "how many modes", 8, Whole{1, 10'000}};
///     Option<std::vector<double>> speeds{"speeds", "A:B:STEP", "of the rotor", parse_speeds};
///     auto fields() { return std::tie(modes, speeds); }
///   };
///
/// A field may be such a struct, too. Help, manual, completion and reader all work from these
/// structs, as reader and manual of model files do from fields (libbase/structs/field.hpp).

#include <fmt/format.h>

#include <concepts>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "libio/text/option_values.hpp"

namespace whirl::inline io {

/// The whole numbers that an option takes. Both ends stand where the option is declared, so that no
/// number from outside costs more than somebody thought of.
struct Whole {
  long least, most;

  template <class Number>
  Parsed<Number> read(std::string_view text) const {
    const auto whole = parse_whole(text, least, most);
    return whole ? Parsed(static_cast<Number>(*whole)) : Parsed<Number>::failed(whole.problem);
  }
};

/// Reads what the type of a value says: a choice of an enumeration, a number without unit, or any
/// text.
template <class Value>
Parsed<Value> parse_value(const std::string& text) {
  static_assert(!std::integral<Value>, "a whole number is declared with its range, a Whole");
  if constexpr (std::is_enum_v<Value>) {
    return parse_choice<Value>(text);
  } else if constexpr (std::floating_point<Value>) {
    return parse_as(text, "");
  } else {
    return Parsed<Value>(text);
  }
}

/// What becomes of the file whose name is the value of an option.
enum class FileUse {
  none,     ///< the value is no name of a file
  read,     ///< the verb reads it, or several: placeholder "FILE,..."
  written,  ///< the verb writes it
  stem      ///< the verb writes files whose names begin so
};

/// An option with its value.
template <class Value>
struct Option {
  using Parse = std::function<Parsed<Value>(const std::string&)>;

  std::string_view name;         ///< without dashes
  std::string_view placeholder;  ///< of its value, in the help
  std::string_view help;         ///< without the default
  /// The default, and then what is given; nothing: the model or other options decide, as the help
  /// says.
  std::optional<Value> value{};
  Parse parse{};
  std::optional<Whole> range{};  ///< of whole numbers
  bool is_given = false;
  std::string text{};  ///< as it is given
  FileUse use = FileUse::none;
  std::string_view endings{};    ///< of a file that is written, as OptionSpec has them
  std::string_view goes_with{};  ///< the option without which it counts for nothing; empty: none

  Option(std::string_view called, std::string_view what, std::string_view meaning,
         std::optional<Value> otherwise = {}, Parse read = parse_value<Value>)
      : name(called),
        placeholder(what),
        help(meaning),
        value(std::move(otherwise)),
        parse(std::move(read)) {}
  Option(std::string_view called, std::string_view what, std::string_view meaning, Parse read)
      : Option(called, what, meaning, {}, std::move(read)) {}
  Option(std::string_view called, std::string_view what, std::string_view meaning,
         std::optional<Value> otherwise, Whole whole) requires std::integral<Value>
      : Option(called, what, meaning, std::move(otherwise),
               [whole](const std::string& given) { return whole.read<Value>(given); }) {
    range = whole;
  }
  Option(std::string_view called, std::string_view what, std::string_view meaning,
         Whole whole) requires std::integral<Value>
      : Option(called, what, meaning, std::nullopt, whole) {}

  explicit operator bool() const { return value.has_value(); }
  const Value& operator*() const { return *value; }
  Value value_or(Value otherwise) const { return value.value_or(std::move(otherwise)); }
  /// The error of a value that can be read and means nothing.
  /// @param problem  what would be right
  ModelError wrong(std::string problem) const {
    return wrong_option(std::string(name), text, std::move(problem));
  }
};

/// An option whose value names a file that is read.
inline Option<std::string> file_option(std::string_view name, std::string_view placeholder,
                                       std::string_view help) {
  Option<std::string> option{name, placeholder, help};
  option.use = FileUse::read;
  return option;
}

/// An option whose value names a file that is written.
/// @param endings  that such files have, ".json .txt"; empty: the verb asks for one
inline Option<std::string> output_option(std::string_view name, std::string_view placeholder,
                                         std::string_view help, std::string_view endings = "",
                                         FileUse use = FileUse::written) {
  Option<std::string> option{name, placeholder, help};
  option.use = use;
  option.endings = endings;
  return option;
}

/// An option that counts for nothing without another one.
template <class Value>
Option<Value> going_with(std::string_view other, Option<Value> option) {
  option.goes_with = other;
  return option;
}

/// An option without a value.
struct Flag {
  std::string_view name, help;
  bool is_given = false;

  operator bool() const { return is_given; }
  ModelError wrong(std::string problem) const {
    return wrong_option(std::string(name), "", std::move(problem));
  }
};

/// An option that may be given several times.
struct ListOption {
  std::string_view name, placeholder, help;
  std::vector<std::string> values{};
};

/// An option as the help tells it.
struct OptionSpec {
  std::string_view name;
  std::string_view value;  ///< placeholder; empty: a flag
  std::string_view help;
  std::string otherwise = "";  ///< the default; empty: none, or one that is decided elsewhere
  std::string range = "";      ///< of whole numbers: "1 to 100 000"
  bool is_list = false;
  FileUse use = FileUse::none;
  /// Endings that a written file may have, beside endings that say no format; empty: any.
  std::string_view endings = "";
  std::string_view goes_with = "";  ///< the option without which it counts for nothing; empty: none

  bool is_flag() const { return value.empty(); }
  bool writes() const { return use == FileUse::written || use == FileUse::stem; }
};

/// What the help says of an option, with its range, and its default in parentheses.
inline std::string help_of(const OptionSpec& option) {
  std::string help(option.help);
  if (!option.range.empty()) help += fmt::format("; {}", option.range);
  return option.otherwise.empty() ? help : fmt::format("{} ({})", help, option.otherwise);
}

/// An option as the help tells it, with its default.
template <class Value>
OptionSpec spec_of(const Option<Value>& option) {
  OptionSpec spec{option.name, option.placeholder, option.help};
  spec.use = option.use;
  spec.endings = option.endings;
  spec.goes_with = option.goes_with;
  if constexpr (std::is_enum_v<Value>) {
    if (option) spec.otherwise = name_of(*option);
  } else if constexpr (std::is_arithmetic_v<Value> || std::same_as<Value, std::string>) {
    if (option) spec.otherwise = fmt::format("{}", *option);
  }
  if (option.range) spec.range = range_text(option.range->least, option.range->most);
  return spec;
}
inline OptionSpec spec_of(const Flag& flag) {
  return {flag.name, "", flag.help};
}
inline OptionSpec spec_of(const ListOption& list) {
  return {list.name, list.placeholder, list.help, "", "", true};
}

/// Values of options that are given, by name: most have one value, a flag has an empty one.
using GivenValues = std::map<std::string, std::vector<std::string>, std::less<>>;

/// Gives an option its value.
/// @throws ModelError  naming the option and its value, if it means nothing
template <class Value>
void take(Option<Value>& option, const std::vector<std::string>& given) {
  option.text = given.back();
  option.is_given = true;
  option.value = parsed_option(std::string(option.name), option.text, option.parse);
}
inline void take(Flag& flag, const std::vector<std::string>&) {
  flag.is_given = true;
}
inline void take(ListOption& list, const std::vector<std::string>& given) {
  list.values = given;
}

/// Calls f with every option of a struct, also with those of structs that are its fields.
template <class Options, class F>
void for_each_option(Options& options, const F& f) {
  const auto visit = [&](auto& field) {
    if constexpr (requires { field.fields(); }) {
      for_each_option(field, f);
    } else {
      f(field);
    }
  };
  const auto visit_all = [&]<class... Field>(Field&... field) {
    static_assert(sizeof(Options) == (sizeof(Field) + ...), "fields() must list every option");
    (visit(field), ...);
  };
  std::apply(visit_all, options.fields());
}

/// The options of a struct as the help tells them.
template <class Options>
std::vector<OptionSpec> specs_of(Options options = {}) {
  std::vector<OptionSpec> specs;
  for_each_option(options, [&](const auto& option) { specs.push_back(spec_of(option)); });
  return specs;
}

/// A struct with the values that are given.
/// @throws ModelError  naming the option whose value means nothing, and saying what would be right
template <class Options>
Options read_options(const GivenValues& given) {
  Options options;
  for_each_option(options, [&](auto& option) {
    const auto found = given.find(option.name);
    if (found != given.end()) take(option, found->second);
  });
  return options;
}

}  // namespace whirl::inline io

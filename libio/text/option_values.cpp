#include "libio/text/option_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "libbase/numerics/constants.hpp"
#include "libio/text/encoding.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/text/value_range.hpp"

namespace whirl::inline io {

namespace {

constexpr int default_speeds = 101, default_frequencies = 401;

/// Endings that say what is in a file, each between blanks.
constexpr std::string_view endings_of_formats =
    " .h5 .hdf5 .json .html .htm .svg .png .jpg .jpeg .gif .tif .tiff .pdf .eps .ps .ogv .mp4 .avi "
    ".mkv .mov .webm .toml .csv .tsv .txt .wav .mat .uff .unv .ufb .vtk .vtu .vtp .pvd .xdmf .xmf "
    ".mtx .npy .npz .xls .xlsx .ods .doc .docx .odt .md .tex .xml .yaml .yml .zip .gz ";

bool is_among(const std::string& ending, std::string_view endings) {
  return fmt::format(" {} ", endings).find(" " + ending + " ") != std::string::npos;
}

}  // namespace

ModelError wrong_option(const std::string& option, const std::string& value, std::string problem) {
  return ModelError({fmt::format("--{}{}{}", option, value.empty() ? "" : " ", value)}, "",
                    std::move(problem));
}

std::string ending_problem(std::string_view file, std::string_view endings) {
  if (file == "-") {
    return is_among("-", endings)
               ? ""
               : "expected the name of a file; standard output, -, is for --json";
  }
  const std::string ending = lower_case(std::filesystem::path(file).extension().string());
  const bool is_right = ending.empty() || endings.empty() || is_among(ending, endings);
  if (is_right || !is_among(ending, endings_of_formats)) return "";
  std::string right(endings.substr(0, endings.find(' ')));
  // of a report, whose two endings are two things
  if (is_among(".pdf", endings) && right != ".pdf") right += " or .pdf";
  return fmt::format("what is written is no {} file, expected a name that ends in {}",
                     ending.substr(1), right);
}

namespace {

/// "512", "100 000", "10 million"
std::string count_text(long number) {
  constexpr long billion = 1'000'000'000, million = 1'000'000, thousand = 1000;
  if (number > 0 && number % billion == 0) return fmt::format("{} billion", number / billion);
  if (number > 0 && number % million == 0) return fmt::format("{} million", number / million);
  if (number < 10 * thousand) return std::to_string(number);
  return fmt::format("{} {:03}", number / thousand, number % thousand);
}

}  // namespace

std::string range_text(long least, long most) {
  return fmt::format("{} to {}", count_text(least), count_text(most));
}

Parsed<long> parse_whole(std::string_view text, long least, long most) {
  long number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  if (error == std::errc{} && end == last && number >= least && number <= most) return number;
  return Parsed<long>::failed(
      fmt::format("expected a whole number from {}", range_text(least, most)));
}

namespace {

/// A number between bounds that are written as they are told.
Parsed<double> parse_between(std::string_view text, double least, double most,
                             std::string_view bounds) {
  auto number = parse_as(text, "");
  if (!number || (*number >= least && *number <= most)) return number;
  return Parsed<double>::failed(fmt::format("expected a number from {}", bounds));
}

}  // namespace

Parsed<double> parse_tolerance(std::string_view text) {
  return parse_between(text, 1e-15, 1e-2, "1e-15 to 1e-2");
}

Parsed<double> parse_resolution(std::string_view text) {
  return parse_between(text, 1e-6, 10.0, "1e-6 to 10");
}

Parsed<double> parse_duration(std::string_view text) {
  auto time = parse_as(text, "s");
  if (!time || *time > 0.0) return time;
  return Parsed<double>::failed("expected a time above 0");
}

Parsed<std::string> parse_method(const std::string& name,
                                 const std::vector<std::string_view>& methods) {
  const bool is_known = std::find(methods.begin(), methods.end(), name) != methods.end();
  if (is_known || name == "cvode") return name;
  return Parsed<std::string>::failed(
      fmt::format("unknown method, expected one of {}", fmt::join(methods, ", ")));
}

Parsed<std::string> parse_instruction_set(const std::string& name,
                                          const std::vector<std::string>& sets) {
  if (std::find(sets.begin(), sets.end(), name) != sets.end()) return name;
  return Parsed<std::string>::failed(
      fmt::format("this program on this processor has {} only", fmt::join(sets, ", ")));
}

namespace {

/// Numbers of zero or more [rad/s].
/// @param otherwise  how many there are without a step
Parsed<std::vector<double>> parse_rates(std::string_view text, const char* what, int otherwise) {
  using Result = Parsed<std::vector<double>>;
  const auto range = parse_range(text, "rad/s");
  if (!range) return Result::failed(range.problem);
  if (range->first < 0.0) return Result::failed(fmt::format("expected {} of zero or more", what));
  return range->step ? values(*range) : values(*range, otherwise);
}

}  // namespace

Parsed<std::vector<double>> parse_speeds(std::string_view text) {
  return parse_rates(text, "speeds", default_speeds);
}

Parsed<std::vector<double>> parse_frequencies(std::string_view text) {
  return parse_rates(text, "frequencies", default_frequencies);
}

std::vector<double> usual_speeds(double operating_speed) {
  const double last = operating_speed > 0.0 ? 1.5 * operating_speed : 10'000.0 * rpm;
  return values(ValueRange{0.0, last, {}}, default_speeds);
}

std::vector<double> speeds_over(const std::vector<std::string>& over, double otherwise) {
  std::vector<double> speeds{otherwise};
  for (const std::string& text : over) {
    const auto axis = parse_axis(text, 2);  // of a range without a step both ends are enough
    if (axis && axis->path.find("operation.speed") != std::string::npos) speeds = axis->values;
  }
  return speeds;
}

std::string expected_one_of(const std::vector<std::string_view>& names) {
  const auto last = names.end() - 1;
  return fmt::format("expected {} or {}", fmt::join(names.begin(), last, ", "), *last);
}

}  // namespace whirl::inline io

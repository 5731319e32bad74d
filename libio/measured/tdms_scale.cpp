#include "libio/measured/tdms_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

using Properties = TdmsProperties;
using Result = Parsed<TdmsScale>;

constexpr std::size_t most_scales = 64;
constexpr double raw_samples = 4294967295.0;  ///< number of the input that is no scale

/// How many scales there are.
std::size_t count_of(const Properties& properties) {
  if (const auto count = number_in(properties, "NI_Number_Of_Scales")) {
    return *count > 0.0 ? static_cast<std::size_t>(std::min(*count, 1e6)) : 0;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i <= most_scales; ++i) {
    if (properties.contains(fmt::format("NI_Scale[{}]_Scale_Type", i))) count = i + 1;
  }
  return count;
}

/// Coefficients of a scale; nothing: some are missing.
std::optional<std::vector<double>> coefficients_of(const Properties& properties,
                                                   const std::string& scale, bool is_linear) {
  std::vector<double> all;
  if (is_linear) {
    const auto slope = number_in(properties, scale + "_Linear_Slope");
    const auto begin = number_in(properties, scale + "_Linear_Y_Intercept");
    if (!slope || !begin) return std::nullopt;
    return std::vector{*begin, *slope};
  }
  const auto size = number_in(properties, scale + "_Polynomial_Coefficients_Size");
  while (!size || static_cast<double>(all.size()) < *size) {
    const auto one =
        number_in(properties, fmt::format("{}_Polynomial_Coefficients[{}]", scale, all.size()));
    if (!one && size) return std::nullopt;
    if (!one) break;
    all.push_back(*one);
  }
  if (all.empty()) return std::nullopt;
  return all;
}

}  // namespace

double TdmsScale::operator()(double sample) const {
  for (const std::vector<double>& coefficients : polynomials) {
    double value = 0.0;
    for (std::size_t k = coefficients.size(); k > 0; --k) {
      value = value * sample + coefficients[k - 1];
    }
    sample = value;
  }
  return sample;
}

bool has_tdms_scale(const TdmsProperties& properties) {
  return count_of(properties) > 0;
}

Parsed<TdmsScale> tdms_scale(const TdmsProperties& properties) {
  const std::string status = lower_case(text_in(properties, "NI_Scaling_Status"));
  TdmsScale scale;
  if (status == "scaled") return scale;
  if (!status.empty() && status != "unscaled") {
    return Result::failed(fmt::format(
        "its NI_Scaling_Status is \"{}\", expected \"scaled\" or \"unscaled\"", status));
  }
  scale.is_doubtful = status.empty();
  const std::size_t count = count_of(properties);
  if (count > most_scales) return Result::failed(fmt::format("it has {} scales", count));
  for (std::size_t next = count; next > 0;) {
    const std::size_t i = next - 1;
    const std::string name = fmt::format("NI_Scale[{}]", i);
    const std::string type = text_in(properties, name + "_Scale_Type");
    if (type != "Linear" && type != "Polynomial") {
      return Result::failed(
          fmt::format("its scale {} is {}, expected \"Linear\" or \"Polynomial\"", name,
                      type.empty() ? "not in the file" : fmt::format("\"{}\"", type)));
    }
    auto coefficients = coefficients_of(properties, name, type == "Linear");
    if (!coefficients) return Result::failed(fmt::format("its scale {} is not whole", name));
    scale.polynomials.insert(scale.polynomials.begin(), std::move(*coefficients));
    const auto input = number_in(properties, fmt::format("{}_{}_Input_Source", name, type));
    if (count == 1 && (!input || *input == 0.0 || *input == raw_samples)) break;
    if (input && *input == raw_samples) break;
    if (!input || !(*input >= 0.0 && *input < static_cast<double>(i))) {
      return Result::failed(fmt::format(
          "its scale {} takes {}, expected a scale before it, or the "
          "samples themselves",
          name, input ? fmt::format("scale {}", *input) : "it is not said which scale"));
    }
    next = static_cast<std::size_t>(*input) + 1;
  }
  return scale;
}

}  // namespace whirl::inline io

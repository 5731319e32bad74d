#include "libio/measured/record_values.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline io {

namespace {

/// 0.01 of "1%"; nothing: it is no percentage.
std::optional<double> percentage(const std::string& text) {
  if (!text.ends_with('%')) return std::nullopt;
  const auto number = parse_as(text.substr(0, text.size() - 1), "");
  return number ? std::optional(0.01 * *number) : std::nullopt;
}

}  // namespace

Parsed<double> parse_sampling_rate(const std::string& text) {
  if (const auto number = parse_as(text, ""); number && *number > 0.0) return number;
  const auto frequency = parse_as(text, "rad/s");
  if (frequency && *frequency > 0.0) return *frequency / hertz;
  return Parsed<double>::failed("expected samples per second, such as 5000 or 5 kHz");
}

Parsed<double> parse_frequency(const std::string& text) {
  return parse_as(text, "rad/s");
}

Parsed<double> parse_length(const std::string& text) {
  const auto length = parse_as(text, "m");
  if (length && *length > 0.0) return length;
  return Parsed<double>::failed("expected a length above zero, such as 120um");
}

Parsed<std::vector<double>> parse_orders(const std::string& text) {
  std::vector<double> orders;
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ',');) {
    const auto order = parse_as(one, "");
    if (!order || *order <= 0.0) {
      return Parsed<std::vector<double>>::failed("expected orders above zero, such as 1,2 or 0.5");
    }
    if (std::find(orders.begin(), orders.end(), *order) == orders.end()) orders.push_back(*order);
  }
  if (orders.empty()) return Parsed<std::vector<double>>::failed("expected orders, such as 1,2");
  return orders;
}

Parsed<double> parse_revolutions(const std::string& text) {
  const auto number = parse_as(text, "");
  if (number && *number >= 0.0) return number;
  return Parsed<double>::failed("expected a number of revolutions, such as 20");
}

Parsed<double> parse_noise_share(const std::string& text) {
  const auto percent = percentage(text);
  const auto share = percent ? Parsed(*percent) : parse_as(text, "");
  if (share && *share >= 0.0) return share;
  return Parsed<double>::failed("expected a share of the signal, such as 1% or 0.01");
}

Parsed<ProbeNoise> parse_probe_noise(const std::string& text) {
  const auto percent = percentage(text);
  const auto size = percent ? Parsed(*percent) : parse_as(text, "m");
  if (size && *size > 0.0) return ProbeNoise{*size, percent.has_value()};
  return Parsed<ProbeNoise>::failed("expected a length such as 2um, or a share such as 1%");
}

}  // namespace whirl::inline io

#pragma once
/// What of a motion is drawn, as the one who draws it asks for.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Speeds [rad/s] or times [s] of a motion.
struct Moments {
  std::vector<double> speeds{}, times{};  ///< one of both

  bool empty() const { return speeds.empty() && times.empty(); }
};
/// Reads speeds or times with their units, "1500rpm,3000rpm" or "2s,3.5s".
Parsed<Moments> parse_moments(const std::string& text);

/// Reads two frequencies, "10:200Hz" [rad/s].
Parsed<std::pair<double, double>> parse_band(const std::string& text);

/// Options of figures of motions; what is left open is chosen by the figure.
struct MotionView {
  Moments at{};
  std::vector<double> orders{};                     ///< multiples of the speed
  std::optional<std::pair<double, double>> band{};  ///< [rad/s]
  bool is_averaged = false;
  std::optional<double> slow_roll{};  ///< [rad/s]
  std::optional<double> clearance{};  ///< radial [m]
  /// Names and values of the options that were given, without dashes.
  std::vector<std::pair<std::string, std::string>> given{};
};

}  // namespace whirl::inline io

// Loads of other frequencies than that of the speed: their angles, and when they repeat.

#include <cmath>
#include <numbers>
#include <numeric>

#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

namespace {

constexpr long most_repeats = 1000;  ///< denominator of an order that counts as a fraction
constexpr long most_chance = 32;  ///< the same of a frequency that happens to be one at this speed
constexpr double fraction_digits = 1e-12;  ///< of it, as decimals have it

}  // namespace

double Oscillation::start_angle(long revolution) const {
  const auto r = static_cast<double>(revolution);
  const double turns = ratio * r, rest = std::fma(ratio, r, -turns);
  return 2.0 * std::numbers::pi * (turns - std::floor(turns) + rest);
}

long ContactSystem::repeats_after() const {
  long together = 1;
  for (const Oscillation& o : oscillations_) {
    const long most = o.order > 0.0 ? most_repeats : most_chance;
    long q = 1;
    while (q <= most && std::abs(o.ratio * q - std::round(o.ratio * q)) > fraction_digits * q) ++q;
    if (q > most) return 0;
    together = std::lcm(together, q);
  }
  return together <= most_repeats ? together : 0;
}

}  // namespace whirl::inline dyn

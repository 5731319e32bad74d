#include "libdyn/system/load_periods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline dyn {

namespace {

constexpr long most_repeats = 1000;  ///< denominator of an order that counts as a fraction
constexpr long most_chance = 32;  ///< the same of a frequency that happens to be one at this speed
constexpr double most_often =
    5000;  ///< ratio to the frequency of the speed: what sines of lanes can take
constexpr double fraction_digits = 1e-12;  ///< of it, as decimals have it

/// The least denominator of a ratio that is a fraction; 0: none is so small.
long denominator_of(double ratio, long most) {
  for (long q = 1; q <= most; ++q) {
    if (std::abs(ratio * q - std::round(ratio * q)) <= fraction_digits * q) return q;
  }
  return 0;
}

/// What is said of a load that changes too often for a revolution at this speed.
NumericalError too_often(const Structure& structure, const Excitation& load, double ratio) {
  std::string name;
  for (const Force& f : structure.forces) {
    const bool is_it = !f.is_constant() && f.order == load.order && f.frequency == load.frequency;
    if (is_it && name.empty()) name = f.name;
  }
  return NumericalError(
      fmt::format("force \"{}\", {}, is {:.4g} times the frequency of the speed, expected {:g} "
                  "times at most",
                  name, load.label(), ratio, most_often));
}

}  // namespace

double frequency_ratio(const Structure& structure, const Excitation& load, double phase_rate) {
  const double ratio = load.order > 0.0 ? load.order : load.frequency / phase_rate;
  if (ratio > most_often) throw too_often(structure, load, ratio);
  return ratio;
}

long ContactSystem::repeats_after() const {
  long together = 1;
  for (const ReducedExcitation& o : excitations_) {
    const long q = denominator_of(o.ratio, o.order > 0.0 ? most_repeats : most_chance);
    if (q == 0) return 0;
    together = std::lcm(together, q);
  }
  for (const ReducedContact& c : contacts_) {
    if (c.place > 0) continue;  // as the first
    for (const double ratio : repeating_ratios_of(c.geometry)) {
      const long q = denominator_of(ratio, most_repeats);
      if (q == 0) return 0;
      together = std::lcm(together, q);
    }
  }
  return together <= most_repeats ? together : 0;
}

bool follows_the_speed(const ContactSystem& system) {
  const bool turns = std::any_of(system.contacts().begin(), system.contacts().end(),
                                 [](const ReducedContact& c) { return c.turns(); });
  return !system.synchronous_load().is_zero() || (turns && system.Omega() != 0.0);
}

namespace {

/// How often the first of some loads repeats until all of them do, by their frequencies over
/// another one; 0: they never do.
long repeats_of_first(const std::vector<double>& ratios) {
  long together = 1;
  for (const double ratio : ratios) {
    const long q = denominator_of(ratio / ratios[0], most_chance);
    if (q == 0) return 0;
    together = std::lcm(together, q);
  }
  return together <= most_repeats ? together : 0;
}

std::vector<double> ratios_of(const ContactSystem& system) {
  std::vector<double> ratios;
  for (const ReducedExcitation& o : system.other_loads()) ratios.push_back(o.ratio);
  return ratios;
}

}  // namespace

std::optional<double> load_period(const ContactSystem& system) {
  const std::vector<double> ratios = ratios_of(system);
  const auto others = system.other_loads();
  const bool has_order = std::any_of(others.begin(), others.end(),
                                     [](const ReducedExcitation& o) { return o.order > 0.0; });
  if (ratios.empty() || has_order || follows_the_speed(system)) return std::nullopt;
  if (const long often = repeats_of_first(ratios); often > 0) {
    return static_cast<double>(often) / ratios[0] * system.period();
  }
  const long revolutions = system.repeats_after();
  if (revolutions == 0) return std::nullopt;
  return static_cast<double>(revolutions) * system.period();
}

bool loads_repeat(const ContactSystem& system) {
  if (system.repeats_after() > 0) return true;
  std::vector<double> ratios = ratios_of(system);
  if (!system.synchronous_load().is_zero()) ratios.push_back(1.0);
  for (const ReducedContact& c : system.contacts()) {
    if (c.place > 0) continue;  // as the first
    for (const double ratio : repeating_ratios_of(c.geometry)) {
      if (ratio != 0.0) ratios.push_back(std::abs(ratio));
    }
  }
  return std::all_of(ratios.begin(), ratios.end(), [&](double ratio) {
    return denominator_of(ratio / ratios[0], most_chance) > 0;
  });
}

}  // namespace whirl::inline dyn

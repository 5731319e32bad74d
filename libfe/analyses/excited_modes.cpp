#include "libfe/analyses/excited_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

namespace {

constexpr double place_tol = 1e-13;    ///< of a place
constexpr int grid_steps = 24;         ///< between zero and the highest place looked at
constexpr double lowest_share = 1e-6;  ///< of the highest place, where a grid begins
constexpr double standing = 1e-12;     ///< Omega over the excitation that stands for rest
constexpr int most_rises = 40;         ///< of the highest place looked at
constexpr double touching = 0.05;      ///< |gap| at a turning point worth a look

const Rotor* rotor_named(const Structure& structure, const std::string& name) {
  const auto shaft = structure.shaft_named(name);
  if (!shaft) {
    throw ModelError({}, "rotor", fmt::format("there is no rotor named \"{}\"", name));
  }
  return *shaft == 0 ? nullptr : &structure.rotors[static_cast<std::size_t>(*shaft) - 1];
}

/// Equal steps up to a place, and the places where tables of own speeds bend.
std::vector<double> grid_up_to(double high, const Structure& structure) {
  std::vector<double> grid{lowest_share * high};
  for (int i = 1; i <= grid_steps; ++i) grid.push_back(high * i / grid_steps);
  for (const Rotor& rotor : structure.rotors) {
    for (const double lead : rotor.lead) {
      if (lead > grid.front() && lead < high) grid.push_back(lead);
    }
  }
  std::ranges::sort(grid);
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  return grid;
}

/// Speed of the first shaft from which on all shafts keep their own speeds [rad/s].
double last_lead(const Structure& structure) {
  double last = 0.0;
  for (const Rotor& rotor : structure.rotors) {
    if (rotor.own.size() > 1) last = std::max(last, rotor.lead.back());
  }
  return last;
}

/// A speed below which so many critical speeds by the first shaft lie, or all [rad/s].
double top_of(ExcitedModes& modes, const Structure& structure, double start, std::size_t count) {
  const double last = last_lead(structure);
  double high = start;
  for (int i = 0; i < most_rises; ++i) {
    const auto below = modes.below(high);
    if (below && *below >= count) break;
    if (below && high >= last && modes.is_above_all(high)) break;
    const double guess = below ? modes.guess(high, count - 1) : high;
    high = std::isfinite(guess) ? std::clamp(1.01 * guess, 1.2 * high, 4.0 * high) : 2.0 * high;
  }
  return high;
}

}  // namespace

Structure with_ratios_at(Structure structure, double Omega) {
  for (Rotor& rotor : structure.rotors) {
    if (!rotor.has_own_speed()) continue;
    rotor.ratio = rotor.speed_at(Omega) / Omega;
    rotor.lead.clear();
    rotor.own.clear();
  }
  return structure;
}

double excitation_at(const Structure& structure, const CriticalOptions& options, double Omega) {
  const Rotor* rotor = rotor_named(structure, options.by);
  return rotor ? std::abs(rotor->speed_at(Omega)) : options.order * Omega;
}

ExcitedModes::ExcitedModes(ExcitedRotorAt rotor, int count)
    : rotor_(std::move(rotor)), count_(static_cast<std::size_t>(count) + 2) {}

std::vector<Critical> ExcitedModes::solved(double s) {
  ExcitedRotor at = rotor_(s);
  if (at.excitation == 0.0) return {};
  const double Omega = std::max(at.Omega, standing * at.excitation);
  Structure frozen = at.structure;
  if (at.Omega < Omega) {  // own speeds are those at rest
    for (Rotor& rotor : frozen.rotors) {
      if (rotor.has_own_speed()) rotor.own = {rotor.speed_at(at.Omega)}, rotor.lead = {0.0};
    }
  }
  const System system =
      Assembler(with_ratios_at(std::move(frozen), Omega)).at(Omega, at.excitation);
  for (;;) {
    std::vector<Critical> all = undamped_criticals(
        system, {.count = static_cast<int>(count_), .order = at.excitation / Omega});
    // of the speed that would be critical: the excitation there over the one here
    for (Critical& c : all) c.speed /= Omega;
    const bool is_all = all.size() < count_ || all.back().speed > 1.0;
    if (is_all || count_ >= static_cast<std::size_t>(system.size())) return all;
    count_ *= 2;
  }
}

const std::vector<double>* ExcitedModes::try_at(double s) {
  auto known = known_.find(s);
  if (known == known_.end()) {
    std::vector<double> ratios;  // f over a natural frequency
    try {
      for (const Critical& c : solved(s)) ratios.push_back(1.0 / c.speed);
      ratios.push_back(0.0);  // beyond the last one
    } catch (const NumericalError& error) {
      if (why_not_.empty()) why_not_ = error.what();
    }
    known = known_.emplace(s, std::move(ratios)).first;
  }
  return known->second.empty() ? nullptr : &known->second;
}

std::optional<std::size_t> ExcitedModes::below(double s) {
  const std::vector<double>* ratios = try_at(s);
  if (!ratios) return {};
  return static_cast<std::size_t>(
      std::ranges::count_if(*ratios, [](double ratio) { return ratio > 1.0; }));
}

double ExcitedModes::guess(double s, std::size_t k) {
  const std::vector<double>* ratios = try_at(s);
  return ratios && k + 1 < ratios->size() ? s / (*ratios)[k]
                                          : std::numeric_limits<double>::infinity();
}

bool ExcitedModes::is_above_all(double s) {
  const std::vector<double>* ratios = try_at(s);
  return ratios && ratios->size() <= count_ && *below(s) + 1 == ratios->size();
}

double ExcitedModes::gap(double s, std::size_t k) {
  const std::vector<double>* ratios = try_at(s);
  if (!ratios) return nan;
  return (k < ratios->size() ? (*ratios)[k] : 0.0) - 1.0;
}

void ExcitedModes::add_between(double a, double b, std::size_t k, std::vector<ExcitedPlace>& to) {
  const double s = bracketed_root([&](double at) { return gap(at, k); }, a, gap(a, k), b, gap(b, k),
                                  place_tol * b);
  if (!std::isfinite(s)) return;
  std::vector<Critical> found = solved(s);
  if (k >= found.size()) return;
  Critical critical = std::move(found[k]);
  critical.speed = rotor_(s).Omega;
  to.push_back({s, std::move(critical)});
}

void ExcitedModes::add_turning(double a, double b, double c, std::size_t k,
                               std::vector<ExcitedPlace>& to) {
  const double fa = gap(a, k), fb = gap(b, k), fc = gap(c, k);
  const bool is_nearest = std::abs(fb) <= std::abs(fa) && std::abs(fb) <= std::abs(fc);
  if (!is_nearest || std::abs(fb) > touching) return;
  const double sign = fb > 0.0 ? -1.0 : 1.0;
  const Maximum top =
      bracketed_maximum([&](double at) { return sign * gap(at, k); }, a, b, c, 1e-6 * c);
  if (!(top.value > 0.0)) return;
  add_between(a, top.at, k, to);
  add_between(top.at, c, k, to);
}

std::vector<ExcitedPlace> ExcitedModes::places(const std::vector<double>& grid) {
  std::vector<double> known;
  std::size_t most = 0;
  for (const double s : grid) {
    const auto number = below(s);
    if (!number) continue;
    known.push_back(s);
    most = std::max(most, *number + 1);
  }
  if (known.empty()) throw NumericalError(why_not_);
  std::vector<ExcitedPlace> found;
  for (std::size_t k = 0; k < most; ++k) {
    const auto is_above = [&](std::size_t i) { return gap(known[i], k) > 0.0; };
    for (std::size_t i = 0; i + 1 < known.size(); ++i) {
      if (is_above(i) != is_above(i + 1)) {
        add_between(known[i], known[i + 1], k, found);
      } else if (i > 0 && is_above(i - 1) == is_above(i)) {
        add_turning(known[i - 1], known[i], known[i + 1], k, found);
      }
    }
  }
  std::ranges::sort(found, {}, &ExcitedPlace::s);
  return found;
}

std::vector<Critical> excited_criticals(const Structure& structure,
                                        const CriticalOptions& options) {
  const auto wanted = static_cast<std::size_t>(options.count);
  const auto along = [&](const CriticalOptions& by) {
    return ExcitedModes(
        [&structure, by](double Omega) {
          return ExcitedRotor{structure, Omega, excitation_at(structure, by, Omega)};
        },
        by.count);
  };
  CriticalOptions by_first = options;
  by_first.by.clear();
  if (!options.by.empty()) by_first.order = 1.0;
  // further shafts at rest say where to begin
  Structure still = structure;
  for (Rotor& rotor : still.rotors) {
    if (rotor.has_own_speed()) rotor.lead.clear(), rotor.own.clear(), rotor.ratio = 0.0;
  }
  double start = options.start;
  for (const Critical& c : undamped_criticals(Assembler(still).at(start), by_first)) {
    start = std::max(start, 1.05 * c.speed);
  }
  if (start == 0.0) start = std::max(last_lead(structure), 1.0);
  ExcitedModes first = along(by_first);
  double high = top_of(first, structure, start, wanted);
  ExcitedModes modes = options.by.empty() ? std::move(first) : along(options);
  if (!options.by.empty()) high = std::max(high, last_lead(structure));
  std::vector<Critical> criticals;
  for (ExcitedPlace& place : modes.places(grid_up_to(high, structure))) {
    place.critical.order = options.by.empty() ? options.order : nan;
    criticals.push_back(std::move(place.critical));
  }
  std::ranges::stable_sort(criticals, {}, &Critical::speed);
  if (criticals.size() > wanted) criticals.resize(wanted);
  return criticals;
}

}  // namespace whirl::inline fe

#include "libfe/analyses/resonance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libbase/numerics/roots.hpp"

namespace whirl::inline fe {

namespace {

/// Interpolates values over speeds by the cubic through the four nearest of them, fewer at the ends
/// of a branch. Only between two neighbors that exist.
double interpolated(const std::vector<double>& speeds, const std::vector<double>& values,
                    std::size_t before, double speed) {
  std::size_t first = before, last = before + 1;
  if (first > 0 && std::isfinite(values[first - 1])) --first;
  if (last + 1 < values.size() && std::isfinite(values[last + 1])) ++last;
  double sum = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    double share = values[i];
    for (std::size_t j = first; j <= last; ++j) {
      if (j != i) share *= (speed - speeds[j]) / (speeds[i] - speeds[j]);
    }
    sum += share;
  }
  return sum;
}

/// A branch, seen from the rotor with its motion in one sense: |Omega - s omega|.
struct SeenBranch {
  int number = 0;
  int sense = 1;  ///< s: 1 forward, -1 backward
  const std::vector<double>& speeds;
  const std::vector<double>& frequency;

  bool is_between(std::size_t i) const { return std::isfinite(frequency[i] + frequency[i + 1]); }
  /// @param i  of the speed below
  double at(std::size_t i, double Omega) const {
    return std::abs(Omega - sense * interpolated(speeds, frequency, i, Omega));
  }
};

/// All branches in all senses that they may have; those of mixed or no sense twice.
std::vector<SeenBranch> seen_branches(const Campbell& diagram) {
  std::vector<SeenBranch> all;
  for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
    const CampbellBranch& branch = diagram.branches[b];
    for (const int sense : {1, -1}) {
      if (branch.whirl == (sense == 1 ? Whirl::backward : Whirl::forward)) continue;
      all.push_back({static_cast<int>(b), sense, diagram.speeds, branch.frequency});
    }
  }
  return all;
}

/// Adds where q times one frequency is p times the other.
void add_meetings(const SeenBranch& a, const SeenBranch& b, int p, int q,
                  std::vector<InternalResonance>& found) {
  constexpr double tolerance = 1e-12;  // of the speed
  constexpr double still = 1e-6;       // of the speed: a motion that does not move on the rotor
  const std::vector<double>& speeds = a.speeds;
  for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
    if (!a.is_between(i) || !b.is_between(i)) continue;
    const auto gap = [&](double Omega) { return q * a.at(i, Omega) - p * b.at(i, Omega); };
    const double before = gap(speeds[i]), after = gap(speeds[i + 1]);
    if ((before > 0.0) == (after > 0.0)) continue;
    const double Omega = bracketed_root(gap, speeds[i], before, speeds[i + 1], after,
                                        tolerance * std::abs(speeds[i + 1]));
    const double frequency = b.at(i, Omega) / q;
    if (Omega > 0.0 && frequency > still * Omega) {
      found.push_back({Omega, p, q, a.number, b.number, frequency});
    }
  }
}

}  // namespace

std::vector<InternalResonance> internal_resonances(const Campbell& diagram, int largest) {
  const std::vector<SeenBranch> branches = seen_branches(diagram);
  std::vector<InternalResonance> found;
  for (const SeenBranch& a : branches) {
    for (const SeenBranch& b : branches) {
      if (a.number == b.number) continue;
      for (int p = 1; p <= largest; ++p) {
        for (int q = 1; q <= p; ++q) {
          const bool is_other_way_round = p == q && a.number > b.number;
          if (std::gcd(p, q) == 1 && !is_other_way_round) add_meetings(a, b, p, q, found);
        }
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& x, const auto& y) { return x.speed < y.speed; });
  return found;
}

}  // namespace whirl::inline fe

#include "libfe/resonance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Senses in which a mode is seen: 1 forward, -1 backward.
std::vector<int> senses(Whirl whirl) {
  if (whirl == Whirl::forward) return {1};
  if (whirl == Whirl::backward) return {-1};
  return {1, -1};
}

}  // namespace

std::vector<InternalResonance> internal_resonances(const Campbell& diagram, int largest) {
  const std::vector<double>& speeds = diagram.speeds;
  std::vector<InternalResonance> found;
  const int branches = static_cast<int>(diagram.branches.size());
  for (int a = 0; a < branches; ++a) {
    for (int b = 0; b < branches; ++b) {
      const CampbellBranch &A = diagram.branches[static_cast<std::size_t>(a)],
                           &B = diagram.branches[static_cast<std::size_t>(b)];
      if (a == b) continue;
      for (int p = 1; p <= largest; ++p) {
        for (int q = 1; q <= p; ++q) {
          if (std::gcd(p, q) != 1 || (p == q && a > b)) continue;
          for (const int s : senses(A.whirl)) {
            for (const int t : senses(B.whirl)) {
              const auto seen = [&](const CampbellBranch& of, int sense, std::size_t i, double W) {
                return std::abs(W - sense * interpolated(speeds, of.frequency, i, W));
              };
              for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
                if (!std::isfinite(A.frequency[i] + A.frequency[i + 1] + B.frequency[i] +
                                   B.frequency[i + 1])) {
                  continue;
                }
                const auto gap = [&](double W) {
                  return q * seen(A, s, i, W) - p * seen(B, t, i, W);
                };
                double low = speeds[i], high = speeds[i + 1];
                const double at_low = gap(low);
                if ((at_low > 0.0) == (gap(high) > 0.0)) continue;
                for (int k = 0; k < 60 && high - low > 1e-12 * high; ++k) {
                  const double middle = 0.5 * (low + high);
                  ((gap(middle) > 0.0) == (at_low > 0.0) ? low : high) = middle;
                }
                const double W = 0.5 * (low + high), frequency = seen(B, t, i, W) / q;
                if (W > 0.0 && frequency > 1e-6 * W) found.push_back({W, p, q, a, b, frequency});
              }
            }
          }
        }
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& x, const auto& y) { return x.speed < y.speed; });
  return found;
}

}  // namespace whirl::inline fe

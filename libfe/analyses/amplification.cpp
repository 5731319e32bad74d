#include "libfe/analyses/amplification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline fe {

namespace {

/// Moves a peak to the top of the parabola through three samples.
void refine(const std::vector<double>& speeds, const Vec& a, Eigen::Index k, ResponsePeak& peak) {
  const auto s = [&](Eigen::Index i) { return speeds[static_cast<std::size_t>(i)]; };
  const double h0 = s(k - 1) - s(k), h1 = s(k + 1) - s(k);  // h0 < 0 < h1
  const double d0 = (a(k - 1) - a(k)) / h0, d1 = (a(k + 1) - a(k)) / h1;
  const double curvature = (d1 - d0) / (h1 - h0), slope = d0 - curvature * h0;
  if (!(curvature < 0.0)) return;
  const double step = std::clamp(-0.5 * slope / curvature, h0, h1);
  peak.speed = s(k) + step;
  peak.amplitude = a(k) + step * (slope + curvature * step);
}

/// Where a response falls to 0.707 of a peak, on one side; NaN if it does not.
double side(const std::vector<double>& speeds, const Vec& a, Eigen::Index k, int step,
            double limit) {
  for (; k + step >= 0 && k + step < a.size(); k += step) {
    if (a(k + step) > limit) continue;
    const double share = (a(k) - limit) / (a(k) - a(k + step));
    const double from = speeds[static_cast<std::size_t>(k)],
                 to = speeds[static_cast<std::size_t>(k + step)];
    return from + share * (to - from);
  }
  return nan;
}

/// Numbers of the speeds that are not the one before but for rounding.
std::vector<Eigen::Index> speeds_apart(const std::vector<double>& speeds) {
  std::vector<Eigen::Index> apart;
  for (Eigen::Index k = 0; k < std::ssize(speeds); ++k) {
    const double speed = speeds[static_cast<std::size_t>(k)];
    if (!apart.empty() &&
        speed <= (1.0 + same_speed) * speeds[static_cast<std::size_t>(apart.back())]) {
      continue;
    }
    apart.push_back(k);
  }
  return apart;
}

}  // namespace

std::vector<ResponsePeak> response_peaks(const std::vector<double>& all_speeds,
                                         const Mat& all_amplitudes, std::size_t most) {
  std::vector<ResponsePeak> peaks;
  if (all_amplitudes.size() == 0) return peaks;
  const std::vector<Eigen::Index> apart = speeds_apart(all_speeds);
  std::vector<double> speeds;
  for (const Eigen::Index k : apart) speeds.push_back(all_speeds[static_cast<std::size_t>(k)]);
  const Mat amplitude = all_amplitudes(Eigen::all, apart);
  const Vec largest = amplitude.colwise().maxCoeff().transpose();
  for (Eigen::Index k = 1; k + 1 < largest.size(); ++k) {
    if (!(largest(k) > largest(k - 1) && largest(k) >= largest(k + 1))) continue;
    ResponsePeak peak{.speed = speeds[static_cast<std::size_t>(k)], .amplitude = largest(k)};
    amplitude.col(k).maxCoeff(&peak.row);
    const Vec a = amplitude.row(peak.row).transpose();
    if (a(k) >= a(k - 1) && a(k) >= a(k + 1)) refine(speeds, a, k, peak);
    const double limit = peak.amplitude / std::numbers::sqrt2;
    peak.below = side(speeds, a, k, -1, limit);
    peak.above = side(speeds, a, k, +1, limit);
    const auto between = std::count_if(speeds.begin(), speeds.end(),
                                       [&](double s) { return s > peak.below && s < peak.above; });
    constexpr long least = 5;  // the factor is right to some percent then
    if (between < least) peak.below = peak.above = nan;
    peaks.push_back(peak);
  }
  return highest_peaks(std::move(peaks), most);
}

std::vector<ResponsePeak> highest_peaks(std::vector<ResponsePeak> peaks, std::size_t most) {
  std::stable_sort(peaks.begin(), peaks.end(), [](const ResponsePeak& a, const ResponsePeak& b) {
    return a.amplitude > b.amplitude;
  });
  if (peaks.size() > most) peaks.resize(most);
  std::sort(peaks.begin(), peaks.end(),
            [](const ResponsePeak& a, const ResponsePeak& b) { return a.speed < b.speed; });
  return peaks;
}

SeparationMargin separation_margin(const ResponsePeak& peak, double operating) {
  const double AF = peak.amplification();
  SeparationMargin margin{.actual = std::abs(operating - peak.speed) / operating,
                          .required = nan,
                          .is_below = peak.speed < operating};
  if (!std::isfinite(AF)) return margin;
  if (AF < least_amplification) {
    margin.required = 0.0;
    return margin;
  }
  const double share = 0.17 * (1.0 - 1.0 / (AF - 1.5));
  margin.required = margin.is_below ? std::min(share, 0.16) : std::min(0.10 + share, 0.26);
  return margin;
}

}  // namespace whirl::inline fe

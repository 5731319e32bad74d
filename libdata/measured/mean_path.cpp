#include "libdata/measured/mean_path.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline data {

namespace {

constexpr std::size_t fewest_revolutions = 4;  ///< of a window, as far as there are

/// Means of signals over a window that rises and falls smoothly.
class WindowMean {
 public:
  WindowMean(const Vec& time, double from, double to) {
    const auto begin = std::lower_bound(time.begin(), time.end(), from);
    first_ = begin - time.begin();
    weights_.resize(std::lower_bound(begin, time.end(), to) - begin);
    for (Eigen::Index j = 0; j < weights_.size(); ++j) {
      const double share = (time(first_ + j) - from) / (to - from);
      weights_(j) = 1.0 - std::cos(turn * share);
    }
    weights_ /= weights_.sum();
  }
  double of(const Vec& signal) const {
    return weights_.dot(signal.segment(first_, weights_.size()));
  }

 private:
  Eigen::Index first_ = 0;
  Vec weights_;
};

}  // namespace

MeanPath mean_path(const TurnedMotion& motion, std::size_t station, std::size_t most) {
  const std::vector<double> turns = motion.clock.turns();
  const StationMotion& of = *motion.stations.at(station);
  const std::size_t revolutions = turns.size() - 1;
  const std::size_t step = (revolutions + most - 1) / most;
  const std::size_t window = std::min(std::max(fewest_revolutions, 2 * step), revolutions);
  const auto points = static_cast<Eigen::Index>((revolutions - window) / step + 1);
  MeanPath path{Vec(points), Vec(points), Vec(points), Vec(points)};
  for (Eigen::Index k = 0; k < points; ++k) {
    const std::size_t first = static_cast<std::size_t>(k) * step;
    const double from = turns[first], to = turns[first + window];
    const WindowMean mean(motion.time, from, to);
    path.time(k) = 0.5 * (from + to);
    path.speed(k) = turn * static_cast<double>(window) / (to - from);
    path.x(k) = mean.of(of.x);
    path.y(k) = mean.of(of.y);
  }
  return path;
}

}  // namespace whirl::inline data

#include "libdata/fit/fit_spread.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline data {

double correlation_time(const Vec& samples) {
  const Eigen::Index n = samples.size();
  if (n < 4) return 1.0;
  const auto is_there = samples.array().isFinite();
  const double mean =
      is_there.select(samples.array(), 0.0).sum() / std::max(1.0, is_there.cast<double>().sum());
  const Vec e = is_there.select(samples.array() - mean, 0.0);
  const double square = e.squaredNorm();
  if (!(square > 0.0)) return 1.0;
  const auto correlation = [&](Eigen::Index lag) {
    return e.head(n - lag).dot(e.tail(n - lag)) / square;
  };
  double time = -1.0;  // the correlation of lag 0 counts once
  for (Eigen::Index lag = 0; lag + 1 < n / 2; lag += 2) {
    const double pair = correlation(lag) + correlation(lag + 1);
    if (pair <= 0.0) break;
    time += 2.0 * pair;
  }
  return std::max(time, 1.0);
}

double correlation_time(const std::vector<FitSource>& sources, const Fit& fit) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const FitRecord& record = sources[i].record;
    const Mat off = fit.records[i].predicted - record.readings;
    for (Eigen::Index probe = 0; probe < off.rows(); ++probe) {
      const auto row = off.row(probe).array();
      const double squares = row.isFinite().select(row.square(), 0.0).sum() /
                             (record.noise(probe) * record.noise(probe));
      sum += squares * correlation_time(Vec(off.row(probe).transpose()));
      weights += squares;
    }
  }
  return weights > 0.0 ? sum / weights : 1.0;
}

void widen(Fit& fit, double factor) {
  for (FittedParameter& p : fit.parameters) {
    p.standard_deviation *= factor;
    p.lower = p.value - factor * (p.value - p.lower);
    p.upper = p.value + factor * (p.upper - p.value);
    p.is_told = 0.5 * (p.upper - p.lower) < std::abs(p.value);
  }
  for (FitResidual& r : fit.records) r.offset_deviation *= factor;
}

}  // namespace whirl::inline data

#include "libdata/measured/prepared_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdata/measured/decimation.hpp"
#include "libdata/measured/speed_harmonics.hpp"

namespace whirl::inline data {

namespace {

/// What every sample must be, all problems in one go.
void require_numbers(const Mat& samples, double spacing, const RunningModes& found) {
  if (!(spacing > 0.0)) {
    throw OptionError(
        fmt::format("the time between samples is {:g} s, expected one above 0", spacing));
  }
  if (samples.cols() == 0 || samples.rows() == 0) throw ModelError({}, "", "the record is empty");
  std::vector<Problem> problems;
  for (Eigen::Index c = 0; c < samples.cols(); ++c) {
    const auto channel = samples.col(c).array();
    std::string message;
    const Eigen::Index bad = samples.rows() - channel.isFinite().count();
    if (bad > 0) {
      Eigen::Index first = 0;
      while (std::isfinite(channel(first))) ++first;
      message = fmt::format(
          "{} of {} samples {} no number, the first is sample {} at {:g} s; cut the record "
          "there or fill the gap",
          bad, samples.rows(), bad == 1 ? "is" : "are", first + 1,
          static_cast<double>(first) * spacing);
    } else if (channel.maxCoeff() == channel.minCoeff()) {
      message = fmt::format("is {:g} all the time; leave it out or look at its cable", channel(0));
    }
    if (message.empty()) continue;
    Problem& problem = problems.emplace_back();
    problem.key = found.channels[static_cast<std::size_t>(c)];
    problem.message = std::move(message);
  }
  if (!problems.empty()) throw ModelError(std::move(problems));
}

}  // namespace

PreparedRecord prepared(const Mat& samples, double spacing, const RunningModesOptions& o,
                        RunningModes& found) {
  require_numbers(samples, spacing, found);
  Mat kept = samples.rowwise() - samples.colwise().mean();
  if (o.phase.size() > 0) {
    found.speed = std::abs(mean_speed(o.phase, spacing));
  } else if (o.speed > 0.0) {
    found.speed = refined_speed(kept, spacing, o.speed, o.harmonics);
  }
  if (found.speed > 0.0) {
    found.harmonics = o.harmonics;
    found.are_harmonics_removed = o.removes_harmonics && o.harmonics > 0;
    if (found.are_harmonics_removed) {
      const Vec phase =
          o.phase.size() > 0 ? o.phase : constant_speed_phase(found.speed, spacing, samples.rows());
      kept = without_harmonics(kept, phase, o.harmonics);
    }
  }
  if (o.most_frequency > 0.0) {
    const double highest = std::numbers::pi / spacing;
    if (o.most_frequency >= highest) {
      throw OptionError(fmt::format(
          "frequencies up to {:g} Hz, but {:g} samples per second show those below {:g} Hz only",
          o.most_frequency / turn, 1.0 / spacing, 0.5 / spacing));
    }
    const int factor = static_cast<int>(0.8 * highest / o.most_frequency);
    if (factor > 1 && kept.rows() > 40L * factor) {
      kept = decimated(kept, factor);
      spacing *= factor;
    }
  }
  kept.rowwise() -= Eigen::RowVectorXd(kept.colwise().mean());
  const Eigen::RowVectorXd deviation =
      (kept.colwise().squaredNorm() / static_cast<double>(kept.rows())).cwiseSqrt();
  const Eigen::RowVectorXd before =
      (samples.rowwise() - samples.colwise().mean()).colwise().norm() /
      std::sqrt(static_cast<double>(samples.rows()));
  constexpr double nothing = 1e-9;
  for (Eigen::Index c = 0; c < kept.cols(); ++c) {
    if (deviation(c) > nothing * before(c)) continue;
    throw ModelError({}, found.channels[static_cast<std::size_t>(c)],
                     "has nothing but harmonics of the speed, which no mode can be told from");
  }
  return {kept * deviation.cwiseInverse().asDiagonal(), spacing, deviation};
}

}  // namespace whirl::inline data

#include "libdata/fit/steady_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/fourier.hpp"

namespace whirl::inline data {

namespace {

constexpr int least_periods = 4;         ///< whose scatter says how sure their average is
constexpr int least_per_revolution = 8;  ///< samples
constexpr int most_per_revolution = 256;
constexpr int bins_per_harmonic = 8;
constexpr double most_scatter = 1.5;  ///< of a steady motion, in noises
constexpr double even = 0.01;         ///< of a sample, by which a period may miss a whole number

std::string revolutions_text(int count) {
  return count == 1 ? "1 revolution" : fmt::format("{} revolutions", count);
}

/// Samples of whole periods, by period and by bin of the angle within it.
struct Folded {
  int periods = 0, bins = 0;
  std::vector<Eigen::Index> sample;  ///< of the record, those without a missing probe
  std::vector<Eigen::Index> period;  ///< of each of them
  std::vector<Eigen::Index> bin;
  Vec angle;  ///< 0 at the start of a period, 2 pi at its end, less than 0 for some of the first
              ///< bin

  Eigen::Index samples() const { return angle.size(); }
};

Folded fold(const FitRecord& record, double speed, const SteadyOptions& options) {
  const auto wrong = [&](std::string what) { return ModelError({}, record.name, std::move(what)); };
  const Eigen::Index last = record.times.size() - 1;
  if (speed == 0.0) throw wrong("was measured at rest, where no motion is periodic");
  if (options.revolutions < 1) throw wrong("needs a period of 1 revolution or more");
  if (last < 1) throw wrong("has no samples to average");
  const double period = turn / std::abs(speed) * options.revolutions;
  const double spacing = (record.times(last) - record.times(0)) / static_cast<double>(last);
  const double per_period = period / spacing;
  const double lasts = static_cast<double>(last + 1) / per_period;
  Folded folded;
  folded.periods = static_cast<int>(lasts + 0.5 / per_period);
  if (folded.periods < least_periods) {
    throw wrong(
        fmt::format("lasts {:.3g} periods of {}; a fit of a steady motion averages {} or more",
                    lasts, revolutions_text(options.revolutions), least_periods));
  }
  const int whole = static_cast<int>(per_period + even);
  folded.bins = options.readings > 0 ? options.readings
                                     : std::min(whole, most_per_revolution * options.revolutions);
  if (folded.bins > whole || folded.bins < least_per_revolution * options.revolutions) {
    throw wrong(fmt::format(
        "has {:.4g} samples a period of {}: too few for {} readings of it, {} or more a revolution "
        "are needed",
        per_period, revolutions_text(options.revolutions), folded.bins, least_per_revolution));
  }
  for (Eigen::Index probe = 0; probe < record.readings.rows(); ++probe) {
    if (record.readings.row(probe).array().isFinite().any()) continue;
    throw wrong(fmt::format("has no readings of probe {}", probe + 1));
  }
  std::vector<double> angles;
  for (Eigen::Index i = 0; i <= last; ++i) {
    // half a bin ahead, so that rounding does not push samples of the same angle apart
    const double ahead = 0.5 / folded.bins;
    const double passed = (record.times(i) - record.times(0)) / period + ahead;
    const double within = passed - std::floor(passed);
    if (passed - within >= folded.periods) break;
    if (!record.readings.col(i).array().isFinite().all()) continue;
    folded.sample.push_back(i);
    folded.period.push_back(std::lround(passed - within));
    folded.bin.push_back(
        std::min<Eigen::Index>(static_cast<Eigen::Index>(within * folded.bins), folded.bins - 1));
    angles.push_back(turn * (within - ahead));
  }
  if (std::ssize(angles) < least_periods * folded.bins) {
    throw wrong(fmt::format("has {} samples of all probes, too few for {} readings of a period",
                            angles.size(), folded.bins));
  }
  folded.angle = Vec::Map(angles.data(), std::ssize(angles));
  return folded;
}

/// Sums of something over the samples of each bin.
Vec bin_sums(const Folded& folded, const Vec& of_sample) {
  Vec sums = Vec::Zero(folded.bins);
  for (Eigen::Index i = 0; i < folded.samples(); ++i) {
    sums(folded.bin[static_cast<std::size_t>(i)]) += of_sample(i);
  }
  return sums;
}

/// What is left of one probe's samples about their average, summed by period and bin.
struct Scatter {
  Mat sums, counts;     ///< periods x bins
  double square = 0.0;  ///< mean square of a sample [m^2]
  double step = 0.0;    ///< mean square of the difference of successive samples [m^2]
  double error = 0.0;   ///< square of the standard error of a bin's mean, on the average [m^2]
};

Scatter scatter_of(const Folded& folded, const Vec& rest) {
  Scatter found{.sums = Mat::Zero(folded.periods, folded.bins),
                .counts = Mat::Zero(folded.periods, folded.bins)};
  double steps = 0.0;
  for (Eigen::Index i = 0; i < folded.samples(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    found.sums(folded.period[at], folded.bin[at]) += rest(i);
    found.counts(folded.period[at], folded.bin[at]) += 1.0;
    if (i == 0 || folded.sample[at] != folded.sample[at - 1] + 1) continue;
    found.step += std::pow(rest(i) - rest(i - 1), 2);
    steps += 1.0;
  }
  found.square = rest.squaredNorm() / static_cast<double>(folded.samples() - folded.bins);
  found.step /= std::max(steps, 1.0);
  double bins = 0.0;
  for (Eigen::Index b = 0; b < folded.bins; ++b) {
    const double visits = (found.counts.col(b).array() > 0.0).cast<double>().sum();
    if (visits < 2.0) continue;
    const double of_mean = found.sums.col(b).squaredNorm() / std::pow(found.counts.col(b).sum(), 2);
    found.error += of_mean * visits / (visits - 1.0);
    bins += 1.0;
  }
  found.error /= bins;
  return found;
}

/// The averages of classes of periods beside one another: how much more they differ than chance has
/// it.
struct Classes {
  double ratio = 0.0;       ///< of variances between classes and within them, about 1 by chance
  double deviation = 0.0;   ///< of the ratio by chance
  double difference = 0.0;  ///< of two successive averages, root mean square [m]

  bool differ() const { return ratio > 1.0 + improbable * deviation; }
};

/// @param class_of  of a period, 0 to count - 1
template <class ClassOf>
Classes compare_classes(const Scatter& scatter, int count, const ClassOf& class_of) {
  const Eigen::Index periods = scatter.sums.rows(), bins = scatter.sums.cols();
  Mat sums = Mat::Zero(count, bins), counts = Mat::Zero(count, bins);
  for (Eigen::Index p = 0; p < periods; ++p) {
    sums.row(class_of(p)) += scatter.sums.row(p);
    counts.row(class_of(p)) += scatter.counts.row(p);
  }
  const Mat means = sums.array() / counts.array().max(1.0);
  const double freedoms = count - 1, others = static_cast<double>(periods - count);
  // both variances as of a bin's mean
  const Mat shares = counts.array().rowwise() / counts.colwise().sum().array().max(1.0);
  const double squares =
      (shares.array() * means.array().square()).sum() / static_cast<double>(bins);
  const double between = squares / freedoms;
  const double within = (scatter.error * static_cast<double>(periods - 1) - squares) / others;
  const Mat differences = means.bottomRows(count - 1) - means.topRows(count - 1);
  return {.ratio = between / std::max(within, 1e-3 * between),
          .deviation = std::sqrt(2.0 / static_cast<double>(bins) * (1.0 / freedoms + 1.0 / others)),
          .difference = std::sqrt(differences.array().square().mean())};
}

/// Takes the mean of each period off, but for that of all.
void steady_the_offset(const Folded& folded, Vec& rest) {
  Vec sums = Vec::Zero(folded.periods), counts = Vec::Zero(folded.periods);
  for (Eigen::Index i = 0; i < folded.samples(); ++i) {
    const auto p = folded.period[static_cast<std::size_t>(i)];
    sums(p) += rest(i);
    counts(p) += 1.0;
  }
  const Vec means = sums.array() / counts.array().max(1.0);
  const double mean = rest.mean();
  for (Eigen::Index i = 0; i < folded.samples(); ++i) {
    rest(i) -= means(folded.period[static_cast<std::size_t>(i)]) - mean;
  }
}

/// The average of a record, and why its motion does not count as steady, if so.
struct Average {
  SteadyRecord found;
  std::string why_not{};
};

/// @param noise  of a probe, 0: unknown
std::string why_unsteady(const Scatter& scatter, const Classes& halves, double noise) {
  const double known = noise > 0.0 ? noise : std::sqrt(0.5 * scatter.step);
  const double sample = std::sqrt(scatter.square);
  const double bound = 2.0 * std::sqrt(scatter.error);
  const auto apart = [&](const Classes& classes, const char* what) {
    return fmt::format(
        "the averages over {} differ by {:.3g} m, where its noise lets them by {:.3g} m", what,
        classes.difference, bound);
  };
  const Eigen::Index periods = scatter.sums.rows();
  if (sample > most_scatter * known) {
    return fmt::format(
        "its samples scatter by {:.3g} m about the average of {} periods, which is "
        "{:.3g} times its noise",
        sample, periods, sample / known);
  }
  if (halves.differ()) return apart(halves, "the two halves of the record");
  for (const int each : {2, 3}) {
    const Classes classes =
        compare_classes(scatter, each, [&](Eigen::Index period) { return period % each; });
    if (classes.differ())
      return apart(classes, each == 2 ? "every second period" : "every third period");
  }
  return "";
}

/// A series with the means that samples have in bins: what makes up for where in a bin they are.
class BinnedSeries {
 public:
  explicit BinnedSeries(const Folded& folded)
      : folded_(folded),
        harmonics_(folded.bins / bins_per_harmonic),
        counts_(bin_sums(folded, Vec::Ones(folded.samples()))),
        angles_(means(folded.angle)),
        functions_(Mat::Zero(folded.bins, 2 * harmonics_ + 1)) {
    for (Eigen::Index i = 0; i < folded.samples(); ++i) {
      const auto b = folded.bin[static_cast<std::size_t>(i)];
      functions_.row(b) += harmonic_functions(folded.angle(i), harmonics_) / counts_(b);
    }
  }

  const Vec& counts() const { return counts_; }
  /// Mean angle of the samples of each bin.
  const Vec& angles() const { return angles_; }
  Vec means(const Vec& of_sample) const {
    return bin_sums(folded_, of_sample).cwiseQuotient(counts_.cwiseMax(1.0));
  }
  Vec coefficients(const Vec& samples) const { return least_squares(functions_, means(samples)); }
  /// The series at angles.
  Vec at(const Vec& angles, const Vec& coefficients) const {
    Vec values(angles.size());
    for (Eigen::Index i = 0; i < angles.size(); ++i) {
      values(i) = coefficients.dot(harmonic_functions(angles(i), harmonics_));
    }
    return values;
  }

 private:
  const Folded& folded_;
  int harmonics_;
  Vec counts_, angles_;
  Mat functions_;  ///< bins x (2 H + 1), means over the samples
};

Average average(const FitRecord& record, double speed, const SteadyOptions& options) {
  const Folded folded = fold(record, speed, options);
  const BinnedSeries binned(folded);
  const Eigen::Index probes = record.readings.rows();
  Average of{.found = {.period = record,
                       .periods = folded.periods,
                       .scatter = Vec(probes),
                       .drift = Vec(probes)}};
  FitRecord& period = of.found.period;
  Mat readings(probes, folded.bins);
  period.noise.resize(probes);
  for (Eigen::Index probe = 0; probe < probes; ++probe) {
    const Vec samples = record.readings.row(probe)(folded.sample).transpose();
    const Vec series = binned.coefficients(samples);
    Vec rest = samples - binned.at(folded.angle, series);
    if (!record.is_offset_known) steady_the_offset(folded, rest);
    const Vec means = binned.means(rest);
    readings.row(probe) = binned.at(binned.angles(), series) + means;
    rest -= means(folded.bin);

    const Scatter scatter = scatter_of(folded, rest);
    const Classes halves =
        compare_classes(scatter, 2, [&](Eigen::Index p) { return 2 * p < folded.periods ? 0 : 1; });
    of.found.scatter(probe) = std::sqrt(scatter.square);
    of.found.drift(probe) = halves.difference;
    period.noise(probe) = std::sqrt(scatter.error);
    const double noise = record.noise.size() > probe ? record.noise(probe) : 0.0;
    const std::string why = why_unsteady(scatter, halves, noise);
    if (of.why_not.empty() && !why.empty()) {
      of.why_not = fmt::format("at probe {} {}", probe + 1, why);
    }
  }

  std::vector<Eigen::Index> full;  // of bins that hardly a sample is in nothing is known
  for (Eigen::Index b = 0; b < folded.bins; ++b) {
    if (binned.counts()(b) >= 0.5 * binned.counts().mean()) full.push_back(b);
  }
  const Vec turned = options.revolutions * binned.angles()(full);  // of the rotor
  period.readings = readings(Eigen::all, full);
  period.times = record.times(0) + turned.array() / std::abs(speed);
  period.phase = record.phase + turned(0);
  period.period = options.revolutions;
  return of;
}

}  // namespace

SteadyRecord steady_record(const FitRecord& record, double speed, const SteadyOptions& options) {
  Average one = average(record, speed, options);
  if (one.why_not.empty()) return one.found;
  constexpr int longest = 4;  // periods that the true one may be
  std::string instead;
  for (int times = 2; times <= longest && one.found.periods / times >= least_periods; ++times) {
    const SteadyOptions longer{.revolutions = times * options.revolutions};
    if (!average(record, speed, longer).why_not.empty()) continue;
    instead = fmt::format("; it repeats after {}", revolutions_text(longer.revolutions));
    break;
  }
  throw ModelError({}, record.name,
                   fmt::format("does not repeat after {}: {}{}",
                               revolutions_text(options.revolutions), one.why_not, instead));
}

}  // namespace whirl::inline data

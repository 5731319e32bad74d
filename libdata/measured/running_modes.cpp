#include "libdata/measured/running_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "libbase/error.hpp"
#include "libbase/numerics/statistics.hpp"
#include "libdata/measured/prepared_record.hpp"
#include "libdata/measured/speed_harmonics.hpp"
#include "libdata/measured/subspace.hpp"

namespace whirl::inline data {

namespace {

void require_options(const RunningModesOptions& o, const Mat& samples) {
  const auto require = [](bool is_right, const std::string& message) {
    if (!is_right) throw OptionError(message);
  };
  require(o.channels.empty() || std::ssize(o.channels) == samples.cols(),
          fmt::format("{} names for {} channels", o.channels.size(), samples.cols()));
  require(o.phase.size() == 0 || o.phase.size() == samples.rows(),
          fmt::format("the phase of the rotor is known at {} of {} samples", o.phase.size(),
                      samples.rows()));
  require(o.phase.size() == 0 || o.phase(o.phase.size() - 1) != o.phase(0),
          "the phase of the rotor ends where it began: the rotor does not turn");
  require(o.most_frequency >= 0.0 && o.speed >= 0.0, "frequencies and speeds are 0 or more");
  require(o.share > 0.0 && o.share <= 1.0,
          fmt::format("a share of {:g} of all orders, expected above 0, 1 at most", o.share));
  require(o.limits.frequency > 0.0 && o.limits.damping > 0.0 && o.limits.mac > 0.0 &&
              o.limits.mac < 1.0,
          "limits of stability are above 0, that of the MAC below 1");
  require(o.stretches == 0 || o.stretches >= 3,
          fmt::format("{} stretches, expected none (0) or 3 and more", o.stretches));
  require(o.most_deviation > 0.0, "a standard deviation of 0 or less has no mode");
  require(o.segment >= 16, fmt::format("segments of {} samples, expected 16 or more", o.segment));
  require(o.harmonics >= 0, "a number of harmonics is 0 or more");
}

/// Block rows and orders, as asked for or as usual, that the samples suffice for.
void choose_size(const RunningModesOptions& o, const Mat& samples, RunningModes& found) {
  const auto channels = static_cast<int>(samples.cols());
  constexpr int usual_order = 60;
  found.block_rows = o.block_rows > 0 ? o.block_rows : usual_block_rows(channels);
  const int most = channels * (found.block_rows - 1);
  if (o.most_order > most) {
    throw OptionError(fmt::format(
        "models of order {} from {} channel{}: {} block rows allow {} at most, {} would do",
        o.most_order, channels, channels == 1 ? "" : "s", found.block_rows, most,
        (o.most_order + channels - 1) / channels + 1));
  }
  found.most_order = o.most_order > 0 ? o.most_order : std::min(usual_order, most);
  if (found.most_order < 4) {
    throw OptionError(
        fmt::format("models up to order {}, expected 4 or more: a mode takes two "
                    "orders, and stability is seen in several",
                    found.most_order));
  }
  const long needed = 2L * found.block_rows * (channels + 1) * std::max(1, o.stretches / 3);
  if (samples.rows() < needed) {
    throw ModelError(
        {}, "",
        fmt::format("the record is too short: {} samples{}, and {} block rows of {} channel{} with "
                    "{} stretches need {}; several hundred periods of the lowest mode are right",
                    samples.rows(), o.most_frequency > 0.0 ? " after thinning" : "",
                    found.block_rows, channels, channels == 1 ? "" : "s", o.stretches, needed));
  }
}

/// Whether a frequency is to be looked at.
bool is_of_interest(double frequency, const RunningModesOptions& o) {
  return o.most_frequency == 0.0 || frequency <= o.most_frequency;
}

/// Block rows whose lags go as far as the covariances do, to where they stay below half of the
/// largest one for half as long again: farther there is noise alone, of which models of high order
/// split modes.
void shorten_block_rows(const RunningModesOptions& o, const OutputProducts& all,
                        RunningModes& found) {
  constexpr double small = 0.5;
  constexpr int least = 20, few = 5;
  if (o.block_rows > 0) return;
  const auto lags = static_cast<int>(all.sums.size());
  double largest = 0.0;  // the first ones may be small: forward and backward motion go through zero
  for (int k = 1; k < lags; ++k) {
    largest = std::max(largest, all.sums[static_cast<std::size_t>(k)].norm());
  }
  int below = 0, last = 1;  // lags in a row, as covariances oscillate; the last large one
  const auto have_fallen = [&] { return below >= few && 2 * below >= last; };
  for (int k = 1; k < lags && !have_fallen(); ++k) {
    const bool is_large = all.sums[static_cast<std::size_t>(k)].norm() >= small * largest;
    below = is_large ? 0 : below + 1;
    if (is_large) last = k;
  }
  if (!have_fallen()) return;  // they go on
  const auto channels = static_cast<int>(found.channels.size());
  const int needed = o.most_order > 0 ? (o.most_order + channels - 1) / channels + 1 : 0;
  found.block_rows = std::min(found.block_rows, std::max({last / 2 + 1, least, needed}));
  found.most_order = std::min(found.most_order, channels * (found.block_rows - 1));
}

/// A shape in the units of the channels, its largest entry one.
CVec in_units(const CVec& shape, const Eigen::RowVectorXd& deviation) {
  CVec turned = shape.cwiseProduct(deviation.transpose());
  Eigen::Index largest = 0;
  turned.cwiseAbs().maxCoeff(&largest);
  return turned / turned(largest);
}

/// Standard deviation of numbers about their mean, as that of a population of so many.
double deviation_of(const std::vector<double>& values, double divisor) {
  const Eigen::Map<const Vec> v(values.data(), std::ssize(values));
  return std::sqrt((v.array() - v.mean()).square().sum() / divisor);
}

/// The mode that a cluster of poles is.
RunningMode mode_of(const std::vector<OrderPole>& poles, const std::vector<std::size_t>& cluster,
                    const StabilityLimits& limits) {
  std::vector<double> frequencies, dampings;
  for (const std::size_t i : cluster) {
    frequencies.push_back(poles[i].frequency());
    dampings.push_back(poles[i].damping_ratio());
  }
  const double omega = median_of(frequencies), zeta = median_of(dampings);
  const auto away = [&](std::size_t i) {
    return std::abs(poles[i].frequency() / omega - 1.0) / limits.frequency +
           std::abs(poles[i].damping_ratio() / zeta - 1.0) / limits.damping;
  };
  const std::size_t middle = *std::min_element(cluster.begin(), cluster.end(),
                                               [&](auto a, auto b) { return away(a) < away(b); });
  RunningMode mode;
  mode.lambda = {-zeta * omega / std::sqrt(1.0 - zeta * zeta), omega};
  mode.shape = poles[middle].shape;
  mode.order = poles[middle].order;
  mode.orders = static_cast<int>(cluster.size());
  const double others = std::max(1.0, static_cast<double>(cluster.size()) - 1.0);
  mode.frequency_scatter = deviation_of(frequencies, others);
  mode.damping_scatter = deviation_of(dampings, others);
  return mode;
}

/// Orders of a cluster, at most so many of them, evenly spread.
std::vector<int> some_orders(const std::vector<OrderPole>& poles,
                             const std::vector<std::size_t>& cluster) {
  constexpr std::size_t most = 7;
  const std::size_t count = std::min(most, cluster.size());
  std::vector<int> orders;
  for (std::size_t i = 0; i < count; ++i) {
    orders.push_back(poles[cluster[(2 * i + 1) * cluster.size() / (2 * count)]].order);
  }
  return orders;
}

/// Poles of models that are made when they are asked for.
class KnownPoles {
 public:
  KnownPoles(SubspaceModels models, double spacing)
      : models_(std::move(models)), spacing_(spacing) {}

  /// The one that is most like a mode; null where none is alike.
  const Pole* like(const Pole& mode, int order) {
    constexpr double alike = 0.3;  // pole_distance() of the same mode
    if (order > models_.most_order()) return nullptr;
    const auto [place, is_new] = of_order_.try_emplace(order);
    if (is_new) place->second = models_.poles(order, spacing_);
    const Pole* best = nullptr;
    double least = alike;
    for (const Pole& pole : place->second) {
      const double distance = pole_distance(mode, pole);
      if (distance < least) least = distance, best = &pole;
    }
    return best;
  }

 private:
  SubspaceModels models_;
  double spacing_;
  std::map<int, std::vector<Pole>> of_order_;
};

/// Standard deviations of modes: medians over some orders of models without one stretch of the
/// record.
void find_deviations(RunningModes& found, const std::vector<std::vector<std::size_t>>& clusters,
                     const std::vector<OutputProducts>& stretches, const OutputProducts& all) {
  std::vector<std::vector<double>> frequencies(clusters.size()), dampings(clusters.size());
  for (const OutputProducts& stretch : stretches) {
    OutputProducts others = all;
    others -= stretch;
    KnownPoles known({others, found.block_rows, found.most_order}, 1.0 / found.rate);
    for (std::size_t m = 0; m < clusters.size(); ++m) {
      std::vector<double> frequency, damping;
      for (const int order : some_orders(found.poles, clusters[m])) {
        const Pole* pole = known.like(found.modes[m], order);
        if (!pole) continue;
        frequency.push_back(pole->frequency());
        damping.push_back(pole->damping_ratio());
      }
      if (frequency.empty()) continue;
      frequencies[m].push_back(median_of(frequency));
      dampings[m].push_back(median_of(damping));
    }
  }
  for (std::size_t m = 0; m < clusters.size(); ++m) {
    const double n = static_cast<double>(frequencies[m].size());
    if (frequencies[m].size() < stretches.size()) continue;  // not found without one of them
    found.modes[m].frequency_deviation = deviation_of(frequencies[m], n / (n - 1.0));
    found.modes[m].damping_deviation = deviation_of(dampings[m], n / (n - 1.0));
  }
}

/// Leaves modes whose eigenvalues are known closely enough, and numbers their poles.
void keep_known(RunningModes& found, const std::vector<std::vector<std::size_t>>& clusters,
                const RunningModesOptions& o) {
  std::vector<RunningMode> kept;
  for (std::size_t m = 0; m < clusters.size(); ++m) {
    const RunningMode& mode = found.modes[m];
    const double deviation =
        std::hypot(mode.frequency_deviation, mode.damping_deviation * std::abs(mode.lambda));
    const bool is_known = deviation <= o.most_deviation * -mode.lambda.real();
    if (o.stretches > 0 && !is_known) continue;
    for (const std::size_t i : clusters[m]) found.poles[i].mode = static_cast<int>(kept.size());
    kept.push_back(mode);
  }
  found.modes = std::move(kept);
}

/// Products of a record in stretches of equal length; one stretch if none are asked for.
std::vector<OutputProducts> products_of(const Mat& samples, int lags, int stretches) {
  const Eigen::Index count = samples.rows() - lags + 1, parts = std::max(1, stretches);
  std::vector<OutputProducts> products;
  for (Eigen::Index i = 0; i < parts; ++i) {
    const Eigen::Index first = i * count / parts, next = (i + 1) * count / parts;
    products.push_back(output_products(samples, lags, first, next - first));
  }
  return products;
}

/// Poles of all orders with their flags.
std::vector<OrderPole> diagram_poles(const SubspaceModels& models, double spacing,
                                     const RunningModesOptions& o, const RunningModes& found) {
  std::vector<std::vector<OrderPole>> orders;
  for (int n = 2; n <= models.most_order(); n += 2) {
    std::vector<OrderPole>& of_order = orders.emplace_back();
    for (Pole& pole : models.poles(n, spacing)) {
      // what turns forever has no damping, but for rounding
      const bool may_last = pole.damping_ratio() > -line_damping;
      if (!may_last || !is_of_interest(pole.frequency(), o)) continue;
      const int harmonic = harmonic_at(pole.frequency(), pole.damping_ratio(), found.speed,
                                       found.harmonics, o.limits.frequency);
      of_order.push_back({std::move(pole), n});
      of_order.back().harmonic = harmonic;
    }
  }
  find_stable(orders, o.limits);
  std::vector<OrderPole> poles;
  for (auto& of_order : orders) {
    std::move(of_order.begin(), of_order.end(), std::back_inserter(poles));
  }
  return poles;
}

}  // namespace

const DecomposedMode* RunningModes::peak_of(const RunningMode& mode) const {
  constexpr double within = 0.03, alike = 0.8;
  const DecomposedMode* nearest = nullptr;
  double least = within * mode.frequency();
  for (const DecomposedMode& peak : peaks) {
    // a peak whose neighborhood tells nothing is where its line is
    const double frequency = std::isfinite(peak.frequency()) ? peak.frequency() : peak.line;
    const double away = std::abs(frequency - mode.frequency());
    if (away < least && channel_mac(peak.shape, mode.shape) >= alike) least = away, nearest = &peak;
  }
  return nearest;
}

int usual_block_rows(Eigen::Index channels) {
  return static_cast<int>(std::clamp<Eigen::Index>(240 / channels, 20, 100));
}

RunningModes running_modes(const Mat& samples, double spacing, const RunningModesOptions& options) {
  require_options(options, samples);
  RunningModes found;
  found.channels = options.channels;
  for (Eigen::Index c = std::ssize(found.channels); c < samples.cols(); ++c) {
    found.channels.push_back(fmt::format("channel {}", c + 1));
  }
  found.duration = static_cast<double>(samples.rows()) * spacing;
  const PreparedRecord record = prepared(samples, spacing, options, found);
  found.rate = 1.0 / record.spacing;
  choose_size(options, record.samples, found);

  const auto stretches = products_of(record.samples, 2 * found.block_rows, options.stretches);
  OutputProducts all;
  for (const OutputProducts& stretch : stretches) all += stretch;
  shorten_block_rows(options, all, found);
  const SubspaceModels models(all, found.block_rows, found.most_order);
  found.most_order = models.most_order();
  found.poles = diagram_poles(models, record.spacing, options, found);
  const auto clusters =
      clustered_modes(found.poles, options.limits, found.most_order / 2, options.share);
  for (const auto& cluster : clusters) {
    found.modes.push_back(mode_of(found.poles, cluster, options.limits));
  }
  if (options.stretches > 0) find_deviations(found, clusters, stretches, all);
  keep_known(found, clusters, options);
  for (RunningMode& mode : found.modes) mode.shape = in_units(mode.shape, record.deviation);

  constexpr Eigen::Index least = 8;  // segments, of which the spectra are means
  const CrossSpectra spectra =
      cross_spectra(record.samples, record.spacing,
                    std::min<Eigen::Index>(options.segment, record.samples.rows() / least));
  const Decomposition d = decomposed(spectra);
  found.singular_values = d.values;
  for (Eigen::Index k = 0; k < d.values.cols(); ++k) {
    found.lines.push_back(static_cast<double>(k) * d.bin);
  }
  found.peaks = decomposed_modes(spectra, d);
  std::erase_if(found.peaks,
                [&](const DecomposedMode& peak) { return !is_of_interest(peak.line, options); });
  for (DecomposedMode& peak : found.peaks) peak.shape = in_units(peak.shape, record.deviation);
  return found;
}

}  // namespace whirl::inline data

#include "libdata/measured/measured_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/statistics.hpp"

namespace whirl::inline data {

namespace {

constexpr long clipped_run = 3;          ///< samples at the limit one after the other
constexpr double clipped_step = 2.0;     ///< of the smallest step, beyond which a limit was met
constexpr double usual_share = 0.99;     ///< of the steps, that spikes are compared with
constexpr double spike_step = 5.0;       ///< of the largest usual step
constexpr double spike_deviation = 3.0;  ///< of the standard deviation

/// The smallest step between neighbors; 0: there is none.
double smallest_step(const Vec& samples) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 1; j < samples.size(); ++j) {
    const double step = std::abs(samples(j) - samples(j - 1));
    if (step > 0.0) least = std::min(least, step);
  }
  return std::isfinite(least) ? least : 0.0;
}

/// The mean step with which a signal leaves runs at a limit; 0: there are no runs.
double step_to(const Vec& samples, double limit) {
  double steps = 0.0;
  long runs = 0, at_limit = 0;
  for (Eigen::Index j = 0; j < samples.size(); ++j) {
    if (samples(j) == limit) {
      ++at_limit;
      continue;
    }
    if (at_limit >= clipped_run) {
      steps += std::abs(samples(j) - limit);
      ++runs;
    }
    at_limit = 0;
  }
  return runs > 0 ? steps / static_cast<double>(runs) : 0.0;
}

}  // namespace

std::string MeasuredRecord::channel_list() const {
  std::string list;
  for (const MeasuredChannel& c : channels) {
    list += fmt::format("{}{}{}", list.empty() ? "" : ", ", c.name,
                        c.unit.empty() ? "" : fmt::format(" [{}]", c.unit));
  }
  return list;
}

std::optional<Eigen::Index> MeasuredRecord::channel(const std::string& name) const {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].is_called(name)) return static_cast<Eigen::Index>(i);
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool is_number = error == std::errc() && end == name.data() + name.size();
  if (!is_number || number < 1 || number > channels.size()) return std::nullopt;
  return static_cast<Eigen::Index>(number - 1);
}

std::string Gaps::text(const MeasuredRecord& record) const {
  return fmt::format("channel{} \"{}\": {} of {} samples are missing, the first at {:.6g} s",
                     channels.size() > 1 ? "s" : "", fmt::join(channels, "\", \""), missing.size(),
                     samples, record.time(missing.front()));
}

Vec filled(const Vec& samples) {
  Vec all = samples;
  const Eigen::Index n = samples.size();
  Eigen::Index last_known = -1;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!std::isfinite(samples(j))) continue;
    for (Eigen::Index k = last_known + 1; k < j; ++k) {
      const double share =
          static_cast<double>(k - last_known) / static_cast<double>(j - last_known);
      const double before = last_known < 0 ? samples(j) : samples(last_known);
      all(k) = before + share * (samples(j) - before);
    }
    last_known = j;
  }
  if (last_known >= 0) all.tail(n - 1 - last_known).setConstant(samples(last_known));
  return all;
}

Vec without_gaps(const Vec& samples, const MeasuredRecord& record, const std::string& name,
                 std::vector<Gaps>& gaps) {
  const Eigen::Index n = samples.size();
  Gaps own{{name}, {}, n};
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!std::isfinite(samples(j))) own.missing.push_back(j);
  }
  if (own.missing.empty()) return samples;
  if (static_cast<double>(own.missing.size()) > most_missing * static_cast<double>(n)) {
    throw OptionError(
        fmt::format("{}; expected at most {:g} %", own.text(record), 100.0 * most_missing));
  }
  const auto alike = std::find_if(gaps.begin(), gaps.end(),
                                  [&](const Gaps& g) { return g.missing == own.missing; });
  if (alike == gaps.end()) {
    gaps.push_back(std::move(own));
  } else if (std::find(alike->channels.begin(), alike->channels.end(), name) ==
             alike->channels.end()) {
    alike->channels.push_back(name);
  }
  return filled(samples);
}

bool is_clipped(const Vec& samples) {
  if (samples.size() < clipped_run) return false;
  const double quantum = smallest_step(samples);
  if (quantum == 0.0) return false;
  return std::max(step_to(samples, samples.maxCoeff()), step_to(samples, samples.minCoeff())) >
         clipped_step * quantum;
}

bool always_ascends(const Eigen::Ref<const Vec>& samples) {
  constexpr Eigen::Index fewest = 16;
  const Eigen::Index n = samples.size();
  return n >= fewest && (samples.tail(n - 1).array() > samples.head(n - 1).array()).all();
}

Spikes spikes_in(const Vec& samples) {
  Spikes found;
  const Eigen::Index n = samples.size();
  if (n < 3) return found;
  const Vec steps = samples.tail(n - 1) - samples.head(n - 1);
  Vec sizes = steps.cwiseAbs();
  const auto usual = static_cast<Eigen::Index>(usual_share * static_cast<double>(n - 2));
  std::nth_element(sizes.begin(), sizes.begin() + usual, sizes.end());
  const double least = std::max({spike_step * sizes(usual), spike_step * smallest_step(samples),
                                 spike_deviation * standard_deviation(samples)});
  for (Eigen::Index j = 1; j + 1 < n; ++j) {
    const double in = steps(j - 1), out = steps(j);
    if (in * out >= 0.0 || std::abs(in) < least || std::abs(out) < least) continue;
    if (++found.count == 1) found.first = j;
  }
  return found;
}

}  // namespace whirl::inline data

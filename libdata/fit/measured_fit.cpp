#include "libdata/fit/measured_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <random>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/random.hpp"
#include "libbase/numerics/spectrum.hpp"
#include "libbase/numerics/statistics.hpp"
#include "libbase/processes/work_queue.hpp"
#include "libdata/fit/fit_notes.hpp"
#include "libdata/fit/fit_spread.hpp"
#include "libdata/fit/model_source.hpp"
#include "libdata/fit/steady_record.hpp"
#include "libdata/measured/station_motion.hpp"

namespace whirl::inline data {

namespace {

constexpr double fewest_revolutions = 2.0;
constexpr Eigen::Index fewest_samples = 2;    ///< of a revolution
constexpr double changed_phase = 0.02;        ///< of the rotor against an even speed [rad]
constexpr double least_floor = 1e-4;          ///< of the deviation of what a probe reads
constexpr double even_weights = 1.3;          ///< ratio of noises up to which they count as known
constexpr double hang_together = 1.5;         ///< samples that count as one, from which it is told
constexpr double range_without_bounds = 0.5;  ///< of a value, to either side

/// Readings of the span, probes x samples.
Mat readings_in(const FitMeasurement& m) {
  return m.readings.displacement.middleRows(m.span.first, m.span.samples).transpose();
}

/// Samples of the span at which a probe reads nothing.
std::vector<Eigen::Index> missing_in(const FitMeasurement& m, Eigen::Index probe) {
  std::vector<Eigen::Index> all;
  if (m.readings.missing.empty()) return all;
  for (const Eigen::Index sample : m.readings.missing[static_cast<std::size_t>(probe)]) {
    const Eigen::Index place = sample - m.span.first;
    if (place >= 0 && place < m.span.samples) all.push_back(place);
  }
  return all;
}

FitRecord fit_record(const FitMeasurement& m, const MeasuredFitOptions& options) {
  const auto& noise = options.noise;
  const FitSpan& span = m.span;
  FitRecord record;
  record.name = m.name;
  record.readings = readings_in(m);
  record.phase = span.phase;
  record.is_offset_known = !options.finds_offsets;
  record.times =
      Vec::LinSpaced(span.samples, 0.0, static_cast<double>(span.samples - 1)) / m.readings.rate;
  record.noise.resize(record.readings.rows());
  for (Eigen::Index probe = 0; probe < record.readings.rows(); ++probe) {
    const Vec samples = record.readings.row(probe).transpose();
    const double deviation = standard_deviation(samples);
    double& own = record.noise(probe);
    own = !noise               ? std::max(noise_floor(samples), least_floor * deviation)
          : noise->is_relative ? noise->value * deviation
                               : noise->value;
    if (own > 0.0) continue;
    throw OptionError(fmt::format("{}: probe \"{}\" reads one value all the time: take it out",
                                  m.name, m.readings.probes[static_cast<std::size_t>(probe)].name));
  }
  for (Eigen::Index probe = 0; probe < record.readings.rows(); ++probe) {
    for (const Eigen::Index place : missing_in(m, probe)) {
      record.readings(probe, place) = std::nan("");
    }
  }
  if (options.period == 0) return record;
  return steady_record(record, span.speed, {.revolutions = options.period}).period;
}

/// Starts of a search: those of the parameters, then some between their bounds.
std::vector<std::vector<FreeParameter>> starts_of(const std::vector<FreeParameter>& parameters,
                                                  const MeasuredFitOptions& options) {
  std::vector<std::vector<FreeParameter>> starts(static_cast<std::size_t>(options.starts),
                                                 parameters);
  std::mt19937_64 random(options.seed);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    for (FreeParameter& p : starts[i]) {
      const double around = range_without_bounds * (p.start != 0.0 ? std::abs(p.start) : p.size);
      const bool is_low_told = std::isfinite(p.lower) && !p.is_lower_general;
      const double low =
          is_low_told ? p.lower : std::max(std::min(p.start - around, p.upper), p.lower);
      const double high = std::isfinite(p.upper) ? p.upper : std::max(p.start + around, p.lower);
      const double share = random_share(random);
      p.start = low > 0.0 ? low * std::pow(high / low, share) : low + share * (high - low);
    }
  }
  return starts;
}

bool is_better(const Fit& a, const Fit& b) {
  if (a.has_converged != b.has_converged) return a.has_converged;
  constexpr double same = 0.01;
  return a.log_likelihood > b.log_likelihood + same;
}

/// Whether two fits end at the same values.
bool are_same(const Fit& a, const Fit& b) {
  for (std::size_t p = 0; p < a.parameters.size(); ++p) {
    const double off = std::abs(a.parameters[p].value - b.parameters[p].value);
    if (off > b.parameters[p].standard_deviation) return false;
  }
  return true;
}

/// The best fit of all starts, the first one of those that are as good.
Fit best_fit(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& parameters,
             const MeasuredFitOptions& options, int& same_end) {
  const FitOptions& asked = options.search;
  if (options.starts == 1) {
    Fit only = fit(sources, parameters, asked);
    same_end = only.has_converged ? 1 : 0;
    return only;
  }
  const auto starts = starts_of(parameters, options);
  std::vector<Fit> fits(starts.size());
  std::atomic<bool> is_over = false;  // who asks and shows is this thread alone
  FitOptions each = asked;
  each.is_stopped = [&is_over] { return is_over.load(); };
  each.progress = {};
  {
    WorkQueue<std::pair<std::size_t, Fit>> queue(options.threads);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      queue.add([&sources, &each, &start = starts[i], i] {
        return std::pair(i, fit(sources, start, each));
      });
    }
    for (long finished = 0; queue.has_open();) {
      constexpr std::chrono::milliseconds patience(100);
      if (auto done = queue.take(patience)) {
        fits[done->first] = std::move(done->second);
        if (asked.progress) asked.progress(++finished, options.starts);
      }
      if (asked.is_stopped && asked.is_stopped()) is_over = true;
    }
  }
  const Fit* best = &fits.front();
  for (const Fit& one : fits) {
    if (is_better(one, *best)) best = &one;
  }
  same_end = static_cast<int>(std::count_if(fits.begin(), fits.end(), [&](const Fit& one) {
    return one.has_converged && are_same(one, *best);
  }));
  return *best;
}

/// Takes what is left of each probe as its noise.
/// @return  whether weights change by it
bool take_noise(const Fit& fit, std::vector<FitSource>& sources) {
  double least = HUGE_VAL, most = 0.0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Vec& noise = sources[i].record.noise;
    const Vec ratio = fit.records[i].of_probe.cwiseQuotient(noise);
    least = std::min(least, ratio.minCoeff());
    most = std::max(most, ratio.maxCoeff());
    noise = fit.records[i].of_probe;
  }
  return most > even_weights * least;
}

/// The logarithm of the likelihood where the noise of each probe is what is left of it.
double concentrated_likelihood(const std::vector<FitSource>& sources, const Fit& fit) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Mat& readings = sources[i].record.readings;
    for (Eigen::Index probe = 0; probe < readings.rows(); ++probe) {
      const auto count = static_cast<double>(readings.row(probe).array().isFinite().count());
      const double left = fit.records[i].of_probe(probe);
      sum -= 0.5 * count * (std::log(turn * left * left) + 1.0);
    }
  }
  return sum;
}

Vec padded(const Vec& values, Eigen::Index size) {
  Vec all = Vec::Constant(size, std::nan(""));
  all.head(values.size()) = values;
  return all;
}

std::vector<double> finite(const Vec& values) {
  std::vector<double> all;
  std::copy_if(values.begin(), values.end(), std::back_inserter(all),
               [](double v) { return std::isfinite(v); });
  return all;
}

/// Motions of stations, from readings of the span.
/// @param displacement  samples x probes
StationRecord stations_of(const FitMeasurement& m, Mat displacement) {
  const ProbeReadings readings{.rate = m.readings.rate,
                               .probes = m.readings.probes,
                               .displacement = std::move(displacement)};
  return station_record(readings, m.scene->assembler);
}

/// How many samples nobody knows.
long missing_samples(const std::vector<FitMeasurement>& measurements) {
  long count = 0;
  for (const FitMeasurement& m : measurements) {
    for (Eigen::Index p = 0; p < std::ssize(m.readings.probes); ++p) {
      count += std::ssize(missing_in(m, p));
    }
  }
  return count;
}

/// What was measured and what was found, side by side.
void add_motions(MeasuredFit& found, const std::vector<FitMeasurement>& measurements,
                 const std::vector<FitSource>& sources) {
  Eigen::Index samples = 0;
  for (const FitSource& source : sources) samples = std::max(samples, source.record.times.size());
  double left = 0.0, all = 0.0, over_floors = 0.0;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const FitMeasurement& m = measurements[i];
    const FitRecord& record = sources[i].record;
    const int number = static_cast<int>(i);
    const double duration = static_cast<double>(m.span.samples - 1) / m.readings.rate;
    const double from = record.period > 0 ? 0.0 : m.readings.time(m.span.first);
    found.files.push_back({.file = m.name,
                           .speed = m.span.speed,
                           .revolutions = duration * m.span.speed / turn,
                           .period = record.period,
                           .time = padded((record.times.array() + from).matrix(), samples)});
    const Mat& predicted = found.records[i].predicted;
    for (std::size_t p = 0; p < m.readings.probes.size(); ++p) {
      const auto row = static_cast<Eigen::Index>(p);
      FittedProbe probe{m.readings.probes[p], number};
      probe.noise = record.noise(row);
      probe.residual = found.records[i].of_probe(row);
      const Vec measured = record.readings.row(row).transpose();
      probe.floor = noise_floor(filled(measured));
      probe.offset = found.records[i].offset(row);
      probe.offset_deviation = found.records[i].offset_deviation(row);
      probe.measured = padded(measured, samples);
      probe.predicted = padded(predicted.row(row).transpose(), samples);
      const std::vector<double> there = finite(measured);
      const double squares = probe.residual * probe.residual * static_cast<double>(there.size());
      left += squares;
      over_floors += squares / (probe.floor * probe.floor);
      const auto known = Vec::Map(there.data(), std::ssize(there)).array();
      all += (known - known.mean()).square().sum();
      found.probes.push_back(std::move(probe));
    }
    const StationRecord measured = stations_of(m, record.readings.transpose());
    const StationRecord read = stations_of(m, predicted.transpose());
    for (std::size_t s = 0; s < read.stations.size(); ++s) {
      const StationMotion &a = measured.stations[s], &b = read.stations[s];
      found.stations.push_back({.station = a.station,
                                .record = number,
                                .measured_x = padded(a.x, samples),
                                .measured_y = padded(a.y, samples),
                                .x = padded(b.x, samples),
                                .y = padded(b.y, samples)});
    }
  }
  found.explained = 1.0 - left / all;
  if (!found.is_noise_known) {
    found.residual = std::sqrt(over_floors / static_cast<double>(found.readings));
  }
}

/// A length that vectors of runout are measured by [m].
double runout_scale(const std::vector<FitSource>& sources) {
  double largest = 0.0;
  for (const FitSource& source : sources) {
    for (const auto& row : source.record.readings.rowwise()) {
      const std::vector<double> there = finite(row.transpose());
      largest = std::max(largest, standard_deviation(Vec::Map(there.data(), std::ssize(there))));
    }
  }
  return 0.1 * largest;
}

/// Lets deviations be those of what the model does not explain: errors that hang together tell less
/// than as many independent ones, and known noise may be smaller than what is left.
void widen_spread(const std::vector<FitSource>& sources, MeasuredFit& found) {
  const double together = correlation_time(sources, found);
  const double over_noise = found.is_noise_known ? std::max(found.residual, 1.0) : 1.0;
  const bool is_chance = found.is_noise_known && found.why_not.empty();
  if (is_chance || (together < hang_together && over_noise == 1.0)) return;
  found.spread = over_noise * std::sqrt(together < hang_together ? 1.0 : together);
  widen(found, found.spread);
  for (FittedProbe& probe : found.probes) probe.offset_deviation *= found.spread;
  found.notes.push_back(fmt::format(
      "deviations are {:.3g} times those of white noise: what is left is more than that, or hangs "
      "together over {:.3g} samples, as errors of the model or filtered noise do",
      found.spread, together));
}

/// Puts the vectors of runout apart from the values of the model.
void take_runout(const RunoutTerms& terms, std::size_t of_model, MeasuredFit& found) {
  if (found.parameters.size() <= of_model) return;
  const auto count = static_cast<Eigen::Index>(found.parameters.size() - of_model);
  Vec values(count), deviations(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const FittedParameter& part = found.parameters[of_model + static_cast<std::size_t>(i)];
    values(i) = part.value;
    deviations(i) = part.standard_deviation;
  }
  found.runouts = terms.vectors(values, deviations);
  found.parameters.resize(of_model);
  const auto kept = static_cast<Eigen::Index>(of_model);
  found.correlation = Mat(found.correlation.topLeftCorner(kept, kept));
}

}  // namespace

FitSpan fit_span(const ProbeReadings& readings, double speed, double from, double revolutions,
                 std::vector<std::string>& notes) {
  const double rate = readings.rate;
  double begin = readings.start, end = readings.time(readings.displacement.rows() - 1);
  if (readings.clock) {
    begin = std::max(begin, readings.clock->first());
    end = std::min(end, readings.clock->last());
    speed = readings.clock->mean_speed();
  } else {
    notes.push_back(
        "no key-phasor: the angle of the rotor at the first sample that is fitted to is taken to "
        "be zero; angles of unbalances have to be free, or right");
  }
  const double period = turn / speed;
  begin += from * period;
  if (revolutions > 0.0) end = std::min(end, begin + revolutions * period);
  FitSpan span{.speed = speed};
  span.first = static_cast<Eigen::Index>(std::ceil((begin - readings.start) * rate - 1e-6));
  const auto last = static_cast<Eigen::Index>(std::floor((end - readings.start) * rate + 1e-6));
  span.samples = last - span.first + 1;
  const double found = (end - begin) / period;
  constexpr double rounding = 1e-9;  // of times
  if (!(found >= fewest_revolutions * (1.0 - rounding)) || span.samples < 2 ||
      static_cast<double>(span.samples) < found * fewest_samples) {
    throw OptionError(fmt::format(
        "has {:.3g} revolutions after the first {:.3g}, of {:.3g} samples each; expected "
        "{} and {} at least",
        std::max(found, 0.0), from, period * rate, fewest_revolutions, fewest_samples));
  }
  if (!readings.clock) return span;
  const double t0 = readings.time(span.first), t1 = readings.time(last);
  span.phase = readings.clock->angle(t0);
  span.speed = (readings.clock->angle(t1) - span.phase) / (t1 - t0);
  double most = 0.0;
  for (Eigen::Index i = span.first; i <= last; ++i) {
    const double t = readings.time(i);
    most = std::max(most, std::abs(readings.clock->angle(t) - span.phase - span.speed * (t - t0)));
  }
  if (most > changed_phase) {
    notes.push_back(fmt::format(
        "the speed changes: the rotor is up to {:.2g} degrees off where it would be at {:.6g} rpm, "
        "at which the record is fitted to",
        most / degree, span.speed / rpm));
  }
  return span;
}

double noise_floor(const Vec& samples) {
  const Eigen::Index n = smooth_length(samples.size());
  const Vec last = samples.tail(n);
  const Spectrum s = hann_spectrum((last.array() - last.mean()).matrix().cast<Complex>(), 1.0);
  std::vector<double> powers;
  for (Eigen::Index k = n / 4; k < n / 2; ++k) powers.push_back(std::norm(s.lines(k)));
  if (powers.empty()) return 0.0;
  // of white noise a line under this window has 3 / (2 n) of the variance, its median ln 2 of that
  return std::sqrt(median_of(std::move(powers)) / std::log(2.0) * static_cast<double>(n) / 1.5);
}

MeasuredFit fit(const std::vector<FitMeasurement>& measurements,
                const std::vector<FreeParameter>& parameters, const MeasuredFitOptions& options) {
  std::vector<FitSource> sources;
  RunoutTerms terms(options.runout_orders);
  for (const FitMeasurement& m : measurements) {
    const Mat rows = probe_rows(m.readings.probes, *m.scene, m.scene->displacement_map());
    FitRecord record = fit_record(m, options);
    terms.assign(m.readings.probes, record);
    sources.push_back(model_source(std::move(record), m.scene, rows, parameters, m.model_at));
  }
  std::vector<FreeParameter> unknowns = parameters;
  for (FreeParameter& part : terms.parameters(runout_scale(sources))) {
    unknowns.push_back(std::move(part));
  }
  MeasuredFitOptions search = options;
  search.search.is_noise_known = options.noise || options.period > 0;
  MeasuredFit found;
  found.starts = options.starts;
  static_cast<Fit&>(found) = best_fit(sources, unknowns, search, found.same_end);
  found.is_noise_known = search.search.is_noise_known;
  if (!found.is_noise_known && found.has_converged) {
    if (take_noise(found, sources)) {
      std::vector<FreeParameter> nearer = unknowns;
      for (std::size_t p = 0; p < nearer.size(); ++p) nearer[p].start = found.parameters[p].value;
      static_cast<Fit&>(found) = fit(sources, nearer, search.search);
      for (std::size_t p = 0; p < nearer.size(); ++p) {
        found.parameters[p].start = unknowns[p].start;
      }
    }
    found.log_likelihood = concentrated_likelihood(sources, found);
  }
  add_motions(found, measurements, sources);
  if (const long missing = missing_samples(measurements); missing > 0) {
    found.notes.push_back(fmt::format(
        "{} missing sample{} left out of the fit, which lines are in place of elsewhere", missing,
        missing == 1 ? " is" : "s are"));
  }
  refuse_nonsense(found);
  widen_spread(sources, found);
  add_notes(found);
  take_runout(terms, parameters.size(), found);
  return found;
}

std::vector<FitCandidate> compared(const std::vector<MeasuredFit>& fits,
                                   const std::vector<std::string>& names) {
  std::vector<FitCandidate> all;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const MeasuredFit& fit = fits[i];
    const int free = static_cast<int>(fit.parameters.size() + 2 * fit.runouts.size());
    const double information =
        free * std::log(static_cast<double>(fit.readings)) - 2.0 * fit.log_likelihood;
    all.push_back({.model = names[i],
                   .has_converged = fit.has_converged,
                   .parameters = free,
                   .residual = fit.residual,
                   .log_likelihood = fit.log_likelihood,
                   .information = information});
    if (fit.has_converged) least = std::min(least, information);
  }
  double sum = 0.0;
  for (FitCandidate& c : all) {
    if (c.has_converged) sum += c.weight = std::exp(-0.5 * (c.information - least));
  }
  for (FitCandidate& c : all) c.weight /= sum;  // none converged: NaN
  return all;
}

}  // namespace whirl::inline data

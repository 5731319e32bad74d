#include "apps/verbs/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "libbase/constants.hpp"
#include "libdyn/measured/simulated_record.hpp"
#include "libio/measured/probe_file.hpp"
#include "libio/measured/record_file.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::inline cli {

namespace {

constexpr double other_speed = 0.01;   ///< of the key-phasor against the one that is given
constexpr double uneven_speed = 0.02;  ///< change of speed that smears lines of the speed

/// Gives the model the speed of the record, and says what is odd about it.
void take_speed(const Invocation& call, Model& model, ProbeReadings& readings) {
  const bool is_given = !call.text("speed").empty();
  if (!readings.clock) {
    require_speed(model);
    if (!is_given) {
      readings.notes.push_back(fmt::format(
          "no key-phasor and no --speed: the record is taken to be at the model's {:.6g} "
          "rpm",
          model.speed / rpm));
    }
    return;
  }
  const double speed = readings.clock->mean_speed();
  if (is_given && std::abs(model.speed / speed - 1.0) > other_speed) {
    readings.notes.push_back(
        fmt::format("--speed says {:.6g} rpm, the key-phasor {:.6g} rpm, which is taken",
                    model.speed / rpm, speed / rpm));
  }
  if (readings.clock->variation() > uneven_speed) {
    readings.notes.push_back(fmt::format(
        "the speed changes by {:.2g} % in the record: lines of the spectrum are smeared, "
        "and modes are those at its mean",
        100.0 * readings.clock->variation()));
  }
  model.speed = speed;
  model.has_speed = true;
}

}  // namespace

Parsed<double> MeasuredVerbOptions::parse_rate(const std::string& text) {
  if (const auto number = parse_as(text, ""); number && *number > 0.0) return number;
  const auto frequency = parse_as(text, "rad/s");
  if (frequency && *frequency > 0.0) return *frequency / hertz;
  return Parsed<double>::failed("expected samples per second, such as 5000 or 5 kHz");
}

Parsed<std::vector<double>> MeasuredVerbOptions::parse_orders(const std::string& text) {
  std::vector<double> orders;
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ',');) {
    const auto order = parse_as(one, "");
    if (!order || *order <= 0.0) {
      return Parsed<std::vector<double>>::failed("expected orders above zero, such as 1,2 or 0.5");
    }
    if (std::find(orders.begin(), orders.end(), *order) == orders.end()) orders.push_back(*order);
  }
  if (orders.empty()) return Parsed<std::vector<double>>::failed("expected orders, such as 1,2");
  return orders;
}

Parsed<double> RecordingVerbOptions::parse_noise(const std::string& text) {
  const bool is_percent = text.ends_with('%');
  const auto number = parse_as(is_percent ? text.substr(0, text.size() - 1) : text, "");
  if (!number || *number < 0.0) {
    return Parsed<double>::failed("expected a share of the signal, such as 1% or 0.01");
  }
  return is_percent ? 0.01 * *number : *number;
}

Measurement read_measurement(const Invocation& call, const MeasuredVerbOptions& options) {
  Measurement found{call.model(), {}};
  const MeasurementSetup setup =
      options.probes ? read_probe_file(*options.probes, found.model) : model_probes(found.model);
  found.readings = probe_readings(read_record(*options.measured, options.rate.value), setup);
  take_speed(call, found.model, found.readings);
  return found;
}

std::optional<OrderTracking> tracked_orders(const MeasuredVerbOptions& options,
                                            const ProbeReadings& readings) {
  if (!options.orders) {
    if (options.slow_roll) throw options.slow_roll.wrong("is for the orders that --orders names");
    return std::nullopt;
  }
  if (!readings.clock) {
    throw options.orders.wrong("needs a key-phasor: give the file of --probes a [keyphasor]");
  }
  return track_orders(readings, {.orders = *options.orders, .slow_roll = options.slow_roll.value});
}

std::optional<MeasurementSetup> recording_setup(const RecordingVerbOptions& options,
                                                const Model& model) {
  if (!options.out) {
    for (const bool is_given :
         {options.measure.is_given, options.noise.is_given, options.seed.is_given}) {
      if (is_given) {
        throw ModelError({"--measured-out"}, "",
                         "--measure, --noise and --seed are for the record that it names");
      }
    }
    return std::nullopt;
  }
  require_record_ending(*options.out);
  MeasurementSetup setup =
      options.measure ? read_probe_file(*options.measure, model) : model_probes(model);
  if (setup.probes.empty()) {
    throw ModelError({"--measured-out"}, "",
                     "has nothing to record: give --measure FILE.toml, or the model a [[probe]]");
  }
  return setup;
}

void write_recording(const Invocation& call, const RecordingVerbOptions& options,
                     const MeasurementSetup& setup, const Run& run, Report& report) {
  if (!run.has_motion()) return;
  const MeasuredRecord record = simulated_record(run, setup, {*options.noise, *options.seed});
  write_record(*options.out, record, call.picture_replaces());
  report.text += fmt::format("\n  record: {} ({} channels, {:.6g} samples per second, {:.4g} s)\n",
                             *options.out, record.channels.size(), record.rate, record.duration());
}

}  // namespace whirl::inline cli

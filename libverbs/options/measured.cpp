#include "libverbs/options/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "libbase/constants.hpp"
#include "libdyn/measured/simulated_record.hpp"
#include "libio/measured/probe_file.hpp"
#include "libio/measured/record_file.hpp"

namespace whirl::inline cli {

RecordSource source_of(const Invocation& call, const RecordVerbOptions& options) {
  return {.file = *options.measured,
          .probes = options.probes.value_or(""),
          .rate = options.rate.value,
          .has_speed = !call.text("speed").empty()};
}

Parsed<double> RecordVerbOptions::parse_rate(const std::string& text) {
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

#include "libverbs/options/measured.hpp"

#include <fmt/format.h>

#include "libdata/measured/simulated_record.hpp"
#include "libio/measured/probe_file.hpp"
#include "libio/measured/record_file.hpp"
#include "libio/results/columns.hpp"
#include "libio/texts/identification_text.hpp"
#include "libio/texts/machine_text.hpp"

namespace whirl::inline cli {

RecordSource source_of(const Invocation& call, const RecordVerbOptions& options) {
  return {.file = *options.measured,
          .probes = options.probes.value_or(""),
          .rate = options.rate.value,
          .has_speed = !call.text("speed").empty()};
}

namespace {

/// The orders that a call asks for; nothing: it asks for none.
std::optional<OrderTracking> tracked_orders(const MachineVerbOptions& options,
                                            const ProbeReadings& readings) {
  if (!options.orders) {
    constexpr const char* alone = "is for the orders that --orders names";
    if (options.slow_roll) throw options.slow_roll.wrong(alone);
    if (options.order_revolutions.is_given) throw options.order_revolutions.wrong(alone);
    if (options.order_step) throw options.order_step.wrong(alone);
    return std::nullopt;
  }
  if (!readings.clock) {
    throw options.orders.wrong("needs a key-phasor: give the file of --probes a [keyphasor]");
  }
  if (*options.order_revolutions < fewest_order_revolutions) {
    throw options.order_revolutions.wrong(
        fmt::format("expected {:g} or more", fewest_order_revolutions));
  }
  if (options.order_step && !(*options.order_step >= least_order_step)) {
    throw options.order_step.wrong(fmt::format("expected {:g} or more", least_order_step));
  }
  return track_orders(readings, {.orders = *options.orders,
                                 .revolutions = *options.order_revolutions,
                                 .step = options.order_step.value,
                                 .slow_roll = options.slow_roll.value});
}

}  // namespace

MachineFindings machine_findings(const MachineVerbOptions& options, const ProbeReadings& readings,
                                 double speed) {
  MachineFindings found;
  found.orders = tracked_orders(options, readings);
  if (!options.trend && !options.zones) {
    constexpr const char* alone = "is for --trend or --zones";
    if (options.alarm) throw options.alarm.wrong(alone);
    if (options.trip) throw options.trip.wrong(alone);
    return found;
  }
  if (options.alarm && options.trip && !(*options.alarm < *options.trip)) {
    throw options.trip.wrong("expected more than --alarm");
  }
  found.trend = trend_of(readings, {.speed = speed});
  found.trend->alarm = options.alarm.value;
  found.trend->trip = options.trip.value;
  if (options.zones) found.zones = zones_of(*found.trend, *options.zones);
  return found;
}

void MachineFindings::tell(Report& report) const {
  if (orders) {
    report.record.set("orders", record_of(*orders));
    report.text += "\n" + text_of(*orders) + shapes_text(*orders) + model_curve_text(*orders);
  }
  if (trend) {
    report.record.set("trend", record_of(*trend));
    report.text += "\n" + text_of(*trend);
  }
  if (!zones) return;
  report.record.set("zones", record_of(*zones));
  report.text += "\n" + text_of(*zones);
  report.add_notes(notes_of(*zones));
}

void MachineFindings::write(ResultWriter& file) const {
  if (orders) write_result(file, *orders);
  if (trend) write_result(file, *trend);
  if (zones) write_result(file, *zones);
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

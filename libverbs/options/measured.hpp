#pragma once
/// What verbs share that take or write records of measurements.

#include <optional>
#include <string>

#include "libdata/measured/order_model.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdata/measured/trend.hpp"
#include "libdata/measured/zones.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libio/measured/measurement.hpp"
#include "libio/measured/record_values.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/option.hpp"
#include "libverbs/command/invocation.hpp"
#include "libverbs/options/common.hpp"

namespace whirl::inline cli {

/// Options that say which record a verb takes.
struct RecordVerbOptions {
  Option<std::string> measured = file_option(
      "measured", "FILE",
      "a record of a measurement instead of a simulation: .csv, .wav, .mat, .uff, .ufb, .h5, "
      ".lvm, .tdms");
  Option<std::string> probes =
      file_option("probes", "FILE",
                  "which channels of it are which probes: .toml, or a table, .csv or .xlsx; left "
                  "out: those of the model, by their "
                  "names");
  Option<double> rate{"rate", "R", "samples per second, where the record does not say it",
                      parse_sampling_rate};
  auto fields() { return std::tie(measured, probes, rate); }
};

/// The record of a call.
RecordSource source_of(const Invocation& call, const RecordVerbOptions& options);

/// What is asked of a machine in operation, of a record or of a simulation.
struct MachineVerbOptions {
  Option<std::vector<double>> orders{
      "orders", "Q,...", "multiples of the speed that are tracked along it, such as 1,2",
      parse_orders};
  Option<double> slow_roll{"slow-roll", "S",
                           "speed of the record whose readings are taken off these orders",
                           parse_frequency};
  Option<double> order_revolutions{"order-revolutions", "N",
                                   "of the record that each point of these orders is made of", 8.0,
                                   parse_revolutions};
  Option<double> order_step{"order-step", "N",
                            "revolutions from a point of these orders to the next; left out: 1 "
                            "along a run-up, half of --order-revolutions at a steady speed",
                            parse_revolutions};
  Flag trend{"trend", "overall, 1X and gap along the record, or of each record of a list"};
  Option<ZoneClass> zones{"zones", "CLASS",
                          "zones A to D of ISO 20816-3: shaft, or housing-1-rigid, -1-flexible, "
                          "-2-rigid, -2-flexible"};
  Option<double> alarm{"alarm", "P", "limit of the overall reading, peak to peak, such as 60um",
                       parse_length};
  Option<double> trip{"trip", "P", "limit above that one", parse_length};
  auto fields() {
    return std::tie(orders, slow_roll, order_revolutions, order_step, trend, zones, alarm, trip);
  }
};

/// Options of verbs that take a record and say what a machine does in it.
struct MeasuredVerbOptions {
  RecordVerbOptions record{};
  Option<ModelScale> model_curve{
      "model-curve", "HOW",
      "the model's unbalance response beside 1X of --orders: fit, times what fits best, or own, as "
      "the model has it"};
  auto fields() { return std::tie(record, model_curve); }
};

/// What was found of a machine in operation.
struct MachineFindings {
  std::optional<OrderTracking> orders{};
  std::optional<Trend> trend{};
  std::optional<ZoneReport> zones{};

  /// Adds what there is to a report.
  void tell(Report& report) const;
  /// Writes it.
  void write(ResultWriter& file) const;
};

/// What a call asks of readings.
/// @param speed  of the rotor where there is no key-phasor [rad/s]
/// @throws ModelError   for options of orders without these, and for orders without a key-phasor
/// @throws OptionError  as track_orders and trend_of
MachineFindings machine_findings(const MachineVerbOptions& options, const ProbeReadings& readings,
                                 double speed);

/// Options of verbs that write what a measurement of their motion would have recorded.
struct RecordingVerbOptions {
  Option<std::string> measure = going_with(
      "measured-out", file_option("measure", "FILE.toml",
                                  "probes whose readings of the motion --measured-out takes; left "
                                  "out: those of the model"));
  Option<std::string> out =
      output_option("measured-out", "FILE",
                    "a record as a measurement would have it: .csv, .wav, .mat, .uff, .ufb, .h5");
  Option<double> noise =
      going_with("measured-out", Option<double>{"noise", "P",
                                                "of each of its channels, such as 1%: standard "
                                                "deviation, of the signal's",
                                                0.0, parse_noise_share});
  Option<std::uint64_t> seed =
      going_with("measured-out", Option<std::uint64_t>{"seed", "S", "of the noise", 1, seed_range});
  auto fields() { return std::tie(measure, out, noise, seed); }
};

/// The probes that a motion is recorded with; nothing: it is not recorded.
/// @throws ModelError  for a wrong file of probes or ending, before the motion is computed
std::optional<MeasurementSetup> recording_setup(const RecordingVerbOptions& options,
                                                const Model& model);
/// Writes the record.
void write_recording(const Invocation& call, const RecordingVerbOptions& options,
                     const MeasurementSetup& setup, const Run& run, Report& report);

}  // namespace whirl::inline cli

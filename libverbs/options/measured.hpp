#pragma once
/// What verbs share that take or write records of measurements.

#include <optional>
#include <string>

#include "libdata/measured/order_tracking.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libio/measured/measurement.hpp"
#include "libio/measured/record_values.hpp"
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
      file_option("probes", "FILE.toml",
                  "which channels of it are which probes; left out: those of the model, by their "
                  "names");
  Option<double> rate{"rate", "R", "samples per second, where the record does not say it",
                      parse_sampling_rate};
  auto fields() { return std::tie(measured, probes, rate); }
};

/// The record of a call.
RecordSource source_of(const Invocation& call, const RecordVerbOptions& options);

/// Options of verbs that take a record and track orders along it.
struct MeasuredVerbOptions {
  RecordVerbOptions record{};
  Option<std::vector<double>> orders{
      "orders", "Q,...", "multiples of the speed that are tracked along it, such as 1,2",
      parse_orders};
  Option<double> slow_roll{"slow-roll", "S",
                           "speed of the record whose readings are taken off these orders",
                           parse_frequency};
  Option<double> order_revolutions{"order-revolutions", "N",
                                   "of the record that each point of these orders is made of", 8.0,
                                   parse_revolutions};
  auto fields() { return std::tie(record, orders, slow_roll, order_revolutions); }
};

/// The orders that a call asks for; nothing: it asks for none.
/// @throws ModelError   for options of orders without these, and for orders without a key-phasor
/// @throws OptionError  as track_orders
std::optional<OrderTracking> tracked_orders(const MeasuredVerbOptions& options,
                                            const ProbeReadings& readings);

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

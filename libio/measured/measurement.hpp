#pragma once
/// A measurement of a rotor: its model at the speed of a record, and what its probes read.

#include <optional>
#include <string>
#include <vector>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline io {

/// The files of a measurement, and what they do not say.
struct RecordSource {
  std::string file;                 ///< of the record
  std::string probes{};             ///< file of its probes; empty: the probes of the model
  std::optional<double> rate{};     ///< where the record does not say it [1/s]
  bool has_speed = false;           ///< whether the model's speed was given for this record
  std::vector<std::string> sets{};  ///< "PATH=VALUE" of the model, for this record
  Where sets_from{};                ///< place of `sets` in a list of records; empty: in none
};

/// A record, and where it is from.
struct SourcedRecord {
  RecordSource source;
  MeasuredRecord record;
};

struct Measurement {
  Model model;
  ProbeReadings readings;
};

/// Whether the file is a list of records.
bool is_list_of_records(const RecordSource& source);

/// What the probes read in a record. The speed is that of the key-phasor, or else the model's.
///
/// @param model  with what the source sets
/// @throws ModelError, FileError  for what is wrong in these files, and if nothing says the speed
Measurement measurement_of(Model model, const SourcedRecord& record);

/// The same of a record that is not read yet.
Measurement read_measurement(Model model, const RecordSource& source);

/// The model with some values set, "PATH=VALUE" each.
/// @throws ModelError  as parse_model
Model with_values(const Model& model, const std::vector<std::string>& sets);

/// The model with the values that a record sets.
/// @throws ModelError  as parse_model; what is wrong with these values is said of where they stand
Model model_for(const Model& model, const RecordSource& source);

/// Reads a record, or all of a list, a file that ends with .toml and has a [[record]] each:
///
///   file    of the record, from the folder of the list
///   probes  file of its probes; left out, the one that all have
///   speed   where there is no key-phasor
///   rate    samples per second, where the record does not say it
///   set     values of the model that differ in this record, ["disk.fan.unbalance=200g.mm"]
///
/// @param source  the file, and what holds where a record of the list says nothing
/// @throws ModelError, FileError  with every problem found in the list, and for what is wrong with
///                     a record
std::vector<SourcedRecord> read_records(const RecordSource& source);

}  // namespace whirl::inline io

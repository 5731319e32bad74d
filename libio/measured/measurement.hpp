#pragma once
/// A measurement of a rotor: its model at the speed of a record, and what its probes read.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libdyn/measured/probe_readings.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline io {

/// Where a measurement is.
struct RecordSource {
  std::string file;                 ///< of the record
  std::string probes{};             ///< file of its probes; empty: they are those of the model
  std::optional<double> rate{};     ///< where the record does not say it [1/s]
  bool has_speed = false;           ///< whether somebody said the model's speed for this record
  std::vector<std::string> sets{};  ///< "PATH=VALUE" of the model, for this record
};

struct Measurement {
  Model model;
  ProbeReadings readings;
};

/// Reads the record and its probes. The speed is that of the key-phasor, or else the model's.
///
/// @param model  with what the source sets
/// @throws ModelError, FileError  for what is wrong in these files, and if nothing says the speed
Measurement read_measurement(Model model, const RecordSource& source);

/// The model with some values set, "PATH=VALUE" each.
/// @throws ModelError  as parse_model
Model with_values(const Model& model, const std::vector<std::string>& sets);

/// Reads a list of records, [[record]] each:
///
///   file    of the record, from the folder of the list
///   probes  file of its probes; left out, the one that all have
///   speed   where there is no key-phasor
///   rate    samples per second, where the record does not say it
///   set     values of the model that are others then, ["disk.fan.unbalance=200g.mm"]
///
/// @param all  what holds where a record says nothing
/// @throws ModelError  with every problem found and its place in the file
std::vector<RecordSource> read_record_list(const std::filesystem::path& path,
                                           const RecordSource& all);

/// The records of such a list, a file that ends with .toml, or the one that any other file is.
std::vector<RecordSource> records_of(const RecordSource& source);

}  // namespace whirl::inline io

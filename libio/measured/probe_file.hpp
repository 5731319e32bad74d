#pragma once
/// Files that say which channel of a record is which probe of a model.

#include <filesystem>
#include <string>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/system/model.hpp"
#include "libio/model/config.hpp"

namespace whirl::inline io {

/// Reads a file of probes: [[probe]] as models have it, with `channel` (its name or number; left
/// out, the name of the probe), `gain` and `full_scale`, and [keyphasor]. A `full_scale` above all
/// tables is that of each that has none. A .csv, .tsv, .txt, .dat or .xlsx has them as rows, see
/// probe_table.
///
/// @param model  whose stations the probes are at
/// @throws ModelError  with every problem found and its place in the file
MeasurementSetup read_probe_file(const std::filesystem::path& path, const Model& model);

/// The same of a text.
/// @param name  of the file, for messages
MeasurementSetup parse_probe_file(const std::string& text, const std::string& name,
                                  const Model& model);

/// The same of a tree that has nothing else.
MeasurementSetup probes_in(ConfigNode root, const Model& model);

/// The probes of the model itself, each with the channel of its name.
MeasurementSetup model_probes(const Model& model);

}  // namespace whirl::inline io

#pragma once
/// Probes as engineers list them: a row per probe, in a sheet or a CSV.

#include <cstddef>
#include <string>

#include "libio/model/config.hpp"

namespace whirl::inline io {

/// The tree of a file of probes that has the same in it.
///
/// Columns, in any order and by the names of column_names.hpp: probe or name; position, or station
/// (the number of a node, or the name of a body); angle; and, if there are any, channel, gain,
/// unit, full_scale. A row without a place whose probe is a key-phasor ("keyphasor", "KPH",
/// "tacho", "trigger") is that. Angles and positions without a unit are rad and m, as everywhere.
///
/// @param file  for messages
/// @throws ModelError  for columns and cells that are wrong, with their places
ConfigNode probe_table(const std::string& text, const std::string& file);

/// How many columns of such a table a line names.
std::size_t probe_columns_named_in(const std::string& line);

}  // namespace whirl::inline io

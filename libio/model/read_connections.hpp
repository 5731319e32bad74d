#pragma once
/// Keys of bearings, seals and links.

#include <string_view>
#include <vector>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

/// The table of bearings or seals.
ModelTable connection_table(std::string_view name, std::string_view meaning,
                            void (*read)(ModelReading& reading));

/// All bearings or seals.
void read_connections(ModelReading& reading, const char* array, std::vector<Connection>& to);

/// The keys of a kind of coefficients.
/// @return  whether any is there
bool read_coefficients(ModelReading& reading, TableReader& table, AnyBearing& to);

/// The keys of what lies between two stations: coefficients, or rigid or clamped, one of which must
/// be there.
/// @param word  for messages: "link"
void read_link_keys(ModelReading& reading, TableReader& table, std::string_view word,
                    Connection& to);

}  // namespace whirl::inline io

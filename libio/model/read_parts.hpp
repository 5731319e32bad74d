#pragma once
/// Keys that several tables of model files have.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libio/model/model_reading.hpp"

namespace whirl::inline io {

/// A station at a key of its own: the name of a body, or a table with at, node or body.
/// @return  nothing: it is missing or wrong, which is reported
std::optional<Station> station_at(ModelReading& reading, TableReader& table, std::string_view key,
                                  bool may_be_ground);

/// The keys outer_diameter and inner_diameter of a part of the shaft.
/// @param instead  keys in whose presence they may be left out
void read_diameters(TableReader& table, Section& left, Section& right,
                    const std::vector<std::string>& instead, bool needs_inner);
/// The key shear_coefficient: a formula, or a number.
void read_shear(TableReader& table, ShearCoefficient& to);
/// The table at the key rayleigh.
void read_rayleigh(ModelReading& reading, TableReader& table, Rayleigh& to);

/// The keys offset, moment and phase of an unbalance.
/// @param mass  that an offset is one of; nothing: there must be none
std::optional<Unbalance> read_unbalance(TableReader& table, const Station& at,
                                        std::optional<double> mass);

/// The key `offset`, [x, y] of a circle's center [m].
Vec2 read_center(TableReader& table);

/// Reports a key that needs the tilts of its station, if the station is a body without tilts.
void need_tilts(const ModelReading& reading, TableReader& table, const char* key,
                const Station& at);

/// When a load begins: a time, or revolutions.
Beginning read_beginning(TableReader& table);

}  // namespace whirl::inline io

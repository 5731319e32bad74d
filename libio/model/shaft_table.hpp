#pragma once
/// Shafts as engineers keep them in spreadsheets: a row per segment, layers in rows of their own.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline io {

/// What a row says of the station at the left end of its segment.
struct StationCells {
  std::string station;  ///< its number or name; empty: not given
  std::string name;     ///< of the part; empty: not given
  double mass = 0.0, polar_inertia = 0.0, diametral_inertia = 0.0;  ///< of a disk [kg, kg.m^2]
  bool has_disk = false;
  double unbalance = 0.0, unbalance_angle = 0.0;  ///< [kg.m], [rad]
  /// Names of bearings, seals and probes of the model that are here.
  struct Named {
    std::string kind, name;
    int place = 1;  ///< of the cell in the line, from 1
  };
  std::vector<Named> named;
};

/// A row of a table: a segment, a layer on the segment of the row of layer 1 before it, or, as the
/// last row, the end of the shaft.
struct ShaftRow {
  int line = 0;         ///< in the file, from 1
  int layer = 1;        ///< 1: the shaft itself
  double length = 0.0;  ///< [m]
  Section left, right;
  std::string material;                     ///< name; empty: that of the whole table
  int material_place = 1, inner_place = 1;  ///< of the two cells in the line, from 1
  int elements = 0;                         ///< 0: not given
  Carries carries = Carries::both;
  Rayleigh damping;
  bool has_damping = false;
  StationCells at_left;
  bool is_end = false;  ///< no segment: what is at the right end of the last one
};

/// Reads a shaft from CSV.
///
/// Columns in any order, by these names or those of column_names.hpp: length, or position;
/// outer_diameter, or outer_left and outer_right; inner_diameter, or inner_left and inner_right;
/// material; layer; elements; carries; rayleigh_mass, rayleigh_stiffness; and of the station at the
/// left end of the row: added_mass, polar_inertia, diametral_inertia, unbalance, unbalance_angle,
/// name;
/// bearing, seal and probe name those of the model that are there. Only a length or position and an
/// outer diameter are needed. Rows follow one another from left to right; a row with a layer above
/// 1 lies on the last row of layer 1, and may leave its length out. The last row may be the end of
/// the shaft, without a length. See parse_delimited for the form of the lines.
///
/// @param file      for messages
/// @param problems  receives what is wrong, with its place; a problem of many rows only once
/// @param doubts    receives columns that are not read; null: not wanted
/// @return          rows; if there are problems, they are of no use
std::vector<ShaftRow> parse_shaft_table(const std::string& text, const std::string& file,
                                        std::vector<Problem>& problems,
                                        std::vector<Problem>* doubts = nullptr);

/// How many columns of such a table a line names.
std::size_t shaft_columns_named_in(const std::string& line);

}  // namespace whirl::inline io

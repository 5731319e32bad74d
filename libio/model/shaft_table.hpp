#pragma once
/// Shafts as engineers keep them in spreadsheets: a row per segment, layers in rows of their own.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline io {

/// A row of a table: a segment, or a layer on the segment of the row of layer 1 before it.
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
};

/// Reads a shaft from CSV.
///
/// The first line that is not a comment (#) names the columns, in any order, each with its unit in
/// brackets (without one, SI): length; outer_diameter, or outer_left and outer_right;
/// inner_diameter, or inner_left and inner_right; material; layer; elements; carries;
/// rayleigh_mass, rayleigh_stiffness. Only length and an outer diameter are needed. Rows follow one
/// another from left to right; a row with a layer above 1 lies on the last row of layer 1, and may
/// leave its length out. Numbers of stations or rows ("Sta. No.", "#") are not read; positions are
/// refused, as they are no lengths.
///
/// @param file      for messages
/// @param problems  receives what is wrong, with its place; a problem of many rows only once
/// @return          rows; if there are problems, they are of no use
std::vector<ShaftRow> parse_shaft_table(const std::string& text, const std::string& file,
                                        std::vector<Problem>& problems);

}  // namespace whirl::inline io

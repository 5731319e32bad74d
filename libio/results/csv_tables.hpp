#pragma once
/// A result as tables for spreadsheets.

#include <filesystem>
#include <optional>
#include <vector>

#include "libio/results/hdf5.hpp"
#include "libio/results/motion_window.hpp"

namespace whirl::inline io {

/// A text for a cell: one that a spreadsheet would take for a formula gets an apostrophe in front,
/// which spreadsheets take for "this is text".
std::string spreadsheet_text(const std::string& text);

/// A cell in quotation marks; quotation marks in it are doubled.
std::string csv_quoted(std::string_view cell);

/// Writes the groups of a result as "<stem>_<group>_<rows>.csv".
///
/// Datasets of a group that have the same axes of numbers (time, speed, the values of a study) are
/// one table, a row per point of these axes; names and counters along other axes (stations,
/// contacts, modes) become columns, as do the parts of complex numbers. The first line says what
/// stands in each column, with its SI unit: "x left disk [m]". Numbers are as exact as in the file;
/// what is not a number is left empty. Texts that begin like a formula (=, +, -, @) get an
/// apostrophe in front. Left out are datasets that only this program goes on from.
///
/// A table has no room for a mark of its origin: a table that is there may be replaced if its first
/// line is the same.
///
/// @param samples  of the motion, the rows of its tables; left out: all
/// @return  the files, in the order of the groups
/// @throws FileError  if one cannot be read or written
std::vector<std::filesystem::path> write_csv_tables(
    const ResultReader& result, const std::filesystem::path& stem,
    Replaces replaces = Replaces::own_pictures, const std::optional<MotionSamples>& samples = {});

}  // namespace whirl::inline io

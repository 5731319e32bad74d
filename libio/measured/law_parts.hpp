#pragma once
/// What formats of laws have in common: arrays and responses as they stand in a file become tables.

#include <filesystem>
#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/travel.hpp"
#include "libio/model/foreign_table.hpp"

namespace whirl::inline io {

/// Names of arrays that laws are made of, as files have them.
constexpr std::string_view law_array_names[] = {"A",     "B",         "C",        "D",
                                                "omega", "frequency", "response", "H"};
constexpr std::size_t most_law_rows = 100'000;  ///< of an array; frequencies of a response
constexpr std::size_t most_law_numbers = 4'000'000;

/// A matrix of a file.
struct LawArray {
  std::string name;  ///< one of law_array_names
  CMat values;       ///< of a response a row for each frequency, with the entries row by row
  bool is_complex = false;
  std::string unit{};  ///< as it is written
};

template <class Bytes>
void travel(Bytes& bytes, Is<LawArray> auto& array) {
  auto& [name, values, is_complex, unit] = array;
  bytes(name, values, is_complex, unit);
}

/// Checks that an array is not larger than it may be, before it is read.
/// @throws ModelError
void require_law_size(const std::string& file, const std::string& name,
                      const std::vector<std::size_t>& sizes);

/// A response as a table.
/// @param omega  ascending [rad/s]; what is not above zero is left out
/// @param H      a row for each frequency, with the entries of the matrix row by row
/// @throws ModelError  for numbers that are not finite, frequencies that do not ascend, and another
///                     number of entries
std::string response_text(const std::string& file, const Vec& omega, const CMat& H, int ports);

/// All arrays of laws in a file, or in a part of it.
/// @throws ModelError, FileError
std::vector<LawArray> matlab_law_arrays(const std::filesystem::path& file, const std::string& part);
std::vector<LawArray> hdf5_law_arrays(const std::filesystem::path& file, const std::string& part);

/// The response of a universal file.
/// @throws ModelError, FileError
ConvertedTable universal_response(const std::filesystem::path& file, const std::string& part,
                                  const ForeignTable& wanted);

}  // namespace whirl::inline io

#pragma once
/// What a result file holds: every dataset with its kind, its sizes and the values it can have.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

/// Number of the arrangement of result files, their root attribute `format`. It grows when an older
/// whirl would take a dataset for something else; datasets that are added do not count. Files
/// without the attribute are of the first one.
constexpr int result_format = 1;

/// A dataset or attribute of a result.
struct ResultEntry {
  std::string path;  ///< "/trajectory/x"; "/trajectory@period" is an attribute
  ObjectKind kind = ObjectKind::real;
  /// Its dimensions by name, "stations samples": dimensions of one name have one size throughout a
  /// file. "+" behind a name: at least one element. A number is a size. "point" stands for the
  /// dimensions of a study, one per axis. Attributes have none.
  std::string sizes;
  ValidValues values{};
  bool is_optional = false;  ///< else it is there wherever the first entry of its set is
  std::string unit{}, meaning{};
};

/// A dimension of an entry: its name and what it asks for.
struct DimensionName {
  std::string name;
  bool has_elements = false;  ///< at least one
};
/// The dimensions that a list says.
std::vector<DimensionName> dimensions_of(std::string_view sizes);

/// Entries that a file has together or not at all; the first one says which.
struct ResultSet {
  std::vector<ResultEntry> entries;
  std::vector<std::string> needs{};  ///< entries of other sets that must be there, too
};

/// All that whirl reads from results.
const std::vector<ResultSet>& result_schema();

/// Checks all of a result that the schema knows: nothing that reads it afterwards meets another
/// kind, other sizes, or codes of no meaning.
/// @throws FileError  that names the dataset and what is wrong with it; for files that hold no
///                    model
void check_result(const ResultReader& file);

/// Opens a result and checks it.
/// @throws FileError  as ResultReader and check_result
std::unique_ptr<ResultReader> open_result(const std::filesystem::path& path);

}  // namespace whirl::inline io

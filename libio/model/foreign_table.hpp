#pragma once
/// Tables of a model that are made of files of other programs, which libraries beyond this one
/// read.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libfe/parts/transfer_function.hpp"
#include "libio/text/table_file.hpp"

namespace whirl::inline io {

/// What a table has to be.
struct ForeignTable {
  enum class Kind {
    response,    ///< as parse_response_table reads it
    state_space  ///< as parse_state_space_table reads it
  };
  Kind kind = Kind::response;
  int ports = 1;                       ///< of a response: coordinates
  std::optional<TransferForm> form{};  ///< of a response, where the model says it
};

struct ConvertedTable {
  NamedText table;
  std::vector<std::string> doubts;  ///< what was taken for granted, in words
};

/// Makes a table of a file.
/// @param part  of the file, which stands behind a "#" in its name; empty: not said
/// @return      or what is wrong: "cannot read the file ..."
using ConvertFile = Parsed<ConvertedTable> (*)(const std::filesystem::path& file,
                                               const std::string& part, const ForeignTable& wanted);

/// The name of a file of another program, and the part of it that is meant.
struct ForeignName {
  std::string file, part{};
};

/// Splits a name at its "#"; nothing: its ending (.mat, .h5, .hdf5, .uff, .unv, .ufb) is none of
/// those of other programs.
std::optional<ForeignName> foreign_name(const std::string& name);

}  // namespace whirl::inline io

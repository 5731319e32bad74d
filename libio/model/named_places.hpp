#pragma once
/// Parts that a table of stations names: they are there if they do not say where they are.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline io {

/// A part and the station of its row.
struct NamedPlace {
  std::string kind, name;  ///< "bearing", its name or number
  Station at;
  Where where;
  bool is_taken = false;  ///< the model has such a part
};

/// The place of a part, which is taken then; null: no table names it.
/// @param path  of its station: "bearing.DE.at", of one without a name "bearing.1.at"
const NamedPlace* take_place(std::vector<NamedPlace>& places, const std::string& path);

/// What to say of parts that a table names and the model does not have.
std::vector<Problem> doubts_of(const std::vector<NamedPlace>& places);

}  // namespace whirl::inline io

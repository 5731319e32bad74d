#pragma once
/// Bearing tables that were asked for speeds they do not know.

#include <string>
#include <vector>

#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// A bearing, seal or link with a table that ends before some of the speeds.
struct ExceededTable {
  std::string name;                ///< "bearing left"
  double first = 0.0, last = 0.0;  ///< speeds between which the table is known [rad/s]
};

/// Tables held constant at their ends somewhere between two speeds [rad/s].
std::vector<ExceededTable> exceeded_tables(const Structure& structure, double lowest,
                                           double highest);

}  // namespace whirl::inline fe

#pragma once
/// Coexisting motions for JSON and for people, that with the largest share first.

#include <string>

#include "libdyn/studies/basins.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline cli {

Record basins_entries(const BasinsResult& result);
std::string basins_table(const BasinsResult& result);

}  // namespace whirl::inline cli

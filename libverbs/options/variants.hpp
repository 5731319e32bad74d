#pragma once
/// Other states of a machine, by values of its model that differ.

#include <vector>

#include "libdyn/linear/lateral_report.hpp"
#include "libio/text/option.hpp"
#include "libverbs/command/invocation.hpp"

namespace whirl::inline cli {

inline ListOption variants_option() {
  return {
      "variant", "NAME:PATH=VALUE;...",
      "the same for another state of the machine, such as \"minimum clearance: "
      "bearing.de.table=de_min.csv; bearing.nde.table=nde_min.csv\"; can be given several times"};
}

/// @throws ModelError  for a variant without a name or without values, and as read_model
std::vector<LateralVariant> variants_of(const Invocation& call, const ListOption& option,
                                        double speed);

}  // namespace whirl::inline cli

#include "libverbs/options/variants.hpp"

#include "libio/text/delimited.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline cli {

std::vector<LateralVariant> variants_of(const Invocation& call, const ListOption& option,
                                        double speed) {
  std::vector<LateralVariant> variants;
  for (const std::string& text : option.values) {
    const std::size_t colon = text.find(':');
    const std::string name(trimmed(text.substr(0, colon)));
    std::vector<std::string> sets;
    for (const std::string& set :
         split(colon == std::string::npos ? "" : text.substr(colon + 1), ';')) {
      if (!trimmed(set).empty()) sets.emplace_back(trimmed(set));
    }
    if (name.empty() || name.find('=') != std::string::npos || sets.empty()) {
      throw wrong_option("variant", text,
                         "expected a name and values of the model, such as \"maximum clearance: "
                         "bearing.de.table=de_max.csv; bearing.nde.table=nde_max.csv\"");
    }
    variants.push_back({name, call.variant(sets)});
    variants.back().model.speed = speed;
  }
  return variants;
}

}  // namespace whirl::inline cli

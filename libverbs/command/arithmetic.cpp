#include "libverbs/command/arithmetic.hpp"

#include "libbase/system/arithmetic.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline cli {

void adopt_arithmetic(const std::string& isa) {
  if (isa.empty()) return;
  use_instruction_set(parsed_option("isa", isa, [](const std::string& name) {
    return parse_instruction_set(name, instruction_sets());
  }));
  if (isa == baseline_set) use_portable_mathematics();
}

}  // namespace whirl::inline cli

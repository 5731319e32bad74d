#include <fmt/format.h>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

/// One damping ratio for all modes, or a list of them.
void read_modal_damping(TableReader& table, ModalDamping& modal) {
  modal = {};
  const ConfigNode* node = table.node("modal");
  if (node && node->kind == ConfigNode::Kind::array) {
    modal.ratios = table.list("modal", "", Range::nonnegative);
  } else if (const auto common = table.quantity("modal", "", Range::nonnegative)) {
    modal = {{*common}, true};
  }
  for (const double ratio : modal.ratios) {
    if (ratio < 1.0) continue;
    table.problem("modal", fmt::format("found {}, expected damping ratios below 1", ratio));
    break;
  }
}

void read_damping(ModelReading& reading) {
  TableReader table = reading.table("damping");
  read_rayleigh(reading, table, reading.model.structure.damping);
  read_modal_damping(table, reading.model.structure.modal_damping);
  table.finish();
}

}  // namespace

ModelTable damping_table() {
  return {.name = "damping",
          .meaning = "damping of the whole rotor",
          .form = ModelTable::Form::one,
          .read = read_damping,
          .bare = "rayleigh = {}\n",
          .as_tables = "modal = [0.1]\n",
          .notes = {{"rayleigh", "adds mass M + stiffness K to C"},
                    {"modal", "damping ratios of the modes at rest: one for all, or a list"}}};
}

}  // namespace whirl::inline io

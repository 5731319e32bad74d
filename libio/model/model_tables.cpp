// The tables of model files, in the order of the schema. A new one is a file in tables/ and a line
// here.

#include <fmt/format.h>

#include "libio/model/model_table.hpp"

// clang-format off
#define TABLES       \
  operation_table(), \
  material_table(),  \
  rotor_table(),     \
  shaft_table(),     \
  layer_table(),     \
  disk_table(),      \
  unbalance_table(), \
  force_table(),     \
  probe_table(),     \
  bow_table(),       \
  body_table(),      \
  bearing_table(),   \
  seal_table(),      \
  link_table(),      \
  coupling_table(),  \
  gear_table(),      \
  support_table(),   \
  magnetic_bearing_table(), \
  oil_film_table(),  \
  rolling_bearing_table(), \
  contact_table(),   \
  damping_table(),   \
  reduction_table(), \
  start_table(),     \
  report_table()
// clang-format on

namespace whirl::inline io {

// The list twice: as declarations of functions, each in the file of its table, and as their calls.
ModelTable TABLES;

const std::vector<ModelTable>& model_tables() {
  static const std::vector<ModelTable> all{TABLES};
  return all;
}

std::string ModelTable::header() const {
  switch (form) {
    case Form::one:
      return fmt::format("[{}]", name);
    case Form::several:
      return fmt::format("[[{}]]", name);
    default:
      return fmt::format("[{}.NAME]", name);
  }
}

std::string ModelTable::path() const {
  switch (form) {
    case Form::one:
      return std::string(name);
    case Form::several:
      return fmt::format("{}.[]", name);
    default:
      return fmt::format("{}.*", name);
  }
}

}  // namespace whirl::inline io

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

namespace {

void read_reduction(ModelReading& reading) {
  TableReader table = reading.table("reduction");
  table.read(reading.model.reduction);
  table.finish();
}

}  // namespace

ModelTable reduction_table() {
  return {.name = "reduction",
          .meaning = "how many shapes a simulation computes with",
          .form = ModelTable::Form::one,
          .read = read_reduction};
}

}  // namespace whirl::inline io

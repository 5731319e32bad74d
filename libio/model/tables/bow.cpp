#include "libio/model/bow_table.hpp"
#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

namespace {

void read_bow(ModelReading& reading) {
  TableReader table = reading.table("bow");
  const auto from = reading.text_of(table, "table", "bow", 0, bow_columns_named_in);
  if (reading.root.find("bow") && !table.has("table")) {
    table.missing("table", "a file with the shaft's deflections against position (CSV)");
  } else if (from) {
    std::vector<Problem> wrong;
    reading.model.structure.bow = parse_bow_table(from->text, from->name, wrong, &reading.doubts);
    reading.add_problems(wrong);
    if (!reading.root.find("shaft"))
      table.problem("table", "a bow is one of a shaft: there is none");
  }
  table.finish();
}

}  // namespace

ModelTable bow_table() {
  return {.name = "bow",
          .meaning = "how the first shaft is bent without forces; it turns with the shaft",
          .form = ModelTable::Form::one,
          .read = read_bow,
          .example = "table = \"z, x\\n0, 0\\n1, 1\"\n",
          .notes = {{"table", "file with deflections against position, beside the model"}}};
}

}  // namespace whirl::inline io

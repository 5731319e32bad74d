#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/report_words.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

/// Checks the table: a Model does not keep it, see report_words.
void read_report(ModelReading& reading) {
  TableReader table = reading.table("report");
  ReportWords words;
  table.read(words);
  const auto units = ShownUnits::named(words.units, "");
  if (!units) table.problem("units", units.problem);
  table.finish();
}

}  // namespace

ModelTable report_table() {
  return {.name = "report",
          .meaning = "what stands on the cover of a report",
          .form = ModelTable::Form::one,
          .read = read_report,
          .is_of_rotor = false};
}

ReportWords report_words(std::string_view text) {
  ReportWords words;
  try {
    const ConfigNode root = parse_toml(text, "model");
    std::vector<Problem> ignored;  // `check` told them
    TableReader table(root.find("report"), "report", ignored);
    table.read(words);
  } catch (const ModelError&) {  // a result of a version that wrote models otherwise
  }
  return words;
}

}  // namespace whirl::inline io

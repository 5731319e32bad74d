#include "apps/verbs/notes.hpp"

#include <algorithm>

#include "libio/text/parameter_axis.hpp"
#include "libio/texts/model_text.hpp"

namespace whirl::inline cli {

void note_linear(const Model& model, const std::vector<double>& speeds, Report& report) {
  const std::string left_out = left_out_note(model);
  if (!left_out.empty()) report.notes.push_back(left_out);
  note_tables(model, speeds, report);
}

void note_tables(const Model& model, const std::vector<double>& speeds, Report& report) {
  const auto [low, high] = std::minmax_element(speeds.begin(), speeds.end());
  const auto notes = table_notes(model.structure, *low, *high);
  report.notes.insert(report.notes.end(), notes.begin(), notes.end());
}

void note_tables(const Invocation& call, const Model& model, Report& report) {
  std::vector<double> speeds{model.speed};
  for (const std::string& over : call.over) {
    const auto axis = parse_axis(over, 2);  // of a range without a step both ends are enough
    if (axis && axis->path.find("operation.speed") != std::string::npos) speeds = axis->values;
  }
  note_tables(model, speeds, report);
}

}  // namespace whirl::inline cli

#include "apps/verbs/notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/verbs/common.hpp"
#include "libbase/names.hpp"
#include "libfe/exceeded_tables.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline cli {

namespace {

/// Names of contacts or films, each with what it is: "contact seal, contact ring"; empty for none.
std::string names_of(const auto& members, const char* kind) {
  std::string names;
  for (const auto& member : members) {
    names += (names.empty() ? "" : ", ") + named(kind, member.name);
  }
  return names;
}

}  // namespace

void note_left_out(const Model& model, Report& report) {
  const std::string contacts = names_of(model.contacts, "contact");
  const std::string films = names_of(model.films, "oil film");
  if (contacts.empty() && films.empty()) return;
  report.notes.push_back(fmt::format(
      "left out: {}{}{}{}", contacts, contacts.empty() || films.empty() ? "" : ", ", films,
      films.empty()
          ? ""
          : " (oil films have no linear coefficients here: nothing holds the rotor there)"));
}

void note_tables(const Model& model, double lowest, double highest, Report& report) {
  for (const ExceededTable& table : exceeded_tables(model.structure, lowest, highest)) {
    std::string beyond;
    if (lowest < table.first) {
      beyond = fmt::format("below (asked: {:.6g} rpm)", lowest / rpm);
    }
    if (highest > table.last) {
      beyond +=
          fmt::format("{}above (asked: {:.6g} rpm)", beyond.empty() ? "" : " and ", highest / rpm);
    }
    report.notes.push_back(
        fmt::format("the table of {} goes from {:.6g} to {:.6g} rpm; its ends are held constant {}",
                    table.name, table.first / rpm, table.last / rpm, beyond));
  }
}

void note_tables(const Invocation& call, const Model& model, Report& report) {
  double lowest = model.speed, highest = model.speed;
  for (const std::string& over : call.over) {
    const auto axis = parse_axis(over, 2);  // of a range without a step both ends are enough
    if (!axis || axis->path.find("operation.speed") == std::string::npos) continue;
    const auto [low, high] = std::minmax_element(axis->values.begin(), axis->values.end());
    lowest = *low;
    highest = *high;
  }
  note_tables(model, lowest, highest, report);
}

}  // namespace whirl::inline cli

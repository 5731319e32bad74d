#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "libio/model/bow_table.hpp"
#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// The keys speed and speeds, in place of a ratio.
void read_own_speeds(TableReader& table, Rotor& rotor) {
  const auto constant = table.quantity("speed", "rad/s", Range::any);
  const auto rows = table.rows("speeds", "rad/s");
  const int given =
      (table.has("ratio") ? 1 : 0) + (table.has("speed") ? 1 : 0) + (table.has("speeds") ? 1 : 0);
  if (given == 0) {
    table.missing("ratio", "a number: of its speed to that of the first shaft; or its own speed",
                  {"speed", "speeds"});
  } else if (given > 1) {
    table.problem(table.has("speed") ? "speed" : "speeds",
                  "found more than one, expected a ratio, a speed, or a table of speeds");
    return;
  }
  if (constant) {
    rotor.lead = {0.0};
    rotor.own = {*constant};
    if (*constant == 0.0) {
      table.problem("speed", "found 0, expected another speed; a shaft that stands has ratio = 0");
    }
  }
  if (!rows) return;
  if (rows->cols() != 2 || rows->rows() < 2) {
    table.problem("speeds", "expected two rows or more, [speed of the first shaft, own speed]");
    return;
  }
  rotor.lead.assign(rows->col(0).begin(), rows->col(0).end());
  rotor.own.assign(rows->col(1).begin(), rows->col(1).end());
  const bool ascends =
      std::ranges::adjacent_find(rotor.lead, std::greater_equal<>()) == rotor.lead.end();
  if (!ascends || rotor.lead.front() < 0.0) {
    table.problem("speeds",
                  "speeds of the first shaft must ascend from row to row, from 0 or more");
  }
  if (rows->col(1).minCoeff() < 0.0 && rows->col(1).maxCoeff() > 0.0) {
    table.problem("speeds", "the own speeds have both senses, expected one");
  }
}

void read_rotors(ModelReading& reading) {
  reading.for_each("rotor", [&](TableReader& table, std::size_t item) {
    Rotor rotor;
    rotor.where = table.where();
    if (const auto name = table.string("name", true)) rotor.name = *name;
    if (table.has("name") &&
        (rotor.name.empty() || rotor.name == "ground" || rotor.name == first_shaft_name)) {
      table.problem("name", fmt::format("found {}, expected a name that is neither empty nor "
                                        "\"ground\" nor \"{}\", which is the first shaft",
                                        in_quotes(rotor.name), first_shaft_name));
    }
    table.read(rotor);
    read_own_speeds(table, rotor);
    if (std::abs(rotor.ratio) > 1000.0) {
      table.problem("ratio", fmt::format("found {:g}, expected -1000 to 1000", rotor.ratio));
    }
    if (const auto from = reading.text_of(table, "bow", "rotor", item, bow_columns_named_in)) {
      std::vector<Problem> wrong;
      rotor.bow = parse_bow_table(from->text, from->name, wrong, &reading.doubts);
      reading.add_problems(wrong);
    }
    reading.model.structure.rotors.push_back(std::move(rotor));
  });
}

}  // namespace

ModelTable rotor_table() {
  return {
      .name = "rotor",
      .meaning = "further shafts, whose speed has a ratio to that of the first one or is their own",
      .read = read_rotors,
      .turn = ModelTable::Turn::early,
      .example =
          "name = \"outer\"\n"
          "ratio = 1.5\n",
      .notes = {
          {"speed",
           "its own, in place of a ratio, whatever that of the first shaft; below 0: "
           "against it"},
          {"speeds", "likewise a table: rows [speed of the first shaft, own speed]"},
          {"bow", "file with deflections of its shaft against position, as that of a [bow]"}}};
}

}  // namespace whirl::inline io

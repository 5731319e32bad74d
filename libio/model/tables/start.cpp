#include <fmt/format.h>

#include <tuple>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline io {

namespace {

void read_start(ModelReading& reading) {
  TableReader table = reading.table("start");
  if (const auto from = table.choice<StartFrom>("from")) reading.model.start.from = *from;
  if (const auto file = table.string("file"); file && !file->empty()) {
    // in the file: beside it; from the command line: as the shell sees it
    const bool is_in_file = table.where("file").line > 0;
    reading.model.start.file = is_in_file ? (reading.files.folder / *file).string() : *file;
  }
  if (reading.model.start.from == StartFrom::file && reading.model.start.file.empty()) {
    table.missing("file", "the name of a result file to start from");
  }
  reading.for_each_item(
      table, "whirl", "[ { mode = 1, amplitude = \"2 mm\" } ]", [&](TableReader& item) {
        WhirlStart w;
        if (const auto mode = item.integer("mode", Range::positive, true))
          w.mode = static_cast<int>(*mode);
        w.where = item.where("mode");
        if (const auto a = item.quantity("amplitude", "m", Range::nonnegative, true))
          w.amplitude = *a;
        if (const auto p = item.quantity("phase", "rad", Range::any)) w.phase = *p;
        reading.model.start.whirl.push_back(w);
      });
  reading.for_each_item(table, "displaced", "[ { body = \"rotor\", x = \"1 mm\" } ]",
                        [&](TableReader& item) {
                          Displaced d;
                          if (const auto at = reading.station(item)) d.at = *at;
                          for (const auto& [key, unit, to] : {std::tuple{"x", "m", &d.x},
                                                              {"y", "m", &d.y},
                                                              {"vx", "m/s", &d.vx},
                                                              {"vy", "m/s", &d.vy}}) {
                            if (const auto value = item.quantity(key, unit, Range::any))
                              *to = *value;
                          }
                          reading.model.start.displaced.push_back(d);
                        });
  table.finish();
}

}  // namespace

ModelTable start_table() {
  return {
      .name = "start",
      .meaning = "start of a simulation",
      .form = ModelTable::Form::one,
      .read = read_start,
      .is_of_rotor = false,
      .bare =
          "whirl = [{}]\n"
          "displaced = [{}]\n",
      .switches = {{"from", "static"}},
      .notes = {
          {"from",
           "rest: in the bearings' centers; static: sag under gravity; file: the end of a result",
           "\"static\""},
          {"file", "result whose end is the start; beside the model"},
          {"whirl", "complex modes at speed that are added"},
          {"whirl.[].mode", "number that whirl modes gives it"},
          {"whirl.[].amplitude", "largest lateral radius"},
          {"displaced", "places that are moved aside or thrown"},
          {"displaced.[].body", "name of a body that is moved"}}};
}

}  // namespace whirl::inline io

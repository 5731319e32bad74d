#include "libverbs/options/result_input.hpp"

#include <fmt/format.h>

#include "libio/figures/choice.hpp"
#include "libio/measured/law_file.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/call.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline cli {

namespace fs = std::filesystem;

bool is_model_file(const Invocation& call) {
  return fs::path(call.file).extension() == ".toml" && fs::is_regular_file(call.file);
}

FileError no_result(const Invocation& call, const std::string& kind) {
  const std::string out = fs::path(call.file).replace_extension(".h5").string();
  std::vector<std::string> then{"whirl", call.verb, out};
  if (!kind.empty()) then.push_back(kind);
  const bool draws = call.verb == "plot" && kind.empty();
  return FileError(fmt::format(
      "cannot open {}: not an HDF5 file but a model; compute a result first, such as\n  {}\n  {}{}",
      call.file, shell_line({"whirl", verb_for(kind), call.file, "--out", out}), shell_line(then),
      draws ? fmt::format("\nor draw the model:\n  {}",
                          shell_line({"whirl", "plot", call.file, "layout"}))
            : ""));
}

void require_result(const Invocation& call, const std::string& kind) {
  if (is_model_file(call)) throw no_result(call, kind);
}

void set_frequency_unit(const Option<std::string>& unit, ResultView& result) {
  if (!unit.is_given) {
    const ShownUnit shown = shown_unit("Hz");
    result.frequency = {shown.name, 1.0 / shown.size};
    return;
  }
  const auto known = frequency_unit(*unit);
  if (!known) throw unit.wrong("expected Hz, cpm or rad/s");
  result.frequency = *known;
}

MotionWindow window_of(const WindowVerbOptions& options) {
  const auto& [from, revolutions, times] = options;
  if (times && from) throw times.wrong("does not go with --from-revolution");
  if (times && revolutions) throw times.wrong("does not go with --revolutions");
  return {from.value, revolutions.value, times.value};
}

SceneSource scene_source(const Invocation& call) {
  const fs::path ending = fs::path(call.file).extension();
  if (ending != ".h5" && ending != ".hdf5") return SceneSource(call.model());
  auto result = open_result(call.file);
  Model model = parse_model(stored_model(*result), call.file, call.sets,
                            NamedFiles::of_sets_in("").with(law_table));
  return SceneSource(std::move(model), std::move(result));
}

Record file_list(const std::vector<fs::path>& files) {
  Record list = Record::array();
  for (const fs::path& file : files) list.add(file.string());
  return list;
}

}  // namespace whirl::inline cli

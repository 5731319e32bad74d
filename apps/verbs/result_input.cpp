#include "apps/verbs/result_input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <vector>

#include "libio/figures/figures.hpp"

namespace whirl::inline cli {

void require_result(const Invocation& call, const std::string& kind) {
  const std::filesystem::path model = call.file;
  if (model.extension() != ".toml" || !std::filesystem::is_regular_file(model)) return;
  // results have a group by the name of the verb, with these exceptions
  const std::map<std::string, std::string> others{{"trajectory", "simulate"},
                                                  {"spectra", "simulate"},
                                                  {"mac", "identify"},
                                                  {"branch", "continue"},
                                                  {"border", "continue"}};
  std::string verb = "simulate";
  for (const FigureKind& k : figure_kinds()) {
    if (k.name != kind || k.needs.empty()) continue;
    const std::string_view path = k.needs.front();
    verb = path.substr(1, path.find('/', 1) - 1);
    if (const auto other = others.find(verb); other != others.end()) verb = other->second;
  }
  const std::string out = std::filesystem::path(model).replace_extension(".h5").string();
  std::vector<std::string> then{"whirl", call.verb, out};
  if (!kind.empty()) then.push_back(kind);
  throw FileError(fmt::format(
      "cannot open {}: not an HDF5 file but a model; compute a result first, such as\n  {}\n  {}",
      call.file, shell_line({"whirl", verb, call.file, "--out", out}), shell_line(then)));
}

}  // namespace whirl::inline cli

#include "apps/verbs/branch_point.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl {

BranchStart branch_start(const Invocation& call) {
  if (!call.has("from")) {
    throw ModelError({"--point " + call.text("point")}, "",
                     "of which branches? give the result of whirl continue with --from");
  }
  const std::string name = call.text("from");
  const auto result = open_result(name);
  const ResultReader& file = *result;
  if (!file.has("/branch/state")) {
    throw FileError(name + " holds no branches; whirl continue --out writes them");
  }
  const Mat states = file.matrix("/branch/state");
  const long number = call.integer("point");
  if (number > states.rows()) {
    throw ModelError({"--point " + call.text("point")}, "",
                     fmt::format("expected a number from 1 to {}", states.rows()));
  }
  const std::vector<double> values = file.numbers("/branch/value");
  const auto k = static_cast<std::size_t>(number - 1);
  const ParameterAxis axis{.path = file.string_attribute("/branch/value", "long_name"),
                           .unit = file.string_attribute("/branch/value", "units"),
                           .values = {values.front(), values[k]}};
  const std::string path =
      file.has_attribute("/model", "path") ? file.string_attribute("/model", "path") : name;
  const auto branch = static_cast<std::size_t>(file.numbers("/branch/branch").at(k));
  std::vector<std::string> at_point = axis.assignments(1), at_first = axis.assignments(0);
  if (file.has_attribute("/branch", "fixed")) {  // the other value of a plane
    std::istringstream fixed(file.string_attribute("/branch", "fixed"));
    for (std::string set; std::getline(fixed, set);) {
      at_point.push_back(set);
      at_first.push_back(set);
    }
  }
  return {.sets = at_point,
          .period = static_cast<int>(file.numbers("/branch/period").at(branch - 1)),
          .state = states.row(number - 1).transpose(),
          .first = make_scene(parse_model(file.strings("/model").at(0), path, at_first,
                                          std::filesystem::path(path).parent_path()))};
}

}  // namespace whirl

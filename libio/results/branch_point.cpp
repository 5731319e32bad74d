#include "libio/results/branch_point.hpp"

#include <sstream>

#include "libio/model/model_file.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

long count_branch_points(const ResultReader& file) {
  if (file.has("/branch/state")) return file.shape("/branch/state").at(0);
  throw FileError(file.path().string() + " holds no branches; whirl continue --out writes them");
}

BranchStart read_branch_point(const ResultReader& file, long number) {
  const std::vector<double> values = file.numbers("/branch/value");
  const auto k = static_cast<std::size_t>(number - 1);
  const ParameterAxis axis{.path = file.string_attribute("/branch/value", "long_name"),
                           .unit = file.string_attribute("/branch/value", "units"),
                           .values = {values.front(), values[k]}};
  const std::filesystem::path model = file.has_attribute("/model", "path")
                                          ? file.string_attribute("/model", "path")
                                          : file.path().string();
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
          .state = file.matrix("/branch/state").row(number - 1).transpose(),
          .first = make_scene(parse_model(file.strings("/model").at(0), model.string(), at_first,
                                          model.parent_path()))};
}

}  // namespace whirl::inline io

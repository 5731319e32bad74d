#include "libio/results/branch_point.hpp"

#include <fmt/format.h>

#include <sstream>

#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/studies/branch_result.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

MotionState BranchStart::in(const Scene& scene) const {
  MotionState start;
  start.y = BasisChange(scene, first).to(state);
  return start;
}

BranchStart read_branch_point(const std::filesystem::path& path, long number) {
  const auto file = open_result(path);
  const auto branches = read_result<BranchResult>(*file);
  if (branches.points.empty()) {
    throw FileError(path.string() + " holds no branches; whirl continue --out writes them");
  }
  if (number > std::ssize(branches.points)) {
    throw wrong_option("point", std::to_string(number),
                       fmt::format("expected a number from 1 to {}", branches.points.size()));
  }
  const BranchOrbit& orbit = branches.points[static_cast<std::size_t>(number - 1)];
  const ParameterAxis axis{.path = branches.parameter.path, .unit = branches.parameter.unit};
  std::vector<std::string> at_point = axis.assignments_of(orbit.value),
                           at_first = axis.assignments_of(branches.points.front().value);
  std::istringstream fixed(branches.fixed);  // the other value of a plane
  for (std::string set; std::getline(fixed, set);) {
    at_point.push_back(set);
    at_first.push_back(set);
  }
  const std::filesystem::path model = file->has_attribute("/model", "path")
                                          ? file->string_attribute("/model", "path")
                                          : path.string();
  return {.sets = at_point,
          .period = branches.branches.at(static_cast<std::size_t>(orbit.branch - 1)).period,
          .state = orbit.state,
          .first = make_scene(parse_model(file->strings("/model").at(0), model.string(), at_first,
                                          model.parent_path()))};
}

}  // namespace whirl::inline io

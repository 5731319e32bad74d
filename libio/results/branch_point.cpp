#include "libio/results/branch_point.hpp"

#include <fmt/format.h>

#include <sstream>

#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/studies/branch_result.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/call.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

namespace {

/// Checks that what a file sets of a model is a number, and names no file.
void require_number(const std::string& set, const std::filesystem::path& path) {
  std::string value = set.substr(std::min(set.find('='), set.size() - 1) + 1);
  const bool is_quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
  if (is_quoted) value = value.substr(1, value.size() - 2);
  if (!set.empty() && parse_quantity(value)) return;
  throw FileError(fmt::format("{}: its parameters are damaged: found {}, expected a number",
                              path.string(), in_quotes(set)));
}

}  // namespace

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
  if (!branches.state_layout.empty() && branches.state_layout != StateLayout::parts) {
    throw FileError(fmt::format("{} holds states as \"{}\", this version reads \"{}\" only",
                                path.string(), branches.state_layout, StateLayout::parts));
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
  for (const std::string& set : at_point) require_number(set, path);
  return {.sets = at_point,
          .period = branches.branches.at(static_cast<std::size_t>(orbit.branch - 1)).period,
          .state = orbit.state,
          .first = make_scene(parse_model(stored_model(*file), path.string(), at_first))};
}

}  // namespace whirl::inline io

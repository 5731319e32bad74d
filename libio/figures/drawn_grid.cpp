#include "libio/figures/drawn_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/studies/sweep.hpp"

namespace whirl::inline io::figures {

namespace {

std::size_t share(std::size_t size, std::size_t parts) {
  return (size + parts - 1) / parts;
}

/// "4th", "3rd".
std::string ordinal(std::size_t number) {
  const std::size_t last = number % 10, before = number / 10 % 10;
  const bool is_teen = before == 1;
  const char* ending = is_teen     ? "th"
                       : last == 1 ? "st"
                       : last == 2 ? "nd"
                       : last == 3 ? "rd"
                                   : "th";
  return fmt::format("{}{}", number, ending);
}

}  // namespace

CoarseGrid drawn_grid(const std::vector<std::size_t>& shape, bool is_sweep,
                      const DrawnPoints& most) {
  CoarseGrid grid{shape, std::vector<std::size_t>(shape.size(), 1)};
  if (shape.empty()) return grid;
  if (is_sweep) {
    grid.steps.back() = std::max<std::size_t>(1, share(shape.back(), most.values_of_sweep));
    return grid;
  }
  const auto of_plane = [&] { return grid.taken(0) * (shape.size() > 1 ? grid.taken(1) : 1); };
  while (of_plane() > most.of_plane)
    ++grid.steps[shape.size() > 1 && grid.taken(1) > grid.taken(0) ? 1 : 0];
  if (shape.size() > 2) {
    const std::size_t planes = std::max<std::size_t>(1, most.of_planes / of_plane());
    grid.steps[2] = std::max<std::size_t>(1, share(shape[2], planes));
  }
  return grid;
}

CoarseGrid drawn_grid(const ResultReader& file, std::string_view group) {
  const std::string points = std::string(group) + "/motion";
  if (!file.has(points)) return {};
  const std::vector<Eigen::Index> shape = file.shape(points);
  return drawn_grid({shape.begin(), shape.end()}, group == SweepResult::group);
}

std::string coarseness(const ResultReader& file, std::string_view group) {
  if (group != SweepResult::group && group != MapResult::group && group != BasinsResult::group) {
    return "";
  }
  const CoarseGrid grid = drawn_grid(file, group);
  if (grid.is_all()) return "";
  const auto parameters = stored_parameters(file, group);
  const std::size_t leading = grid.steps.size() - std::min(grid.steps.size(), parameters.size());
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < grid.steps.size(); ++i) {
    if (grid.steps[i] == 1) continue;
    parts.push_back(
        fmt::format("every {} of {} {}", ordinal(grid.steps[i]), grid.sizes[i],
                    i < leading ? "starts" : "values of " + parameters[i - leading].path));
  }
  return fmt::format(
      "A coarser picture, as the study has many points: drawn is {}. Shares are of what is drawn.",
      fmt::join(parts, ", "));
}

std::vector<double> drawn_values(const CoarseGrid& grid, std::size_t axis,
                                 const std::vector<double>& values) {
  std::vector<double> drawn;
  for (std::size_t i = 0; i < values.size(); i += grid.steps[axis]) drawn.push_back(values[i]);
  return drawn;
}

}  // namespace whirl::inline io::figures

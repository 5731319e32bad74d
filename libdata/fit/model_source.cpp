#include "libdata/fit/model_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline data {

namespace {

/// Of a parameter's size: how far its neighbors are, whose coefficients slopes are made of.
constexpr double neighborhood = farthest_neighbor * largest_step;
/// Of a parameter's size: a friction that is zero has no neighbors that slip alike.
constexpr double hardly = 1e-6;

/// A value as far from the bounds of a parameter as an amount, where they leave so much room.
double inside(double value, const FreeParameter& parameter, double amount) {
  const double room = std::min(amount, 0.5 * (parameter.upper - parameter.lower));
  return std::clamp(value, parameter.lower + room, parameter.upper - room);
}

}  // namespace

FitSource model_source(FitRecord record, std::shared_ptr<const Scene> scene, Mat rows,
                       const std::vector<FreeParameter>& parameters,
                       std::function<Model(const Vec& values)> model_at) {
  Vec starts(std::ssize(parameters));
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    starts(static_cast<Eigen::Index>(p)) = parameters[p].start;
  }
  const double speed = model_at(starts).speed;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    Vec other = starts;
    other(static_cast<Eigen::Index>(p)) += largest_step * parameters[p].size;
    if (model_at(other).speed == speed) continue;
    throw ModelError({}, parameters[p].path,
                     fmt::format("changes the speed, which {} was measured at", record.name));
  }
  const auto system_at = [scene, parameters, model_at = std::move(model_at)](const Vec& asked) {
    Vec values = asked.head(std::ssize(parameters));
    for (Eigen::Index p = 0; p < values.size(); ++p) {
      const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
      values(p) = inside(values(p), parameter, hardly * parameter.size);
    }
    const Scene here = scene_in_shapes_of(*scene, model_at(values));
    FitSystem found{here.contacts, {}, asked.tail(asked.size() - values.size())};
    for (Eigen::Index p = 0; p < values.size(); ++p) {
      const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
      const double middle = inside(values(p), parameter, neighborhood * parameter.size);
      found.slopes.push_back(
          slope_of(parameter.path, here, middle, parameter.size, [&](double value) {
            Vec other = values;
            other(p) = value;
            return model_at(other);
          }));
    }
    return found;
  };
  return {std::move(record), std::move(rows), system_at};
}

}  // namespace whirl::inline data

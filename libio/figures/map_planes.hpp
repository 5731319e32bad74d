#pragma once
/// Studies over planes of parameters, and how the motions that they find are drawn.

#include <fmt/format.h>

#include <optional>

#include "libdyn/studies/map.hpp"
#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// The planes of a study of two or three parameters.
struct Planes {
  /// @param axes  two or three
  explicit Planes(std::vector<ShownAxis> axes)
      : x(std::move(axes.at(0))), y(std::move(axes.at(1))) {
    if (axes.size() > 2) z = std::move(axes[2]);
  }
  ShownAxis x, y, z;
  std::size_t count() const { return std::max<std::size_t>(1, z.values.size()); }
  std::size_t point(std::size_t i, std::size_t j, std::size_t plane) const {
    return (i * y.values.size() + j) * count() + plane;
  }
  std::string variant(std::size_t plane) const {
    return z.values.empty() ? "" : fmt::format("{} = {:.6g}", z.title, z.values[plane]);
  }
  /// Cells with a value of every point.
  template <class Value>
  Cells cells(std::size_t plane, const Value& value) const {
    Cells c{.x = x.values, .y = y.values};
    for (std::size_t j = 0; j < y.values.size(); ++j) {
      for (std::size_t i = 0; i < x.values.size(); ++i)
        c.values.push_back(value(point(i, j, plane)));
    }
    return c;
  }
};

/// What a point of a study may be: periodic motions by their period, others by their kind.
const std::vector<Category>& motions();

/// Number of a motion among motions().
double motion_number(std::optional<MotionKind> kind, int period);

}  // namespace whirl::inline io::figures

#include "libio/figures/front_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "libio/figures/common.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

using namespace figures;

std::vector<Figure> front_view(const Model& model) {
  const std::vector<Contact> contacts = stator_contacts(model.contacts);
  if (contacts.empty()) return {};
  Figure f{.subtitle = "Rotor and stators, seen along the axis; clearances enlarged"};
  f.columns = static_cast<int>(std::min<std::size_t>(3, contacts.size()));
  f.width = std::max(460.0, 360.0 * f.columns);
  f.height = 420.0;
  for (const Contact& c : contacts) {
    Panel p;
    p.has_equal_scales = true;
    p.title = c.name;
    const double radius = c.friction.radius > 0.0 ? c.friction.radius : 5.0 * c.clearance;
    const double gap = std::max(c.clearance, 0.12 * radius);
    p.x.title = shown_heading("x", "mm");
    p.y.title = shown_heading("y", "mm");
    const bool is_given = c.friction.radius > 0.0;
    Curve rotor = figures::circle(is_given ? "rotor" : "rotor, size not given (not to scale)",
                                  per_mm() * radius);
    rotor.paint = Paint::disk;
    rotor.dash = is_given ? Dash::solid : Dash::dashed;
    rotor.fill = is_given ? 0.4 : 0.0;
    rotor.hover.assign(rotor.x.size(),
                       is_given ? fmt::format("{} of radius {}", c.at.body, format_length(radius))
                                : fmt::format("{}, its size not given", c.at.body));
    const AnyGeometry geometry = geometry_of(c);
    const auto direction = direction_of(geometry);
    const auto stator = [&](double distance) {
      if (direction) {
        return figures::line_across("stator", *direction, per_mm() * (distance + gap),
                                    per_mm() * radius);
      }
      return figures::curve_around("stator", [&](const Vec2& along) {
        return per_mm() * (distance + reach_of(geometry, gap, along));
      });
    };
    Curve inner = stator(radius), outer = stator(1.12 * radius);
    inner.dash = outer.dash = Dash::solid;
    inner.width = 2.2;
    inner.hover.assign(inner.x.size(), "clearance " + format_length(c.clearance));
    p.curves = {outer, inner, rotor};
    const double reach =
        direction ? per_mm() * (1.12 * radius + gap) : *std::ranges::max_element(outer.y);
    p.labels.push_back({0.0, reach, "clearance " + format_length(c.clearance), Anchor::middle, 0.0,
                        -7.0, Paint::stator});
    const double widest = direction ? reach : std::max(reach, *std::ranges::max_element(outer.x));
    p.x.first = p.y.first = -1.2 * widest;
    p.x.last = p.y.last = 1.2 * widest;
    f.panels.push_back(std::move(p));
  }
  return {f};
}

}  // namespace whirl::inline io

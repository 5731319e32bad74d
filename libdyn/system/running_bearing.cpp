#include "libdyn/system/running_bearing.hpp"

#include <algorithm>

#include "libbase/numerics/dual.hpp"
#include "libcontact/dual_functions.hpp"

namespace whirl::inline dyn {

RestingPush resting_push(const ReducedContact& c, const Vec2& d) {
  using D = Dual<2>;
  RestingPush push{Vec2::Zero(), Mat2::Zero()};
  if (!(kinematics(c, 0.0, {{d(0), d(1)}, {0.0, 0.0}, {0.0, 0.0}}).depth > 0.0)) return push;
  const GapMotion<D> motion{
      {D::variable(d(0), 0), D::variable(d(1), 1)}, {D(0.0), D(0.0)}, {D(0.0), D(0.0)}};
  auto gap = std::visit([&](const auto& g) { return g.gap(c.space(), 0.0, motion); }, c.geometry);
  gap.rate = D(0.0);  // what turns is looked at where it stands
  const D normal =
      std::visit([&](const auto& law) { return D(law.normal(gap.depth, gap.rate)); }, c.law);
  for (const int i : {0, 1}) {
    const D force = -normal * gap.n[static_cast<std::size_t>(i)];
    push.force(i) = force.value;
    push.by_u.row(i) = force.slopes;
  }
  return push;
}

std::vector<ReducedContact> elements_of(const Contact& bearing, const PartSpeeds& speeds) {
  std::vector<ReducedContact> elements;
  const AnyGeometry geometry = geometry_of(bearing);
  for (int i = 0; i < places_of(geometry); ++i) {
    ReducedContact one{.name = bearing.name,
                       .offset = bearing.offset,
                       .clearance = bearing.clearance,
                       .rim_speed = 0.0,
                       .law = bearing.law,
                       .geometry = place_of(geometry, i, speeds)};
    one.place = i;
    elements.push_back(std::move(one));
  }
  return elements;
}

RunningBearing running_bearing(const Contact& bearing, const Vec2& place,
                               const PartSpeeds& speeds) {
  RunningBearing found{.name = bearing.name, .place = place};
  for (const ReducedContact& element : elements_of(bearing, speeds)) {
    const RestingPush push = resting_push(element, place - bearing.offset);
    found.load -= push.force;
    found.stiffness -= push.by_u;
    found.elements.push_back(push.force.norm());
    if (found.elements.back() > 0.0) ++found.loaded;
    found.largest = std::max(found.largest, found.elements.back());
  }
  return found;
}

}  // namespace whirl::inline dyn

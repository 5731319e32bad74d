#include "libdyn/system/hardest_touch.hpp"

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/assembly/properties.hpp"
#include "libfe/mesh/mesh.hpp"

namespace whirl::inline dyn {

void HardestTouches::add(std::size_t motion, std::size_t i, double normal, double tangential,
                         double duty) {
  if (i >= contacts_.size()) contacts_.resize(i + 1);
  HardestTouch& hardest = contacts_[i];
  if (normal > hardest.normal) hardest.normal = normal, hardest.pressed = motion;
  const double rubbing = tangential * duty;
  if (rubbing > hardest.rubbing) hardest.rubbing = rubbing, hardest.rubbed = motion;
}

void HardestTouches::add(std::size_t motion, const std::vector<ContactMeasure>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactMeasure& c = contacts[i];
    add(motion, i, c.max_normal, c.max_tangential, c.duty);
  }
}

void HardestTouches::add(std::size_t motion, const std::vector<ContactDoing>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactDoing& c = contacts[i];
    add(motion, i, c.max_normal, c.max_tangential, c.duty);
  }
}

double depth_under(const AnyContactLaw<>& law, double normal) {
  constexpr double smallest = 1e-12, largest = 1e12;  // [m]
  constexpr double relative = 1e-6;
  if (!is_continuous(law) || !std::isfinite(normal)) return nan;
  if (!(normal > 0.0)) return 0.0;
  const auto excess = [&](double log_depth) {
    return std::log(normal_force(law, std::exp(log_depth), 0.0) / normal);
  };
  return std::exp(bracketed_root(excess, std::log(smallest), std::log(largest), relative));
}

FrictionPower friction_power(const Model& model, const Contact& contact, double rubbing) {
  const auto radius = rim_radius_of(geometry_of(contact));
  const double speed = std::abs(model.speed);
  const double power = rubbing * speed * radius.value_or(contact.friction.radius);
  const double inertia = rotor_properties(model.structure, make_mesh(model.structure)).Ip;
  const double energy = 0.5 * inertia * speed * speed;
  return {power, energy > 0.0 ? energy / power * speed / turn : nan};
}

}  // namespace whirl::inline dyn

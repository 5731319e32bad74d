#include "libdyn/system/contact_measures.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int points = 8;  ///< intervals of a step in which the largest force is looked for

/// Largest value of a parabola through three equidistant values, if its top lies between them.
double top(double a, double b, double c) {
  const double bend = a - 2.0 * b + c, slope = 0.5 * (c - a);
  if (!(bend < 0.0) || std::abs(slope) > -bend) return std::max({a, b, c});
  return b - 0.5 * slope * slope / bend;
}

}  // namespace

ContactMeter::ContactMeter(const ContactSystem& system)
    : system_(&system),
      sums_(static_cast<std::size_t>(system.owners())),
      was_apart_(system.contacts().size()) {
  for (const ReducedContact& c : system.contacts()) {
    sums_[static_cast<std::size_t>(c.owner)].times.name = c.name;
  }
}

void ContactMeter::add_heat(const Step& step, int k, const std::vector<ContactForces>& forces) {
  const double simpson = (k == 0 || k == points ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / (3.0 * points);
  std::vector<double> power(sums_.size()), torque(sums_.size());
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (!step.contacts[i].in_touch()) continue;
    const ReducedContact& c = system_->contacts()[i];
    const double radius = rim_radius_of(c.geometry).value_or(c.friction.radius);
    power[static_cast<std::size_t>(c.owner)] += forces[i].friction * forces[i].slip;
    torque[static_cast<std::size_t>(c.owner)] += forces[i].friction * radius;
  }
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    Sum& sum = sums_[i];
    sum.heat += simpson * step.h * power[i];
    sum.impulse += simpson * step.h * torque[i];
    sum.max_power = std::max(sum.max_power, power[i]);
    sum.max_torque = std::max(sum.max_torque, std::abs(torque[i]));
  }
}

void ContactMeter::add(const Step& step) {
  time_ += step.h;
  const bool any = std::any_of(step.contacts.begin(), step.contacts.end(),
                               [](const ContactState& c) { return c.in_touch(); });
  const auto contacts = step.contacts.size();
  std::vector<std::array<double, points + 1>> normal(contacts), friction(contacts);
  const auto sum_of = [&](std::size_t i) -> Sum& {
    return sums_[static_cast<std::size_t>(system_->contacts()[i].owner)];
  };
  if (any) {
    Vec y(system_->size());
    std::vector<ContactForces> forces;
    for (int k = 0; k <= points; ++k) {
      const double s = static_cast<double>(k) / points;
      step.at(s, y.data());
      system_->forces(step.instant(s), y.data(), step.contacts, forces);
      add_heat(step, k, forces);
      for (std::size_t i = 0; i < contacts; ++i) {
        normal[i][static_cast<std::size_t>(k)] = forces[i].normal;
        friction[i][static_cast<std::size_t>(k)] = std::abs(forces[i].friction);
        const double weight = (k == 0 || k == points ? 0.5 : 1.0) / points;
        if (step.contacts[i].in_touch()) sum_of(i).slip += weight * step.h * forces[i].slip;
      }
    }
  }
  std::vector<char> touches(sums_.size());
  for (std::size_t i = 0; i < contacts; ++i) {
    const bool in_touch = step.contacts[i].in_touch();
    if (in_touch) {
      Sum& sum = sum_of(i);
      ContactTimes& m = sum.times;
      char& touches_already = touches[static_cast<std::size_t>(system_->contacts()[i].owner)];
      if (!touches_already) m.in_touch += step.h;
      touches_already = 1;
      sum.touches += step.h;
      if (step.contacts[i].touch == Touch::sticking) m.sticking += step.h;
      for (std::size_t k = 1; k < points; ++k) {
        m.max_normal =
            std::max(m.max_normal, top(normal[i][k - 1], normal[i][k], normal[i][k + 1]));
        m.max_tangential =
            std::max(m.max_tangential, top(friction[i][k - 1], friction[i][k], friction[i][k + 1]));
      }
      if (has_begun_ && was_apart_[i]) m.impacts += 1.0;
    }
    was_apart_[i] = step.contacts[i].touch == Touch::apart;
  }
  has_begun_ = true;
}

std::vector<ContactMeasure> ContactMeter::measures() const {
  std::vector<ContactTimes> times;
  for (const Sum& sum : sums_) times.push_back(sum.times);
  std::vector<ContactMeasure> all = shares_of(times, time_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].touch_time = sums_[i].touches;
    all[i].mean_slip = sums_[i].touches > 0.0 ? sums_[i].slip / sums_[i].touches : 0.0;
  }
  return all;
}

std::vector<FrictionLoad> ContactMeter::friction() const {
  std::vector<FrictionLoad> all;
  for (const Sum& sum : sums_) {
    const double time = time_ > 0.0 ? time_ : 1.0;
    all.push_back({sum.heat, sum.heat / time, sum.max_power, sum.impulse / time, sum.max_torque});
  }
  return all;
}

void ContactTimes::append(const ContactTimes& later) {
  in_touch += later.in_touch;
  sticking += later.sticking;
  impacts += later.impacts;
  max_normal = std::max(max_normal, later.max_normal);
  max_tangential = std::max(max_tangential, later.max_tangential);
}

std::vector<ContactMeasure> shares_of(const std::vector<ContactTimes>& times, double whole) {
  std::vector<ContactMeasure> all;
  for (const ContactTimes& t : times) {
    // summed in another order than the whole, "always" may miss one by rounding
    const bool is_always = t.in_touch > (1.0 - 1e-12) * whole;
    all.push_back({.name = t.name,
                   .duty = is_always ? 1.0 : t.in_touch / whole,
                   .impacts = t.impacts,
                   .sticking = t.sticking / whole,
                   .max_normal = t.max_normal,
                   .max_tangential = t.max_tangential,
                   .mean_slip = nan});
  }
  return all;
}

ContactDoing contact_doing(const ContactMeasure& measure, long revolutions) {
  return {.regime = measure.regime(),
          .duty = measure.duty,
          .impacts_per_rev = measure.impacts / static_cast<double>(std::max(1L, revolutions)),
          .sticking = measure.sticking,
          .max_normal = measure.max_normal,
          .max_tangential = measure.max_tangential};
}

}  // namespace whirl::inline dyn

#include "libdyn/system/contact_measures.hpp"

#include <algorithm>
#include <cmath>

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
    : system_(system),
      sums_(static_cast<std::size_t>(system.owners())),
      was_in_touch_(system.contacts().size()) {
  for (const ReducedContact& c : system.contacts()) {
    sums_[static_cast<std::size_t>(c.owner)].name = c.name;
  }
}

void ContactMeter::add(const Step& step) {
  time_ += step.h;
  const bool any = std::any_of(step.contacts.begin(), step.contacts.end(),
                               [](const ContactState& c) { return c.in_touch(); });
  const auto contacts = step.contacts.size();
  std::vector<std::array<double, points + 1>> normal(contacts), friction(contacts);
  const auto sum_of = [&](std::size_t i) -> ContactMeasure& {
    return sums_[static_cast<std::size_t>(system_.contacts()[i].owner)];
  };
  if (any) {
    Vec y(system_.size());
    std::vector<ContactForces> forces;
    for (int k = 0; k <= points; ++k) {
      const double s = static_cast<double>(k) / points;
      step.at(s, y.data());
      system_.forces(step.instant(s), y.data(), step.contacts, forces);
      for (std::size_t i = 0; i < contacts; ++i) {
        normal[i][static_cast<std::size_t>(k)] = forces[i].normal;
        friction[i][static_cast<std::size_t>(k)] = std::abs(forces[i].friction);
        const double weight = (k == 0 || k == points ? 0.5 : 1.0) / points;
        if (step.contacts[i].in_touch()) sum_of(i).mean_slip += weight * step.h * forces[i].slip;
      }
    }
  }
  std::vector<char> touches(sums_.size());
  for (std::size_t i = 0; i < contacts; ++i) {
    const bool in_touch = step.contacts[i].in_touch();
    if (in_touch) {
      ContactMeasure& m = sum_of(i);
      char& touches_already = touches[static_cast<std::size_t>(system_.contacts()[i].owner)];
      if (!touches_already) m.duty += step.h;
      touches_already = 1;
      m.touch_time += step.h;
      if (step.contacts[i].touch == Touch::sticking) m.sticking += step.h;
      for (std::size_t k = 1; k < points; ++k) {
        m.max_normal =
            std::max(m.max_normal, top(normal[i][k - 1], normal[i][k], normal[i][k + 1]));
        m.max_tangential =
            std::max(m.max_tangential, top(friction[i][k - 1], friction[i][k], friction[i][k + 1]));
      }
      if (has_begun_ && !was_in_touch_[i]) m.impacts += 1.0;
    }
    was_in_touch_[i] = in_touch;
  }
  has_begun_ = true;
}

std::vector<ContactMeasure> ContactMeter::measures() const {
  std::vector<ContactMeasure> result = sums_;
  for (ContactMeasure& m : result) {
    m.mean_slip = m.touch_time > 0.0 ? m.mean_slip / m.touch_time : 0.0;
  }
  to_shares(result, time_);
  return result;
}

void to_shares(std::vector<ContactMeasure>& times, double whole) {
  for (ContactMeasure& m : times) {
    // summed in another order than the whole, "always" may miss one by rounding
    m.duty = m.duty > (1.0 - 1e-12) * whole ? 1.0 : m.duty / whole;
    m.sticking /= whole;
  }
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

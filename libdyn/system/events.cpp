#include "libdyn/system/events.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int samples = 12;  ///< of functions that are not polynomials of the displacement

unsigned bit(EventKind kind) {
  return 1u << static_cast<unsigned>(kind);
}

/// Chebyshev points on [0, 1] and the matrix from values there to coefficients of powers of s.
struct Interpolation {
  Eigen::Matrix<double, samples, 1> s;
  Eigen::Matrix<double, samples, samples> to_powers;

  Interpolation() {
    Eigen::Matrix<double, samples, samples> powers;
    for (int i = 0; i < samples; ++i) {
      s(i) = 0.5 * (1.0 - std::cos(std::numbers::pi * i / (samples - 1)));
      for (int k = 0; k < samples; ++k) powers(i, k) = std::pow(s(i), k);
    }
    to_powers = DenseLu<Mat>(powers).solve(Mat::Identity(samples, samples));
  }
};
const Interpolation& interpolation() {
  static const Interpolation table;
  return table;
}

/// Whether a rotor may move so far that a place that turns can touch.
bool may_reach(const ReducedContact& place, const Step& step) {
  PlaneRows u = place.U * step.q;
  u.col(0) -= place.offset;
  return u.colwise().norm().sum() >= (1.0 - 1e-9) * slack_of(place.geometry, place.clearance);
}

}  // namespace

EventWatcher::EventWatcher(const ContactSystem& system)
    : system_(system),
      surface_(system.contacts().size(), 0u),
      is_level_(system.contacts().size(), 0) {
  for (const ReducedContact& c : system.contacts()) {
    const double speed = std::max(std::abs(c.rim_speed), c.clearance * system.phase_rate());
    speed_scale_.push_back(speed);
    force_scale_.push_back(normal_force(c.law, c.clearance, 0.0));
  }
}

std::span<const EventKind> EventWatcher::kinds(int contact, const ContactStates& states) const {
  using enum EventKind;
  const auto i = static_cast<std::size_t>(contact);
  static constexpr EventKind of_apart[] = {touch}, of_receding[] = {retouch, part},
                             of_sticking[] = {pull, release, stick_limit},
                             of_sliding[] = {pull, release, slip_stop};
  const ReducedContact& c = system_.contacts()[i];
  const auto in_touch = [&](std::span<const EventKind> all, bool slip_may_change) {
    if (!slip_may_change) all = all.first(2);
    return rate_factor(c.law, 0.0) ? all : all.subspan(1);
  };
  switch (states[i].touch) {
    case Touch::apart:
      return of_apart;
    case Touch::receding:
      return of_receding;
    case Touch::sticking:
      return in_touch(of_sticking, system_.leads(states, i));
    case Touch::sliding:
      break;
  }
  return in_touch(of_sliding, c.friction.is_exact());
}

bool EventWatcher::on_surface(int contact, EventKind kind) const {
  return (surface_[static_cast<std::size_t>(contact)] & bit(kind)) != 0u;
}

bool EventWatcher::is_level(int contact, EventKind kind) const {
  return kind == EventKind::slip_stop && is_level_[static_cast<std::size_t>(contact)] != 0;
}

double EventWatcher::value(const Event& event, const Instant& at, const double* y,
                           const ContactStates& states) const {
  if (event.kind == EventKind::stick_limit) {
    return stick_margin(event.contact, system_.hold(at, y, states, event.contact));
  }
  const auto i = static_cast<std::size_t>(event.contact);
  return value(event, kinematics(system_.contacts()[i], at, y, system_.layout()), states[i]);
}

double EventWatcher::stick_margin(int contact, const Hold& hold) const {
  const double scale = force_scale_[static_cast<std::size_t>(contact)];
  const double limit = hold.limit / scale, force = hold.force / scale;
  return limit * limit - force * force;
}

double EventWatcher::value(const Event& event, const ContactForces& f,
                           const ContactState& state) const {
  const auto i = static_cast<std::size_t>(event.contact);
  const ReducedContact& c = system_.contacts()[i];
  const double beyond = beyond_surface(c, f);
  switch (event.kind) {
    case EventKind::touch:
      return -beyond;
    case EventKind::part:
      return beyond;
    case EventKind::release:
      return is_continuous(c.law) ? beyond : f.normal / force_scale_[i];
    case EventKind::pull:
      return *rate_factor(c.law, f.rate);
    case EventKind::retouch:
      return -rate_factor(c.law, f.rate).value_or(f.normal / force_scale_[i]);
    case EventKind::slip_stop:
      return state.sign * f.slip / speed_scale_[i];
    case EventKind::stick_limit:
      break;
  }
  assert(false);  // asks for all contacts
  return 0.0;
}

Polynomial EventWatcher::polynomial(const Step& step, int contact, EventKind kind) const {
  const ReducedContact& c = system_.contacts()[static_cast<std::size_t>(contact)];
  Polynomial g;
  const bool is_distance = kind == EventKind::touch || kind == EventKind::part ||
                           (kind == EventKind::release && is_continuous(c.law));
  if (is_distance && !c.turns()) {
    Eigen::Matrix<double, 2, Eigen::Dynamic> d = c.U * step.q;
    d.col(0) -= c.offset;
    d /= c.clearance;
    if (const auto exact = beyond_surface(c, d.row(0).transpose(), d.row(1).transpose())) {
      return kind == EventKind::touch ? -*exact : *exact;
    }
  }
  const Interpolation& table = interpolation();
  Eigen::Matrix<double, samples, 1> values;
  Vec y(system_.size());
  const Event event{0.0, contact, kind};
  for (int i = 0; i < samples; ++i) {
    step.at(table.s(i), y.data());
    values(i) = value(event, step.instant(table.s(i)), y.data(), step.contacts);
  }
  const Eigen::Matrix<double, samples, 1> powers = table.to_powers * values;
  g.degree = samples - 1;
  for (int k = 0; k < samples; ++k) g.c[static_cast<std::size_t>(k)] = powers(k);
  return g;
}

std::optional<Event> EventWatcher::first(const Step& step) const {
  std::optional<Event> earliest;
  bool comes_near = true;  // what is true of one place that turns is true of all of its contact
  for (int i = 0; i < static_cast<int>(step.contacts.size()); ++i) {
    const ReducedContact& c = system_.contacts()[static_cast<std::size_t>(i)];
    if (c.turns()) {
      if (c.place == 0) comes_near = may_reach(c, step);
      if (!comes_near && !step.contacts[static_cast<std::size_t>(i)].in_touch()) continue;
    }
    for (const EventKind kind : kinds(i, step.contacts)) {
      Polynomial g = polynomial(step, i, kind);
      if (is_level(i, kind)) g.c[1] = 0.0;
      const auto s = first_downward_zero(g, on_surface(i, kind));
      if (s && (!earliest || *s < earliest->s)) earliest = Event{*s, i, kind};
    }
  }
  return earliest;
}

void EventWatcher::enter_touch(int contact, const Instant& at, const double* y,
                               ContactStates& states) {
  const auto i = static_cast<std::size_t>(contact);
  const ReducedContact& c = system_.contacts()[i];
  for (std::size_t j = 0; j < states.size(); ++j) {  // its slip is known from others
    if (j == i || !states[j].in_touch() || !system_.slip_alike(i, j)) continue;
    states[i] = states[j];
    return;
  }
  const ContactForces f = kinematics(c, at, y, system_.layout());
  states[i] = {Touch::sliding, f.slip >= 0.0 ? 1.0 : -1.0};
  const bool is_at_rest = std::abs(f.slip) <= 1e-12 * speed_scale_[i];
  if (c.friction.is_exact() && is_at_rest) {
    apply({0.0, contact, EventKind::slip_stop}, at, y, states);
  }
}

void EventWatcher::set_group(int contact, const ContactState& to, bool is_level,
                             ContactStates& states) {
  system_.set_group(states, contact, to);
  for (std::size_t j = 0; j < states.size(); ++j) {
    if (!states[j].in_touch() || !system_.slip_alike(static_cast<std::size_t>(contact), j))
      continue;
    surface_[j] &= ~bit(EventKind::slip_stop);
    if (to.touch == Touch::sliding) surface_[j] |= bit(EventKind::slip_stop);
    is_level_[j] = is_level ? 1 : 0;
  }
}

void EventWatcher::apply(const Event& event, const Instant& at, const double* y,
                         ContactStates& states) {
  const auto i = static_cast<std::size_t>(event.contact);
  const ReducedContact& c = system_.contacts()[i];
  unsigned& surface = surface_[i];
  surface = 0u;
  is_level_[i] = 0;
  switch (event.kind) {
    case EventKind::touch:
      surface = is_continuous(c.law) ? bit(EventKind::release) : 0u;
      enter_touch(event.contact, at, y, states);
      break;
    case EventKind::retouch:
      surface = bit(is_continuous(c.law) ? EventKind::pull : EventKind::release);
      enter_touch(event.contact, at, y, states);
      break;
    case EventKind::part:
      surface = bit(EventKind::touch);
      states[i] = {Touch::apart, 1.0};
      break;
    case EventKind::release:
      if (is_continuous(c.law) || kinematics(c, at, y, system_.layout()).depth <= 0.0) {
        surface = bit(EventKind::touch);
        states[i] = {Touch::apart, 1.0};
        break;
      }
      [[fallthrough]];
    case EventKind::pull:
      surface = bit(EventKind::retouch);
      states[i] = {Touch::receding, 1.0};
      break;
    case EventKind::slip_stop: {
      const Hold hold = system_.hold(at, y, states, event.contact);
      if (hold.is_enough()) {
        set_group(event.contact, {Touch::sticking, 1.0}, false, states);
      } else {  // even full friction does not hold it: it slides on, or back
        set_group(event.contact, {Touch::sliding, hold.force > 0.0 ? 1.0 : -1.0}, false, states);
      }
      break;
    }
    case EventKind::stick_limit: {
      const double force = system_.hold(at, y, states, event.contact).force;
      set_group(event.contact, {Touch::sliding, force > 0.0 ? 1.0 : -1.0}, true, states);
      break;
    }
  }
}

void EventWatcher::moved_on() {
  std::fill(surface_.begin(), surface_.end(), 0u);
  std::fill(is_level_.begin(), is_level_.end(), char{0});
}

}  // namespace whirl::inline dyn

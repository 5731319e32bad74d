#include "libdyn/system/contact_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double rest_slip = 1e-12;  ///< of the rim speed: as good as no slip

}  // namespace

ContactForces kinematics(const ReducedContact& c, const double* y, StateLayout layout) {
  assert(!c.turns());
  return kinematics(c, 0.0, y, layout);
}

ContactForces kinematics(const ReducedContact& c, const Instant& at, const double* y,
                         StateLayout layout) {
  const auto eta = layout.eta(y), rate = layout.rate(y);
  const Vec2 d = c.U * eta - c.offset, w = c.U * rate, v = c.rubs_apart() ? Vec2(c.V * rate) : w;
  return kinematics(c, at, {{d(0), d(1)}, {w(0), w(1)}, {v(0), v(1)}});
}

// Flat: a call for each of geometry and law takes as long as what they compute.
[[gnu::flatten]] ContactForces kinematics(const ReducedContact& c, const Instant& at,
                                          const GapMotion<double>& motion) {
  const ContactGap<double> gap = std::visit(
      [&](const auto& geometry) { return geometry.gap(c.space(), at, motion); }, c.geometry);
  ContactForces f{.n = {gap.n[0], gap.n[1]},
                  .r = gap.r,
                  .depth = gap.depth,
                  .rate = gap.rate,
                  .slip = gap.slip};
  f.normal = normal_force(c.law, f.depth, f.rate);
  return f;
}

double beyond_surface(const ReducedContact& c, const ContactForces& f) {
  const ContactGap<double> gap{f.r, f.depth, f.rate, f.slip, {f.n(0), f.n(1)}};
  return std::visit([&](const auto& geometry) { return geometry.beyond(gap, c.space()); },
                    c.geometry);
}

std::optional<Polynomial> beyond_surface(const ReducedContact& c, const PathPowers& x,
                                         const PathPowers& y) {
  return std::visit([&](const auto& geometry) { return geometry.beyond(x, y); }, c.geometry);
}

double sliding_friction(const ReducedContact& c, const ContactState& state,
                        const ContactForces& f) {
  if (c.friction.mu == 0.0) return 0.0;
  const double share = c.friction.is_exact() ? state.sign : c.friction.smooth_share(f.slip);
  return c.friction.mu * share * f.normal;
}

void push(const ReducedContact& c, const ContactForces& f, double T, Eigen::Ref<Vec> a) {
  if (!c.rubs_apart()) {
    a.noalias() -= c.B * (f.normal * f.n + T * f.t());
    return;
  }
  a.noalias() -= c.B * (f.normal * f.n);
  a.noalias() -= c.B_t * (T * f.t());
}

bool ContactSystem::leads(const ContactStates& states, std::size_t i) const {
  if (states[i].touch != Touch::sticking) return false;
  for (std::size_t j = 0; j < i; ++j) {
    if (states[j].touch == Touch::sticking && slip_alike(i, j)) return false;
  }
  return true;
}

void ContactSystem::set_group(ContactStates& states, int i, const ContactState& to) const {
  for (std::size_t j = 0; j < states.size(); ++j) {
    if (states[j].in_touch() && slip_alike(j, static_cast<std::size_t>(i))) states[j] = to;
  }
}

void ContactSystem::smooth_acceleration(const Instant& at, const double* y, double* a) const {
  Eigen::Map<Vec> result(a, coordinates());
  const auto eta = layout().eta(y), rate = layout().rate(y);
  const ReducedExcitation& turning = synchronous_load();
  result =
      constant_load() + std::cos(at.phase) * turning.cosine + std::sin(at.phase) * turning.sine;
  for (const ReducedExcitation& load : other_loads()) {
    const double alpha = load.angle(at);
    result += std::cos(alpha) * load.cosine + std::sin(alpha) * load.sine;
  }
  result.noalias() -= K_ * eta;
  result.noalias() -= D_ * rate;
  for (const ReducedFilm& film : films_) result.noalias() += film.B * film_force(film, y, layout());
}

const ReducedFilm* ContactSystem::left_bearing(const double* y) const {
  for (const ReducedFilm& film : films_) {
    if (!(eccentricity(film, y, layout()) < 1.0)) return &film;
  }
  return nullptr;
}

void ContactSystem::forces(const Instant& at, const double* y, const ContactStates& states,
                           std::vector<ContactForces>& out) const {
  const int n = coordinates();
  out.resize(contacts_.size());
  std::vector<int> sticking;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    out[i] = {};
    if (contacts_[i].turns() && states[i].touch == Touch::apart) continue;  // most of many
    out[i] = kinematics(contacts_[i], at, y, layout());
    if (leads(states, i)) {
      sticking.push_back(static_cast<int>(i));
    } else if (states[i].touch == Touch::sliding) {
      out[i].friction = sliding_friction(contacts_[i], states[i], out[i]);
    }
  }
  if (sticking.empty()) return;

  // friction that keeps every sticking slip velocity constant:
  //   v_t' = t . u'' - (t . u')(n . u') / r = 0,   u'' = U eta''
  Vec a(n);
  smooth_acceleration(at, y, a.data());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!states[i].in_touch()) continue;
    push(contacts_[i], out[i], out[i].friction, a);
  }
  const auto m = static_cast<Eigen::Index>(sticking.size());
  Mat influence(m, m);
  Vec slip_rate(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto ij = static_cast<std::size_t>(sticking[static_cast<std::size_t>(j)]);
    const ContactForces& f = out[ij];
    const double along = f.slip - contacts_[ij].rim_speed;  // t . u'
    slip_rate(j) = f.t().dot(contacts_[ij].U * a) - along * f.rate / f.r;
    for (Eigen::Index k = 0; k < m; ++k) {
      const auto ik = static_cast<std::size_t>(sticking[static_cast<std::size_t>(k)]);
      influence(j, k) = f.t().dot(contacts_[ij].U * (contacts_[ik].B * out[ik].t()));
    }
  }
  const Vec T = DenseLu<Mat>(influence).solve(slip_rate);
  for (Eigen::Index j = 0; j < m; ++j) {
    out[static_cast<std::size_t>(sticking[static_cast<std::size_t>(j)])].friction = T(j);
  }
  share_friction(states, out);
}

void ContactSystem::share_friction(const ContactStates& states,
                                   std::vector<ContactForces>& forces) const {
  const auto limit = [&](std::size_t i) {
    return contacts_[i].friction.mu * std::max(forces[i].normal, 0.0);
  };
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!leads(states, i)) continue;
    const auto holds = [&](std::size_t j) {
      return states[j].touch == Touch::sticking && slip_alike(i, j);
    };
    double sum = 0.0;
    for (std::size_t j = i; j < contacts_.size(); ++j) {
      if (holds(j)) sum += limit(j);
    }
    if (!(sum > limit(i))) continue;  // it holds alone
    const double share = forces[i].friction / sum;
    for (std::size_t j = i; j < contacts_.size(); ++j) {
      if (holds(j)) forces[j].friction = share * limit(j);
    }
  }
}

void ContactSystem::acceleration(const Instant& at, const double* y, const ContactStates& states,
                                 double* a) const {
  const int n = coordinates();
  Eigen::Map<Vec> result(a, n);
  smooth_acceleration(at, y, a);
  bool any_sticks = false;
  for (const ContactState& s : states) any_sticks = any_sticks || s.touch == Touch::sticking;
  if (any_sticks) {
    std::vector<ContactForces> all;
    forces(at, y, states, all);
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!states[i].in_touch()) continue;
      push(contacts_[i], all[i], all[i].friction, result);
    }
    return;
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (states[i].touch != Touch::sliding) continue;
    const ReducedContact& c = contacts_[i];
    const ContactForces f = kinematics(c, at, y, n);
    push(c, f, sliding_friction(c, states[i], f), result);
  }
}

void ContactSystem::acceleration(const Instant& at, const double* y, double* a) const {
  const int n = coordinates();
  Eigen::Map<Vec> result(a, n);
  smooth_acceleration(at, y, a);
  for (const ReducedContact& c : contacts_) {
    const ContactForces f = kinematics(c, at, y, n);
    if (f.depth <= 0.0 || f.normal <= 0.0) continue;
    const ContactState state{Touch::sliding, f.slip >= 0.0 ? 1.0 : -1.0};
    push(c, f, sliding_friction(c, state, f), result);
  }
}

Hold ContactSystem::hold(const Instant& at, const double* y, const ContactStates& states,
                         int i) const {
  const auto ui = static_cast<std::size_t>(i);
  ContactStates trial = states;
  trial[ui].touch = Touch::sticking;
  set_group(trial, i, {Touch::sticking, 1.0});
  std::vector<ContactForces> all;
  forces(at, y, trial, all);
  Hold hold;
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    if (trial[j].touch != Touch::sticking || !slip_alike(ui, j)) continue;
    hold.force += all[j].friction;
    hold.limit += contacts_[j].friction.mu * all[j].normal;
  }
  return hold;
}

ContactStates ContactSystem::classify(const Instant& at, const double* y) const {
  ContactStates states(contacts_.size());
  std::vector<int> at_rest;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ReducedContact& c = contacts_[i];
    const ContactForces f = kinematics(c, at, y, coordinates());
    if (f.depth <= 0.0) continue;
    if (f.normal <= 0.0) {
      states[i].touch = Touch::receding;
      continue;
    }
    states[i] = {Touch::sliding, f.slip >= 0.0 ? 1.0 : -1.0};
    const double rest = rest_slip * std::max(std::abs(c.rim_speed), length_scale_ * phase_rate());
    if (c.friction.is_exact() && std::abs(f.slip) <= rest) at_rest.push_back(static_cast<int>(i));
  }
  for (const int i : at_rest) {
    if (states[static_cast<std::size_t>(i)].touch == Touch::sticking) continue;  // with another
    const Hold needed = hold(at, y, states, i);
    set_group(states, i,
              needed.is_enough() ? ContactState{Touch::sticking, 1.0}
                                 : ContactState{Touch::sliding, needed.force > 0.0 ? 1.0 : -1.0});
  }
  return states;
}

void ContactSystem::remove_slip(double* y, const ContactStates& states) const {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!leads(states, i)) continue;
    const ContactForces f = kinematics(contacts_[i], y, layout());
    const Vec impulse = contacts_[i].B * f.t();  // velocity from one along t: keeps the momentum
    layout().rate(y) -= impulse * (f.slip / f.t().dot(contacts_[i].U * impulse));
  }
}

double distance(const ContactSystem& system, const Vec& a, const Vec& b) {
  return ((a - b).array() / system.state_scale().array()).abs().maxCoeff();
}

}  // namespace whirl::inline dyn

#include "libdyn/system/contact_ports.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "libbase/constants.hpp"
#include "libbase/legendre.hpp"
#include "libcontact/dual_functions.hpp"
#include "libdyn/system/touch_spans.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int gauss_points = 16;
constexpr double panel = 10.0;    ///< of a span [rad of the product of two highest harmonics]
constexpr int per_harmonic = 8;   ///< instants of what touches all the time, and of films
constexpr int fewest = 64;        ///< and of a revolution
constexpr double nothing = 1e-9;  ///< of a force that does not jump, over that of a clearance

/// Force of a contact of P ports, (u, u') as variables 0 ... 2 P - 1.
template <int P>
struct Push {
  using D = Dual<2 * P>;
  ContactGap<D> gap;
  D normal;
};

template <int P>
Push<P> push_of(const ReducedContact& c, double phase, const Vec& u, const Vec& rate) {
  using D = typename Push<P>::D;
  GapMotion<D> motion;
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    motion.d[k] = D::variable(u(i), i) - c.offset(i);
    motion.w[k] = D::variable(rate(i), P + i);
    motion.v[k] = D::variable(rate(P - 2 + i), P + P - 2 + i);  // P = 4: where friction acts
  }
  Push<P> p;
  p.gap = std::visit([&](const auto& geometry) { return geometry.gap(c.space(), phase, motion); },
                     c.geometry);
  p.normal =
      std::visit([&](const auto& law) { return D(law.normal(p.gap.depth, p.gap.rate)); }, c.law);
  return p;
}

/// The sample of g = -N n - T t, T = mu N s; of 4 ports N has the first two, T the others.
template <int P>
PortSample sample_of(const ReducedContact& c, const Push<P>& p, double sign, double theta,
                     double share) {
  using D = typename Push<P>::D;
  D friction = 0.0;
  if (c.friction.mu != 0.0) {
    const Friction& f = c.friction;
    if (f.is_exact()) {
      friction = f.mu * sign * p.normal;
    } else {
      friction = f.mu * p.normal;
      if (f.slip != Slip::forward) friction = friction * tanh(p.gap.slip / f.tolerance);
    }
  }
  D g[P];
  const auto t = p.gap.t();
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    g[i] = -p.normal * p.gap.n[k];
    g[P - 2 + i] = g[P - 2 + i] - friction * t[k];
  }
  PortSample s{theta, share, PortVec(P), PortMat(P, P), PortMat(P, P)};
  for (int i = 0; i < P; ++i) {
    s.g(i) = g[i].value;
    s.by_u.row(i) = g[i].slopes.template head<P>();
    s.by_rate.row(i) = g[i].slopes.template tail<P>();
  }
  return s;
}

/// What an event adds to slopes: the force jumps by g where h = 0, whose slopes and rate are given.
template <int P>
PortSample jump(const PortVec& g, const Dual<2 * P>& h, double h_by_theta, double theta) {
  PortSample s{theta, 1.0 / turn, PortVec::Zero(P), PortMat(P, P), PortMat(P, P)};
  s.by_u = g * h.slopes.template head<P>().transpose() / std::abs(h_by_theta);
  s.by_rate = g * h.slopes.template tail<P>().transpose() / std::abs(h_by_theta);
  return s;
}

template <int P>
void sample_contact(const ReducedContact& c, const Periodic& motion, const GaussRule& gauss,
                    std::vector<PortSample>& samples) {
  const ContactPath path(c, motion);
  const auto push_at = [&](double theta) {
    const auto [u, rate] = motion.at(theta);
    return push_of<P>(c, motion.phase(theta), u, rate);
  };
  const auto add = [&](const ContactPath::Span& span, double theta, double share) {
    samples.push_back(sample_of<P>(c, push_at(theta), span.sign, theta, share));
  };
  for (const ContactPath::Span& span : path.spans()) {
    if (span.is_whole()) {
      const int N = std::max(fewest * motion.period, per_harmonic * motion.harmonics());
      for (int i = 0; i < N; ++i) add(span, turn * i / N, 1.0 / N);
      continue;
    }
    // x = (3 s - s^3) / 2 on [-1, 1] makes a force d^(3/2) smooth at both ends
    const double half = 0.5 * (span.to - span.from), middle = 0.5 * (span.to + span.from);
    const int panels = 2 + static_cast<int>(2.0 * half * 2.0 * motion.harmonics() / panel);
    for (int k = 0; k < panels; ++k) {
      for (int i = 0; i < gauss_points; ++i) {
        const double s = 2.0 * (k + gauss.s(i)) / panels - 1.0;
        const double x = 0.5 * s * (3.0 - s * s), x_by_s = 1.5 * (1.0 - s * s);
        add(span, middle + half * x, half * x_by_s * 2.0 * gauss.w(i) / panels / turn);
      }
    }
    for (const bool is_begin : {true, false}) {
      const double theta = is_begin ? span.from : span.to;
      const Push<P> p = push_at(theta);
      if (is_begin ? span.begins : span.ends) {
        if (is_continuous(c.law)) continue;
        if (!(p.normal.value > nothing * normal_force(c.law, c.clearance, 0.0))) continue;
        const double rate = path.at(theta).rate / motion.frequency();
        const PortVec g = sample_of<P>(c, p, span.sign, theta, 0.0).g;
        samples.push_back(jump<P>(g, p.gap.depth, rate, theta));
      } else {  // friction turns round; each of the two spans takes its half
        constexpr double h = 1e-6;
        const double by_theta = (path.at(theta + h).slip - path.at(theta - h).slip) / (2.0 * h);
        PortVec g = PortVec::Zero(P);
        for (int i = 0; i < 2; ++i) {
          g(P - 2 + i) =
              -c.friction.mu * p.normal.value * p.gap.t()[static_cast<std::size_t>(i)].value;
        }
        samples.push_back(jump<P>(g, p.gap.slip, by_theta, theta));
      }
    }
  }
}

bool film_law(const ReducedFilm& film, const PortVec& u, const PortVec& rate, PortSample& s) {
  const auto slopes = film_slopes(film, u.head<2>(), rate.head<2>());
  if (!slopes) return false;
  s.g.head<2>() = slopes->force;
  s.by_u.topLeftCorner<2, 2>() = slopes->by_u;
  s.by_rate.topLeftCorner<2, 2>() = slopes->by_u_rate;
  return true;
}

PortForces contact_port(std::vector<ReducedContact> contacts) {
  const ReducedContact& c = contacts.front();
  PortForces forces{.name = c.name, .U = c.U, .B = c.B};
  if (c.rubs_apart()) {
    forces.U.resize(4, c.U.cols());
    forces.U << c.U, c.V;
    forces.B.resize(c.B.rows(), 4);
    forces.B << c.B, c.B_t;
  }
  forces.sample = [contacts = std::move(contacts), gauss = gauss_rule(gauss_points)](
                      const Periodic& motion, std::vector<PortSample>& samples) {
    for (const ReducedContact& contact : contacts) {
      if (contact.rubs_apart()) {
        sample_contact<4>(contact, motion, gauss, samples);
      } else {
        sample_contact<2>(contact, motion, gauss, samples);
      }
    }
    return true;
  };
  return forces;
}

/// Motion of a contact's ports.
Periodic path_of(const ReducedContact& c, const Periodic& motion) {
  Mat rows(c.rubs_apart() ? 4 : 2, motion.coefficients.rows());
  rows.topRows(2) = c.U;
  if (c.rubs_apart()) rows.bottomRows(2) = c.V;
  return {rows * motion.coefficients, motion.period, motion.rate};
}

}  // namespace

std::vector<PortForces> port_forces(const ContactSystem& system) {
  std::vector<PortForces> all;
  const auto& contacts = system.contacts();
  for (std::size_t i = 0; i < contacts.size();) {
    std::vector<ReducedContact> together;
    const int owner = contacts[i].owner;
    for (; i < contacts.size() && contacts[i].owner == owner; ++i) together.push_back(contacts[i]);
    all.push_back(contact_port(std::move(together)));
  }
  for (const ReducedFilm& film : system.films()) {
    all.push_back(smooth_force(
        film.name, film.U, film.B,
        [film](double, const PortVec& u, const PortVec& rate, PortSample& s) {
          return film_law(film, u, rate, s);
        },
        per_harmonic));
  }
  return all;
}

std::vector<ContactMeasure> measures_on(const ContactSystem& system, const Periodic& motion) {
  std::vector<ContactMeasure> all(static_cast<std::size_t>(system.owners()));
  std::vector<std::vector<std::pair<double, double>>> touching(all.size());
  const double whole = motion.period * turn / motion.rate;
  for (const ReducedContact& c : system.contacts()) {
    const auto owner = static_cast<std::size_t>(c.owner);
    ContactMeasure& m = all[owner];
    m.name = c.name;
    const Periodic ports = path_of(c, motion);
    const ContactPath path(c, ports);
    for (const ContactPath::Span& span : path.spans()) {
      touching[owner].emplace_back(span.from, span.to);
      if (span.begins) m.impacts += 1.0;
      const double length = span.to - span.from;
      const int N = 16 + static_cast<int>(4.0 * length * motion.harmonics());
      for (int i = 0; i <= N; ++i) {
        const ContactForces f = path.at(span.from + length * i / N);
        m.max_normal = std::max(m.max_normal, f.normal);
        const ContactState state{Touch::sliding, span.sign};
        m.max_tangential = std::max(m.max_tangential, std::abs(sliding_friction(c, state, f)));
        const double weight = (i == 0 || i == N ? 0.5 : 1.0) / N;
        m.mean_slip += weight * length * f.slip;
      }
      m.touch_time += length / turn * whole;
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    ContactMeasure& m = all[i];
    m.mean_slip = m.touch_time > 0.0 ? m.mean_slip / turn * whole / m.touch_time : 0.0;
    // time with any of the blades
    std::vector<std::pair<double, double>> cut;
    for (const auto& [from, to] : touching[i]) {
      cut.emplace_back(from, std::min(to, turn));
      if (to > turn) cut.emplace_back(0.0, to - turn);
    }
    std::sort(cut.begin(), cut.end());
    double reached = 0.0, covered = 0.0;
    for (const auto& [from, to] : cut) {
      covered += std::max(0.0, to - std::max(from, reached));
      reached = std::max(reached, to);
    }
    m.duty = covered > (1.0 - 1e-12) * turn ? 1.0 : covered / turn;
  }
  return all;
}

std::string sticks_on(const ContactSystem& system, const Periodic& motion) {
  const auto& contacts = system.contacts();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ReducedContact& c = contacts[i];
    if (!c.friction.is_exact()) continue;
    const Periodic ports = path_of(c, motion);
    const ContactPath path(c, ports);
    for (const ContactPath::Span& span : path.spans()) {
      if (span.begins) continue;  // it does not begin with a reversal
      if (span.is_whole()) continue;
      const auto [x, rate] = motion.at(span.from);
      Vec y(2 * x.size());
      y << x, rate;
      const double phase = motion.phase(span.from);
      const ContactStates states = system.classify(phase, y.data());
      if (system.hold(phase, y.data(), states, static_cast<int>(i)).is_enough()) return c.name;
    }
  }
  return {};
}

}  // namespace whirl::inline dyn

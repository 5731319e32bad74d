#include "libdyn/system/contact_ports.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/legendre.hpp"
#include "libcontact/dual_functions.hpp"
#include "libdyn/system/sloped_contact.hpp"
#include "libdyn/system/touch_spans.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int gauss_points = 16;
constexpr double panel = 10.0;         ///< of a span [rad of the product of two highest harmonics]
constexpr int per_harmonic = 8;        ///< instants of what touches all the time, and of films
constexpr double same_surface = 1e-9;  ///< depth over the clearance, of a touch that was located
constexpr double nothing = 1e-9;       ///< of a force that does not jump, over that of a clearance

/// Derivative of the rate of the phase, over it.
double faster_phase(const ContactSystem& system, const NumberSlopes& slopes) {
  return slopes.of([](const ContactSystem& s) { return s.phase_rate(); }) / system.phase_rate();
}

/// Kinematics and normal force of a contact with their derivatives.
template <class D>
struct Push {
  ContactGap<D> gap;
  D normal;
};
template <class D, class Law>
Push<D> push_of(const ContactGap<D>& gap, const Law& any) {
  return {gap,
          std::visit([&](const auto& law) { return D(law.normal(gap.depth, gap.rate)); }, any)};
}

/// g = -N n - T t, T = mu N s; of 4 ports N has the first two, T the others.
/// @param mu, tolerance  of the friction, maybe with derivatives
template <int P, class D, class Number>
std::array<D, P> force_of(const Friction& f, const Number& mu, const Number& tolerance,
                          const Push<D>& p, double sign) {
  D friction = 0.0;
  if (f.is_exact()) {
    friction = mu * sign * p.normal;
  } else if (f.slip == Slip::forward) {
    friction = mu * p.normal;
  } else if (f.tolerance > 0.0) {
    friction = mu * p.normal * tanh(p.gap.slip / tolerance);
  }
  std::array<D, P> g;
  const auto t = p.gap.t();
  for (std::size_t i = 0; i < 2; ++i) {
    g[i] = -p.normal * p.gap.n[i];
    g[P - 2 + i] = g[P - 2 + i] - friction * t[i];
  }
  return g;
}

/// Samples of the force of a contact of P ports, with its slopes: (u, u') are variables 0 ... 2 P
/// - 1.
template <int P>
struct ForceSamples {
  static constexpr int ports = P;
  using D = Dual<2 * P>;

  Push<D> push_at(const ReducedContact& c, const Instant& when, const Periodic::Instant& at) const {
    GapMotion<D> motion;
    for (int i = 0; i < 2; ++i) {
      const auto k = static_cast<std::size_t>(i);
      motion.d[k] = D::variable(at.x(i), i) - c.offset(i);
      motion.w[k] = D::variable(at.rate(i), P + i);
      motion.v[k] = D::variable(at.rate(P - 2 + i), P + P - 2 + i);  // P = 4: where friction acts
    }
    const auto gap = std::visit(
        [&](const auto& geometry) { return geometry.gap(c.space(), when, motion); }, c.geometry);
    return push_of<D>(gap, c.law);
  }
  std::array<D, P> force(const ReducedContact& c, const Push<D>& p, double sign) const {
    return force_of<P>(c.friction, c.friction.mu, c.friction.tolerance, p, sign);
  }
  PortSample sample(const std::array<D, P>& g, double theta, double share) const {
    PortSample s{theta, share, PortVec(P), PortMat(P, P), PortMat(P, P)};
    for (int i = 0; i < P; ++i) {
      const D& force = g[static_cast<std::size_t>(i)];
      s.g(i) = force.value;
      s.by_u.row(i) = force.slopes.template head<P>();
      s.by_rate.row(i) = force.slopes.template tail<P>();
    }
    return s;
  }
  /// What an event adds to slopes: the force jumps by g where h = 0, whose slopes and rate are
  /// given.
  PortSample jump(const PortVec& g, const D& h, double h_by_theta, double theta) const {
    PortSample s{theta, 1.0 / turn, PortVec::Zero(P), PortMat(P, P), PortMat(P, P)};
    s.by_u = g * h.slopes.template head<P>().transpose() / std::abs(h_by_theta);
    s.by_rate = g * h.slopes.template tail<P>().transpose() / std::abs(h_by_theta);
    return s;
  }
};

/// Samples of the derivative of that force by a parameter.
template <int P>
struct SlopeSamples {
  static constexpr int ports = P;
  using D = ByParameter;
  const SlopedContact& sloped;
  double faster;  ///< derivative of the rate of the phase over it: rates of a series go with it

  Push<D> push_at(const ReducedContact&, const Instant& when, const Periodic::Instant& at) const {
    const auto rate = [&](int i) { return D(at.rate(i), D::Slopes(faster * at.rate(i))); };
    const GapMotion<D> motion{{at.x(0), at.x(1)}, {rate(0), rate(1)}, {rate(P - 2), rate(P - 1)}};
    return push_of<D>(sloped.gap(when, motion), sloped.law);
  }
  std::array<D, P> force(const ReducedContact& c, const Push<D>& p, double sign) const {
    return force_of<P>(c.friction, sloped.mu, sloped.tolerance, p, sign);
  }
  PortSample sample(const std::array<D, P>& g, double theta, double share) const {
    PortSample s{theta, share, PortVec(P), {}, {}};
    for (int i = 0; i < P; ++i) s.g(i) = g[static_cast<std::size_t>(i)].slopes(0);
    return s;
  }
  PortSample jump(const PortVec& g, const D& h, double h_by_theta, double theta) const {
    return {theta, 1.0 / turn, g * (h.slopes(0) / std::abs(h_by_theta)), {}, {}};
  }
};

/// @param by  what is sampled: ForceSamples or SlopeSamples
template <class Samples>
void sample_contact(const Samples& by, const ReducedContact& c, const Periodic& motion,
                    const GaussRule& gauss, std::vector<PortSample>& samples) {
  constexpr int P = Samples::ports;
  using D = typename Samples::D;
  const PeriodicContact path(c, motion);
  const auto push_at = [&](double theta) {
    return by.push_at(c, motion.phase(theta), motion.at(theta));
  };
  const auto add = [&](const PeriodicContact::Span& span, double theta, double share) {
    samples.push_back(by.sample(by.force(c, push_at(theta), span.sign), theta, share));
  };
  for (const PeriodicContact::Span& span : path.spans()) {
    if (span.is_whole()) {
      const int N = even_instants(motion, per_harmonic);
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
      const Push<D> p = push_at(theta);
      PortVec g = PortVec::Zero(P);
      if (is_begin ? span.begins : span.ends) {
        if (is_continuous(c.law)) continue;
        if (!(p.normal.value > nothing * normal_force(c.law, c.clearance, 0.0))) continue;
        const double rate = path.at(theta).rate / motion.frequency();
        const std::array<D, P> force = by.force(c, p, span.sign);
        for (int i = 0; i < P; ++i) g(i) = force[static_cast<std::size_t>(i)].value;
        samples.push_back(by.jump(g, p.gap.depth, rate, theta));
      } else if (c.friction.is_exact()) {  // it turns round; each of two spans takes its half
        constexpr double h = 1e-6;
        const double by_theta = (path.at(theta + h).slip - path.at(theta - h).slip) / (2.0 * h);
        for (int i = 0; i < 2; ++i) {
          g(P - 2 + i) =
              -c.friction.mu * p.normal.value * p.gap.t()[static_cast<std::size_t>(i)].value;
        }
        samples.push_back(by.jump(g, p.gap.slip, by_theta, theta));
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

bool film_law_slope(const SlopedFilm& film, double faster, const PortVec& u, const PortVec& rate,
                    PortSample& s) {
  using D = ByParameter;
  const auto number = [&](double v) { return D(v, D::Slopes(faster * v)); };
  const auto force = film.force({u(0), u(1)}, {number(rate(0)), number(rate(1))});
  if (!force) return false;
  for (const int i : {0, 1}) s.g(i) = (*force)[static_cast<std::size_t>(i)].slopes(0);
  return true;
}

/// Rows that a contact's force acts along, and what it does there: 2 ports, or 4 with friction
/// apart.
Mat closing_and_rubbing(const ReducedContact& c) {
  Mat U(c.rubs_apart() ? 4 : 2, c.U.cols());
  U.topRows(2) = c.U;
  if (c.rubs_apart()) U.bottomRows(2) = c.V;
  return U;
}
Mat pressing_and_rubbing(const ReducedContact& c) {
  Mat B(c.B.rows(), c.rubs_apart() ? 4 : 2);
  B.leftCols(2) = c.B;
  if (c.rubs_apart()) B.rightCols(2) = c.B_t;
  return B;
}

PortForces contact_port(std::vector<ReducedContact> contacts) {
  const ReducedContact& c = contacts.front();
  PortForces forces{
      .name = c.name, .U = closing_and_rubbing(c), .B = pressing_and_rubbing(c), .sample = {}};
  forces.sample = [contacts = std::move(contacts), gauss = gauss_rule(gauss_points)](
                      const Periodic& motion, std::vector<PortSample>& samples) {
    for (const ReducedContact& contact : contacts) {
      if (contact.rubs_apart()) {
        sample_contact(ForceSamples<4>{}, contact, motion, gauss, samples);
      } else {
        sample_contact(ForceSamples<2>{}, contact, motion, gauss, samples);
      }
    }
    return true;
  };
  return forces;
}

/// Numbers of the contacts of each owner.
std::vector<std::vector<std::size_t>> owned(const ContactSystem& system) {
  std::vector<std::vector<std::size_t>> all(static_cast<std::size_t>(system.owners()));
  for (std::size_t i = 0; i < system.contacts().size(); ++i) {
    all[static_cast<std::size_t>(system.contacts()[i].owner)].push_back(i);
  }
  return all;
}

/// Derivative of the forces of some contacts.
PortForces contact_port_slope(const ContactSystem& system, const std::vector<std::size_t>& numbers,
                              const NumberSlopes& slopes) {
  const std::size_t first = numbers.front();
  PortForces forces{
      .name = system.contacts()[first].name,
      .U = slopes.of([&](const auto& s) { return closing_and_rubbing(s.contacts()[first]); }),
      .B = slopes.of([&](const auto& s) { return pressing_and_rubbing(s.contacts()[first]); }),
      .sample = {}};
  std::vector<SlopedContact> contacts;
  for (const std::size_t i : numbers) contacts.push_back(sloped_contact(system, i, slopes));
  forces.sample = [contacts = std::move(contacts), faster = faster_phase(system, slopes),
                   gauss = gauss_rule(gauss_points)](const Periodic& motion,
                                                     std::vector<PortSample>& samples) {
    for (const SlopedContact& c : contacts) {
      if (c.contact.rubs_apart()) {
        sample_contact(SlopeSamples<4>{c, faster}, c.contact, motion, gauss, samples);
      } else {
        sample_contact(SlopeSamples<2>{c, faster}, c.contact, motion, gauss, samples);
      }
    }
    return true;
  };
  return forces;
}

/// Motion of a contact's ports.
Periodic path_of(const ReducedContact& c, const Periodic& motion) {
  return {closing_and_rubbing(c) * motion.coefficients, motion.period, motion.rate};
}

}  // namespace

std::vector<PortForces> port_forces(const ContactSystem& system) {
  std::vector<PortForces> all;
  for (const std::vector<std::size_t>& numbers : owned(system)) {
    std::vector<ReducedContact> together;
    for (const std::size_t i : numbers) together.push_back(system.contacts()[i]);
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

std::vector<PortForces> port_force_slopes(const ContactSystem& system, const NumberSlopes& slopes) {
  std::vector<PortForces> all;
  for (const std::vector<std::size_t>& numbers : owned(system)) {
    all.push_back(contact_port_slope(system, numbers, slopes));
  }
  for (std::size_t i = 0; i < system.films().size(); ++i) {
    all.push_back(smooth_force(
        system.films()[i].name, slopes.of([i](const auto& s) -> Mat { return s.films()[i].U; }),
        slopes.of([i](const auto& s) -> Mat { return s.films()[i].B; }),
        [film = sloped_film(system, i, slopes), faster = faster_phase(system, slopes)](
            double, const PortVec& u, const PortVec& rate, PortSample& s) {
          return film_law_slope(film, faster, u, rate, s);
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
    const PeriodicContact path(c, ports);
    for (const PeriodicContact::Span& span : path.spans()) {
      touching[owner].emplace_back(span.from, span.to);
      // a force that begins beyond the surface presses again, and the contact has not come to touch
      const bool is_beyond = path.at(span.from).depth > same_surface * c.clearance;
      if (span.begins && !is_beyond) m.impacts += 1.0;
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
    const PeriodicContact path(c, ports);
    for (const PeriodicContact::Span& span : path.spans()) {
      if (span.begins) continue;  // it does not begin with a reversal
      if (span.is_whole()) continue;
      const auto [x, rate] = motion.at(span.from);
      const StateLayout layout = system.layout();
      Vec y(layout.size());
      layout.eta(y) = x;
      layout.rate(y) = rate;
      const double phase = motion.phase(span.from);
      const ContactStates states = system.classify(phase, y.data());
      if (system.hold(phase, y.data(), states, static_cast<int>(i)).is_enough()) return c.name;
    }
  }
  return {};
}

}  // namespace whirl::inline dyn

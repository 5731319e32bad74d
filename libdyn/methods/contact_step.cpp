// What contacts do within a collocation step, and the events in it.

#include "libdyn/methods/contact_step.hpp"

#include <algorithm>

namespace whirl::inline dyn {

namespace {

constexpr int most_halvings = 4;
constexpr int terms = StepTables::terms;

/// g(s) -> g((half + s) / 2).
void restrict_to_half(Polynomial& g, bool second) {
  double scale = 1.0;
  for (int k = 0; k <= g.degree; ++k, scale *= 0.5) g.c[static_cast<std::size_t>(k)] *= scale;
  if (!second) return;
  for (int j = 0; j < g.degree; ++j) {  // Horner's scheme: Taylor coefficients at 1
    for (int k = g.degree - 1; k >= j; --k) {
      g.c[static_cast<std::size_t>(k)] += g.c[static_cast<std::size_t>(k + 1)];
    }
  }
}

/// First fall of a polynomial whose powers cancel one another on the whole of [0, 1], as those of a
/// long step do: halves until their bounds are sharp.
std::optional<double> first_fall_in_parts(const Polynomial& g, bool on_surface, int depth = 0) {
  double lowest = g.c[0];
  for (int k = 1; k <= g.degree; ++k) lowest += std::min(0.0, g.c[static_cast<std::size_t>(k)]);
  if (lowest > 0.0) return std::nullopt;
  if (depth == most_halvings) return first_downward_zero(g, on_surface);
  Polynomial half = g;
  restrict_to_half(half, false);
  if (const auto s = first_fall_in_parts(half, on_surface, depth + 1)) return 0.5 * *s;
  half = g;
  restrict_to_half(half, true);
  if (const auto s = first_fall_in_parts(half, false, depth + 1)) return 0.5 + 0.5 * *s;
  return std::nullopt;
}

}  // namespace

ContactStep::ContactStep(const ContactSystem& system, double longest, double tolerance)
    : system_(system),
      tolerance_(tolerance),
      tables_(system, longest),
      forces_(system, tables_, tolerance),
      paths_(system.contacts().size()) {}

bool ContactStep::solve(Rung rung, const MotionState& from) {
  return forces_.solve(rung, from) && make_paths(from);
}

void ContactStep::advance(double fraction, const MotionState& from, Vec& y) {
  y = from.y;
  tables_.flow(forces_.motion().rung)
      .advance(forces_.motion().rung.level(), fraction, forces_.motion().load, forces_.motion().a,
               forces_.motion().touching, y);
}

bool ContactStep::make_paths(const MotionState& from) {
  const StepPlaces& places = tables_.places(is_touching());
  const StateLayout layout = system_.layout();
  const auto m = places.s.size();
  if (is_touching()) advance(1.0, from, end_);
  path_error_ = 0.0;
  for (std::size_t c = 0; c < paths_.size(); ++c) {
    const ReducedContact& contact = system_.contacts()[c];
    Mat& values = paths_[c].values;
    values.resize(m, StepTables::rows);
    values.row(0) << (contact.U * layout.eta(from.y)).transpose(),
        (contact.U * layout.rate(from.y)).transpose();
    const Mat within = forces_.motion().of(c);
    values.middleRows(1, within.rows()) = within;
    if (is_touching()) {
      values.row(m - 1) << (contact.U * layout.eta(end_)).transpose(),
          (contact.U * layout.rate(end_)).transpose();
    }
    values.col(0).array() -= contact.offset(0);
    values.col(1).array() -= contact.offset(1);
    // from the start, so that rounding moves nothing that rests
    const Mat legendre = places.to_legendre * (values.rowwise() - values.row(0));
    if (!legendre.allFinite()) return false;
    Mat& powers = paths_[c].powers;
    powers.noalias() = places.to_powers * legendre.leftCols<2>();
    powers.row(0) = values.row(0).head<2>();
    powers /= contact.clearance;
    if (!from.contacts[c].in_touch()) {
      path_error_ = std::max(
          path_error_, legendre.bottomLeftCorner<2, 2>().cwiseAbs().maxCoeff() / contact.clearance);
    }
  }
  return true;
}

Hold ContactStep::hold_at(Eigen::Index place, int contact, const ContactStates& states) const {
  Hold hold;
  for (std::size_t j = 0; j < states.size(); ++j) {
    if (states[j].touch != Touch::sticking) continue;
    if (!system_.slip_alike(j, static_cast<std::size_t>(contact))) continue;
    const ReducedContact& c = system_.contacts()[j];
    const ContactForces f = paths_[j].forces(c, place);
    hold.limit += c.friction.mu * f.normal;
    for (int d = 0; d < 2; ++d) {
      const auto component = (2 * static_cast<Eigen::Index>(j) + d) * terms;
      hold.force += f.t()(d) * tables_.at_places().row(place).dot(
                                   forces_.motion().a.segment(component, terms));
    }
  }
  return hold;
}

Polynomial ContactStep::polynomial(const EventWatcher& watcher, int contact, EventKind kind,
                                   double limit, const ContactStates& states) const {
  const auto i = static_cast<std::size_t>(contact);
  const ReducedContact& c = system_.contacts()[i];
  const ContactPath& path = paths_[i];
  Polynomial g;
  const bool is_distance = kind == EventKind::touch || kind == EventKind::part ||
                           (kind == EventKind::release && is_continuous(c.law));
  if (is_distance) {
    const Polynomial beyond = *beyond_surface(c, path.powers.col(0), path.powers.col(1));
    g = kind == EventKind::touch ? -beyond : beyond;
  } else {
    const auto m = static_cast<int>(path.values.rows());
    const StepPlaces& places = tables_.places(is_touching());
    Vec values(m);
    for (int k = 0; k < m; ++k) {
      if (kind == EventKind::stick_limit) {
        values(k) = watcher.stick_margin(contact, hold_at(k, contact, states));
      } else {
        values(k) = watcher.value({0.0, contact, kind}, path.forces(c, k), states[i]);
      }
    }
    const Vec powers = places.to_powers * (places.to_legendre * values);
    g.degree = m - 1;
    for (int k = 0; k < m; ++k) g.c[static_cast<std::size_t>(k)] = powers(k);
  }
  double scale = 1.0;
  for (int k = 0; k <= g.degree && limit < 1.0; ++k, scale *= limit) {
    g.c[static_cast<std::size_t>(k)] *= scale;
  }
  return g;
}

std::optional<Event> ContactStep::first_event(const EventWatcher& watcher, double limit,
                                              const MotionState& from, bool& is_sure) {
  std::optional<Event> earliest;
  is_sure = true;
  for (int i = 0; i < static_cast<int>(from.contacts.size()); ++i) {
    const ContactState& state = from.contacts[static_cast<std::size_t>(i)];
    for (const EventKind kind : watcher.kinds(i, from.contacts)) {
      Polynomial g = polynomial(watcher, i, kind, limit, from.contacts);
      if (watcher.is_level(i, kind)) g.c[1] = 0.0;
      const auto s = first_fall_in_parts(g, watcher.on_surface(i, kind));
      if (s && (!earliest || *s * limit < earliest->s)) {
        earliest = Event{*s * limit, i, kind};
        event_slope_ = g.derivative(*s) / limit;
      }
      if (s || state.in_touch() || path_error_ < tolerance_) continue;
      // a fall that the error of the path could hide
      g.c[1] -= 8.0 * path_error_;
      if (first_fall_in_parts(g, watcher.on_surface(i, kind))) is_sure = false;
    }
  }
  return earliest;
}

}  // namespace whirl::inline dyn

#include "libdyn/system/saltation.hpp"

#include <cmath>

#include "libbase/numerics/dual.hpp"

namespace whirl::inline dyn {

namespace {

/// The gap over the motion of its ports: (u, of friction) and their rates as variables 0 to 7.
ContactGap<Dual<8>> gap_of(const ReducedContact& c, const Instant& at, const Vec& y,
                           StateLayout layout) {
  const auto rate = layout.rate(y);
  const Vec2 d = c.U * layout.eta(y) - c.offset, w = c.U * rate;
  const Vec2 v = c.rubs_apart() ? Vec2(c.V * rate) : w;
  GapMotion<Dual<8>> motion;
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    motion.d[k] = Dual<8>::variable(d(i), i);
    motion.w[k] = Dual<8>::variable(w(i), 4 + i);
    motion.v[k] = Dual<8>::variable(v(i), 6 + i);
  }
  return std::visit([&](const auto& g) { return g.gap(c.space(), at, motion); }, c.geometry);
}

/// Slopes over the ports as a gradient over the state.
Vec gradient_of(const ReducedContact& c, const Dual<8>::Slopes& by, StateLayout layout) {
  const PlaneRows& V = c.rubs_apart() ? c.V : c.U;
  Vec gradient(layout.size());
  layout.eta(gradient) = c.U.transpose() * by.segment<2>(0);
  layout.rate(gradient) = c.U.transpose() * by.segment<2>(4) + V.transpose() * by.segment<2>(6);
  return gradient;
}

}  // namespace

double Saltation::log_determinant() const {
  return std::log(std::abs(1.0 + gradient.dot(jump)));
}

std::optional<Saltation> saltation(const ContactSystem& system, const Event& event,
                                   const Instant& at, const Vec& y, const ContactStates& before,
                                   const ContactStates& after) {
  if (event.kind != EventKind::touch && event.kind != EventKind::slip_stop) return std::nullopt;
  const StateLayout layout = system.layout();
  Vec a_before(layout.coordinates()), a_after(layout.coordinates());
  system.acceleration(at, y.data(), before, a_before.data());
  system.acceleration(at, y.data(), after, a_after.data());
  const Vec change = a_after - a_before;
  if (change.isZero(0.0)) return std::nullopt;

  const ReducedContact& contact = system.contacts()[static_cast<std::size_t>(event.contact)];
  const ContactGap<Dual<8>> gap = gap_of(contact, at, y, layout);
  const bool touches = event.kind == EventKind::touch;
  Saltation s;
  s.gradient = gradient_of(contact, touches ? gap.depth.slopes : gap.slip.slopes, layout);
  Vec f(layout.size());
  layout.eta(f) = layout.rate(y);
  layout.rate(f) = a_before;
  // a place that turns moves by itself, too; its friction does not switch
  const double rate = contact.turns() ? gap.rate.value : s.gradient.dot(f);
  if (rate == 0.0) return std::nullopt;  // a graze to the last digit: no side to come from
  s.jump = Vec::Zero(layout.size());
  layout.rate(s.jump) = change / rate;
  return s;
}

}  // namespace whirl::inline dyn

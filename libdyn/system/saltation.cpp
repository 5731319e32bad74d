#include "libdyn/system/saltation.hpp"

#include <cassert>
#include <cmath>

namespace whirl {

double Saltation::log_determinant() const {
  return std::log(std::abs(1.0 + gradient.dot(jump)));
}

std::optional<Saltation> saltation(const ContactSystem& system, const Event& event, double phase,
                                   const Vec& y, const ContactStates& before,
                                   const ContactStates& after) {
  if (event.kind != EventKind::touch && event.kind != EventKind::slip_stop) return std::nullopt;
  const auto n = system.coordinates();
  Vec a_before(n), a_after(n);
  system.acceleration(phase, y.data(), before, a_before.data());
  system.acceleration(phase, y.data(), after, a_after.data());
  const Vec change = a_after - a_before;
  if (change.isZero(0.0)) return std::nullopt;

  const ReducedContact& contact = system.contacts()[static_cast<std::size_t>(event.contact)];
  assert(!contact.is_face() && !contact.is_blade());
  const Vec2 d = contact.U * y.head(n) - contact.offset, d_rate = contact.U * y.tail(n);
  const double r = d.norm();
  const Vec2 normal = d / r, t(-normal(1), normal(0));
  Saltation s;
  s.gradient = Vec::Zero(2 * n);
  if (event.kind == EventKind::touch) {  // g = r - clearance
    s.gradient.head(n) = contact.U.transpose() * normal;
  } else {  // g = v_t = Omega R + (d x d') / r
    const double turn = t.dot(d_rate);
    s.gradient.tail(n) = contact.U.transpose() * t;
    s.gradient.head(n) =
        contact.U.transpose() * (Vec2(d_rate(1), -d_rate(0)) / r - turn / r * normal);
  }
  Vec f(2 * n);
  f << y.tail(n), a_before;
  const double rate = s.gradient.dot(f);
  if (rate == 0.0) return std::nullopt;  // a graze to the last digit: no side to come from
  s.jump = Vec::Zero(2 * n);
  s.jump.tail(n) = change / rate;
  return s;
}

}  // namespace whirl

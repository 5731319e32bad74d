#pragma once
/// What a contact law states.
///
/// A law is a struct template over its number type with
///
///   static constexpr std::string_view name;      the word in the model file
///   static constexpr auto fields();              its keys (libbase/structs/field.hpp)
///   auto normal(d, d_rate) const;                normal force [N] at depth d [m], its rate [m/s]
///   bool is_continuous() const;                  normal(0, d_rate) = 0 for every rate
///   static constexpr bool is_analytic;           `normal` has a Taylor series at d = 0
///
/// of one that has none, where its steepness there asks for another one than 1e-8,
///
///   static constexpr double least_depth;         over the clearance, from which it is expanded
///
/// of one whose damping is a factor of its force, N(d, d') = N(d, 0) f(d'),
///
///   bool has_rate_factor() const;                whether that is another number than one
///   auto rate_factor(d_rate) const;              f; beyond the surface N would pull where f < 0
///
/// and, of a geometry that no other law is for,
///
///   auto own_geometry() const;                   a member of libcontact/geometries.hpp
///
/// `normal` is the smooth force of the law while in touch, and its smooth continuation a little
/// beyond (trial steps of integrators end there). It does not branch, allocate or remember:
/// touching, parting, sliding and sticking are decided by the engine, from events.

#include <cmath>
#include <complex>

/// Laws are inlined everywhere, so that one source serves every number type and instruction set.
#define WHIRL_INLINE [[gnu::always_inline]] inline

namespace whirl::inline contact {

/// Square root of a depth; zero a little beyond the surface.
WHIRL_INLINE double depth_root(double d) {
  return d > 0.0 ? std::sqrt(d) : 0.0;
}
template <class T>
WHIRL_INLINE auto depth_root(const T& d) {
  using std::sqrt;
  return sqrt(d);
}

/// Ninth root of a depth; zero a little beyond the surface.
WHIRL_INLINE double depth_ninth_root(double d) {
  return d > 0.0 ? std::pow(d, 1.0 / 9.0) : 0.0;
}
inline std::complex<double> depth_ninth_root(const std::complex<double>& d) {
  return std::pow(d, 1.0 / 9.0);
}
template <class T>
WHIRL_INLINE auto depth_ninth_root(const T& d) {
  return ninth_root(d);
}

}  // namespace whirl::inline contact

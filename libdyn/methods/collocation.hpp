#pragma once

#include <string_view>

#include "libdyn/system/abilities.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Exact linear motion with collocation of the contact forces, for stiff and overdamped modes.
///
///   y(t + h) = e^(A h) y(t) + loads - integral of e^(A (h - r)) B f(r) dr
///
/// The forces f of the contacts in touch are polynomials of degree 7 on a step that meet the
/// contact laws at 8 Gauss points; everything else is exact. The length of steps follows the
/// forces, not the fastest mode. Without contact nothing but the search for the next touch limits
/// steps, and the rest of a run is one step where no contact can happen any more.
///
/// Order 16 between events, 9 over events, which cut steps short.
///
/// @source ../../docs/methods.md, "Collocation"
struct Collocation {
  static constexpr std::string_view name = "collocation";
  /// Its polynomials are forces of rings and stops.
  static constexpr std::array cannot{Need::other_orders, Need::own_frequencies, Need::films,
                                     Need::blades,       Need::faces,           Need::saturation};
  static constexpr Abilities abilities{"method collocation", cannot, "take the method taylor"};

  /// Integrates over whole revolutions from where the state is; see Dop853::integrate. Dense output
  /// is made for an observer only.
  /// @throws ModelError  for a system that it cannot compute
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

/// Whether collocation can compute a system whose fastest mode is so much faster than the contacts
/// (|lambda| > 10 w_c) that the steps of Taylor series are limited by it, and collocation is the
/// cheaper method.
///
/// @source ../../docs/methods.md, "Collocation": measured
bool prefers_collocation(const ContactSystem& system);

}  // namespace whirl::inline dyn

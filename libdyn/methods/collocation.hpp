#pragma once

#include <string_view>

#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Exact linear motion with collocation of the contact forces, for stiff and overdamped modes.
///
///   y(t + h) = e^(A h) y(t) + loads - integral of e^(A (h - r)) B f(r) dr
///
/// The forces f of the contacts in touch are polynomials of degree 7 on a step that meet the
/// contact laws at 8 Gauss points; everything else is exact. Steps are as long as the forces, not
/// as the fastest mode, asks for; without contact they are limited by nothing but the search for
/// the next touch, and the rest of a run that can touch nothing any more is one step.
///
/// Order 16 between events, 9 over events, which cut steps short.
///
/// @source ../../docs/methods.md, "Collocation"
struct Collocation {
  static constexpr std::string_view name = "collocation";

  /// Integrates over whole revolutions from where the state is; see Dop853::integrate. Only with an
  /// observer is dense output made.
  /// @throws ModelError  for other systems than suits_collocation says
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

/// Whether all contacts are of rings and there are no oil films: other forces are not among its
/// polynomials.
bool suits_collocation(const ContactSystem& system);

/// Whether the fastest mode is so much faster than the contacts (|lambda| > 10 w_c) that the
/// steps of Taylor series are limited by it, and collocation is the cheaper method.
///
/// @source ../../docs/methods.md, "Collocation": measured
bool prefers_collocation(const ContactSystem& system);

}  // namespace whirl::inline dyn

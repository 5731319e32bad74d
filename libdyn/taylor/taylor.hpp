#pragma once

#include <string_view>

#include "libdyn/system/abilities.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Taylor series of order 8 to 20 with exact events; one trajectory of the batch engine.
///
/// The order follows from the tolerance, the step from the last two terms; events are found on the
/// polynomial of the step itself, so no step is made again.
///
/// @source [JorbaZou2005] for order and step; docs/methods.md, "Taylor series" for contacts
struct Taylor {
  static constexpr std::string_view name = "taylor";
  static constexpr Abilities abilities{"method taylor"};

  int order = 0;  ///< 8 to 20; 0: by the tolerance

  /// See Dop853::integrate.
  Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                        const IntegrationOptions& options, const Observer& observer) const;
};

}  // namespace whirl::inline dyn

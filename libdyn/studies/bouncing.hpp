#pragma once
/// Search for bouncing motions near an internal resonance.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libfe/analyses/resonance.hpp"

namespace whirl::inline dyn {

struct BouncingOptions {
  int starts = 16;         ///< at a speed
  long transient = 300;    ///< revolutions before a motion is looked at
  double most = 0.08;      ///< of the resonance's speed, up to which speeds above it are tried
  double step = 0.005;     ///< likewise, between them
  std::uint64_t seed = 1;  ///< of amplitudes and phases
  /// Asked often; true: nothing more is found. May be empty.
  std::function<bool()> is_stopped{};
};

/// A motion that closes seen from the rotor, with two lines above all others.
struct Bouncing {
  double speed = 0.0;  ///< [rad/s]
  double turns = 0.0;  ///< its period [revolutions]
  AutonomousOrbit cycle;
  std::array<int, 2> lines{};  ///< their orders of 2 pi / period, the higher first

  bool is_stable() const { return cycle.is_stable(); }

  static constexpr auto columns() {
    return ColumnList{column("speed", &Bouncing::speed, "rad/s", "where it was found"),
                      column("period_revs", &Bouncing::turns, "", "period [revolutions]"),
                      column("stable", &Bouncing::is_stable, "", "whether it attracts")};
  }
};

/// The two strongest lines of what a contact's station does over a closed motion, seen from the
/// rotor, as orders of 2 pi / period, the higher first.
std::array<int, 2> strongest_lines(const Scene& scene, const AutonomousFlow& flow,
                                   const AutonomousOrbit& cycle);

/// Looks for motions of a scene with intermittent contact in which the two modes of a resonance are
/// locked: starts are sums of both with 0.2 to 2 clearances each where it touches first.
///
/// @param scene_at  at a speed [rad/s]
/// @param diagram   that the resonance is of
/// @return  that of the lowest speed, the first stable one there; nothing if there is none, or if
///          it was stopped before
/// @throws NumericalError  as rotating_flow
std::optional<Bouncing> find_bouncing(
    const std::function<std::shared_ptr<const Scene>(double speed)>& scene_at,
    const Campbell& diagram, const InternalResonance& resonance, const BouncingOptions& options);

}  // namespace whirl::inline dyn

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
  double most = 0.08;      ///< share of the resonance's speed, up to which speeds above are tried
  double step = 0.005;     ///< share of the resonance's speed between the speeds that are tried
  std::uint64_t seed = 1;  ///< of amplitudes and phases
  /// Asked often; true: the search ends. May be empty.
  std::function<bool()> is_stopped{};
};

/// A motion that closes as seen from the rotor, with two spectral lines above all others.
struct Bouncing {
  double speed = 0.0;  ///< [rad/s]
  double turns = 0.0;  ///< its period [revolutions]
  AutonomousOrbit cycle;
  std::array<int, 2> lines{};  ///< orders of these lines, of 2 pi / period, the higher first

  bool is_stable() const { return cycle.is_stable(); }

  static constexpr auto columns() {
    return ColumnList{column("speed", &Bouncing::speed, "rad/s", "where it was found"),
                      column("period_revs", &Bouncing::turns, "", "period [revolutions]"),
                      column("stable", &Bouncing::is_stable, "", "whether it attracts")};
  }
};

/// The two strongest spectral lines of a closed motion at the station of the first contact, seen
/// from the rotor, as orders of 2 pi / period, the higher first.
std::array<int, 2> strongest_lines(const Scene& scene, const AutonomousFlow& flow,
                                   const AutonomousOrbit& cycle);

/// Looks for motions of a scene with intermittent contact in which the two modes of a resonance are
/// locked: starts are sums of both modes, each with 0.2 to 2 clearances where it touches first.
///
/// @param scene_at  at a speed [rad/s]
/// @param diagram   Campbell diagram of the resonance
/// @return  the motion at the lowest speed that has one, the first stable one if there is any;
///          nothing if there is none, or if the search was stopped
/// @throws NumericalError  as rotating_flow
std::optional<Bouncing> find_bouncing(
    const std::function<std::shared_ptr<const Scene>(double speed)>& scene_at,
    const Campbell& diagram, const InternalResonance& resonance, const BouncingOptions& options);

}  // namespace whirl::inline dyn

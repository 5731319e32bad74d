#pragma once
/// Periodic orbits near random starts, unstable ones too.

#include <cstdint>
#include <vector>

#include "libdyn/orbits/shooting.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

struct OrbitSearchOptions {
  int period = 1;          ///< of the orbits [revolutions]
  long starts = 1;         ///< that are tried
  long discard = 10;       ///< revolutions that bring a start near something
  double size = 0.5;       ///< how far starts are away: see random_start
  std::uint64_t seed = 1;  ///< of the starts
};

/// An orbit, and how many starts led there.
struct SearchedOrbit {
  PeriodicOrbit orbit{};
  int shortest_period = 1;  ///< [revolutions]
  long starts = 1;
};

struct OrbitSearch {
  std::vector<SearchedOrbit> orbits{};  ///< stable ones first, then those that most starts led to
  long done = 0;                        ///< starts
  long failed = 0;                      ///< of these, that led to no orbit
};

/// Newton's method from random starts, each after some revolutions. Orbits are the same where their
/// states are, begun at any revolution of their period.
/// @param around   what the starts are near
/// @param monitor  told the starts; nothing is saved
OrbitSearch search_orbits(const Scene& scene, const MotionState& around,
                          const OrbitSearchOptions& options, const Monitor<OrbitSearch>& monitor);

}  // namespace whirl::inline dyn

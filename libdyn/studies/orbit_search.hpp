#pragma once
/// Periodic orbits near random starts, unstable ones too.

#include <cstdint>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

struct OrbitSearchOptions {
  int period = 1;          ///< of the orbits [revolutions]
  long starts = 1;         ///< that are tried
  long discard = 10;       ///< revolutions from a start to where Newton's method begins
  double size = 0.5;       ///< how far starts are away: see random_start
  std::uint64_t seed = 1;  ///< of the starts
  int threads = 1;         ///< of this process that do the work; 0: the calling one
};

/// An orbit, and how many starts led there.
struct SearchedOrbit {
  PeriodicOrbit orbit{};    ///< without its tangents
  int shortest_period = 1;  ///< [revolutions]
  long starts = 1;
  std::vector<OrbitProbe> probes{};  ///< of the model

  bool is_stable() const { return orbit.is_stable(); }
  double impacts() const;  ///< of all contacts in the period of the search
  std::vector<ContactShare> contact_shares() const;

  static constexpr auto columns() {
    using S = SearchedOrbit;
    return ColumnList{column("stable", &S::is_stable, "", "whether it attracts"),
                      column("period_revs", &S::shortest_period, "", "revolutions"),
                      column("starts", &S::starts, "", "that led there"),
                      column(
                          "floquet", [](const S& s) -> const CVec& { return s.orbit.multipliers; },
                          "", "multipliers of the period, the largest first"),
                      column(
                          "state", [](const S& s) -> const Vec& { return s.orbit.states[0]; }, "",
                          "reduced, at phase 0"),
                      rows(&S::contact_shares, "contacts"),
                      rows(&S::probes, "probes").only(Written::in_json).maybe()};
  }
};

struct OrbitSearch {
  std::vector<SearchedOrbit> orbits{};  ///< stable ones first, then those that most starts led to
  long done = 0;                        ///< starts
  long failed = 0;                      ///< of these, that led to no orbit

  static constexpr auto columns() {
    using S = OrbitSearch;
    return ColumnList{column("starts", &S::done, "", "that were tried"),
                      column("without_orbit", &S::failed, "", "of these, that led to none"),
                      rows(&S::orbits, "orbits")};
  }
};

/// Newton's method from random starts, each after some revolutions. Orbits are the same where their
/// states are, begun at any revolution of their period. Threads and processes share the starts;
/// what is found does not depend on threads and processes: a search that is stopped has what all of
/// its first starts lead to.
/// @param around   state that the starts are near
/// @param monitor  told the starts that are done; nothing is saved
OrbitSearch search_orbits(const Scene& scene, const MotionState& around,
                          const OrbitSearchOptions& options, const Monitor<OrbitSearch>& monitor);

}  // namespace whirl::inline dyn

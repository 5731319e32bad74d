#pragma once
/// What orbit and continue share.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "libdyn/orbits/multiplier_modes.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/scene.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl {

/// Where orbits are to be closed, as seen from there: --frame.
/// @throws ModelError  for other frames than the stationary and the rotating one
OrbitFrame orbit_frame(const Invocation& call);

/// The motion after --discard revolutions from the model's start, or from --from (there left out: 0),
/// at phase 0; its outcome says whether it got there.
Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene);

/// That of --method; --harmonics and --verify, if given, must go with it.
/// @throws ModelError  for an unknown one, or for options of the other
OrbitMethod orbit_method(const Invocation& call);

/// --harmonics; 0: left out.
/// @throws ModelError  if the speed itself, harmonic number `period`, is not among them
int harmonics_of(const Invocation& call, int period);

/// What a verb says of an orbit, however it was found.
struct FoundOrbit {
  int period = 1, shortest_period = 1;  ///< [revolutions]
  double residual = 0.0;                ///< NaN: none was computed [length scales]
  long steps = 0;                       ///< of Newton's method
  std::vector<Vec> states;              ///< at the starts of revolutions
  CVec multipliers, exponents;
  std::vector<MultiplierMode> modes;  ///< of the multipliers; empty: not told
  bool is_stable = false;
  std::vector<ContactMeasure> contacts;
  std::string failure;                       ///< empty: it is an orbit
  std::optional<Record> more;                ///< entries of harmonic balance
  std::string summary;                       ///< of the method, lines for people
  std::function<void(ResultWriter&)> write;  ///< datasets of the method; may be empty

  bool is_good() const { return failure.empty(); }
};

/// Harmonic balance from a state at phase 0, with stability by Hill's method; against shooting with
/// --verify.
FoundOrbit find_by_harmonic_balance(const Invocation& call, const Scene& scene, const Vec& start,
                                    int period);

/// Orbits near random starts: --starts.
Report search_orbits(const Invocation& call, const Model& model);

}  // namespace whirl

#pragma once
/// Coexisting motions: which starts end in the same one.

#include <cstdint>
#include <span>
#include <vector>

#include "libdyn/studies/classify.hpp"

namespace whirl {

/// What is known of a motion that a start ended in.
struct Ending {
  MotionKind kind = MotionKind::periodic;
  int period = 0;
  bool is_proven = false;
  std::vector<Regime> regimes;       ///< of the contacts
  std::span<const double> sections;  ///< states at phase 0, the last ones; NaN beyond them
};

/// Numbers motions that are the same, from 0 in the order of their first appearance.
///
/// Proven orbits are the same where their sections are, to 1e-5 length scales; others are told
/// apart by their kind, their period and the regimes of the contacts only: two chaotic attractors
/// with the same regimes count as one.
std::vector<int> attractors(const ContactSystem& system, std::span<const Ending> endings);

/// A start near another one: every coordinate moved by -size to size length scales, every velocity
/// by as much times the rate of the phase; drawn again where a journal would be outside its oil film.
/// The same numbers give the same start on every machine.
MotionState random_start(const ContactSystem& system, const MotionState& around, double size,
                         std::uint64_t seed, std::uint64_t number);

}  // namespace whirl

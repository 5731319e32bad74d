#pragma once
/// Branches of orbits and of circles whose file holds at every moment what is done.

#include <functional>
#include <optional>

#include "libdyn/system/trajectory.hpp"
#include "libio/model/branch_setup.hpp"
#include "libio/results/kept_study.hpp"

namespace whirl::inline io {

/// Gives a motion near what is to be followed, asked if the file has nothing of that yet; nothing:
/// stop.
using Settled = std::function<std::optional<MotionState>()>;

/// Branches that were followed.
struct KeptBranches {
  BranchStudy found{};
  long resumed = 0;  ///< points that were there already
};
/// @throws FileError       as StudyFile
/// @throws NumericalError  if there is no first orbit
KeptBranches keep_branches(const BranchSetup& asked, const StudyKeeping& keeping,
                           const Settled& settled);

/// A circle, and the circles along its parameter.
struct KeptTorus {
  TorusBranch torus{};
  long resumed = 0;  ///< circles that were there already
};
/// @throws FileError  as StudyFile
KeptTorus keep_torus(const TorusSetup& asked, const StudyKeeping& keeping, const Settled& settled);

}  // namespace whirl::inline io

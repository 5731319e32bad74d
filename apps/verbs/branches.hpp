#pragma once
/// Branches of a continuation in a result file.

#include <string>
#include <vector>

#include "libdyn/branches/continuation.hpp"
#include "libdyn/orbits/orbit_measure.hpp"

namespace whirl {

class Record;
class ResultReader;
class ResultWriter;

/// A branch among those of a study.
struct TracedBranch {
  Branch branch;
  int parent = 0;      ///< number of the branch that it begins on, from 1; 0: none
  int generation = 0;  ///< how many branches it is away from the first
  double direction = 1.0;
  std::vector<OrbitMeasure> measures;  ///< per point
  std::vector<Vec> starts;  ///< per point, state at phase 0, in the basis of the first value
  BifurcationKind kind{};   ///< of a border: of which bifurcation
  std::string contact;      ///< likewise: which grazes
};

/// What all branches of a study have in common.
struct BranchLayout {
  Eigen::Index states = 0;            ///< of a revolution, reduced
  Vec scale;                          ///< of the states
  int harmonics = 0;                  ///< of harmonic balance; 0: shooting
  std::vector<std::string> contacts;  ///< names
  std::vector<std::string> stations;  ///< likewise
  std::string path, unit;             ///< of the parameter
  bool is_rotating = false;           ///< closed as seen from the rotor, after any period

  /// Of a point of a branch [revolutions].
  double period(const Branch& branch, const BranchPoint& point) const {
    return is_rotating ? point.z(states) : branch.period;
  }
};

/// Group /branch: all points and bifurcations, and what the walk goes on from.
void write_branches(ResultWriter& file, const BranchLayout& layout,
                    const std::vector<TracedBranch>& branches, bool is_complete);

/// Harmonics of the branches in a file; 0: of shooting.
int harmonics_in(const ResultReader& file);

/// The same branches again, bit by bit.
/// @throws FileError  if the file holds something else
std::vector<TracedBranch> read_branches(const ResultReader& file, const BranchLayout& layout);

/// The second parameter of borders, and what the unknown of the first one means.
struct BorderAxes {
  std::string path, unit;
  double low = 0.0, high = 1.0;  ///< range of the first parameter

  double first_value(const BranchPoint& p) const {
    return low + p.z(p.z.size() - 2) * (high - low);
  }
};

/// Group /border: curves of bifurcations along a second parameter.
/// @param layout  of the branch that they begin on
void write_borders(ResultWriter& file, const BranchLayout& layout, const BorderAxes& axes,
                   const std::vector<TracedBranch>& borders, bool is_complete);

/// The same borders again, bit by bit; none where there are none.
/// @throws FileError  if the file holds something else
std::vector<TracedBranch> read_borders(const ResultReader& file, const BranchLayout& layout);

/// The bifurcations of all branches, for --json.
Record bifurcations_record(const std::vector<TracedBranch>& branches);

}  // namespace whirl

#pragma once
/// Motion of stations in their plane, from what the probes there read.

#include <string>
#include <vector>

#include "libbase/linalg.hpp"
#include "libfe/assemble.hpp"
#include "libfe/structure.hpp"

namespace whirl::inline dyn {

/// The probes of one station, and what takes their readings to its displacement.
struct ProbedStation {
  Point point;
  std::string name;         ///< names of its probes, joined by " + "
  std::vector<int> probes;  ///< numbers from 0
  /// (x, y) = to_plane * readings, the least squares of more than two. Of probes along one line it is
  /// the motion along that.
  Mat to_plane;
  bool is_planar = false;  ///< whether the probes see one direction only
};

/// Stations of probes, in the order of their first probes.
/// @throws ModelError  for a probe at a station that there is not
std::vector<ProbedStation> probed_stations(const std::vector<Probe>& probes,
                                           const Assembler& assembler);

}  // namespace whirl::inline dyn

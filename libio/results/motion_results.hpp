#pragma once
/// Rest, critical speeds, motions and where they end, to a result file and back.

#include <optional>
#include <string>

#include "libdyn/linear/static_study.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libfe/analyses/critical.hpp"

namespace whirl::inline io {

class ResultWriter;

/// Groups of a rotor at rest: what its bearings and films carry, and how its shaft bends.
void write_rest(ResultWriter& file, const StaticStudy& study);

/// Groups /critical and /critical_map. The map is solved here, as only files show it; a map that
/// cannot be solved is left out, and whoever draws it tells why.
/// @param structure  that the speeds were found of
void write_criticals(ResultWriter& file, const Structure& structure, const CriticalSpeeds& found);

/// Group /points: nodes and bodies with their positions and names.
void write_points(ResultWriter& file, const Model& model, const Assembler& assembler);

/// Speed, group /points, and in group /trajectory where a motion ended, for others to go on.
void write_end(ResultWriter& file, const Model& model, const Scene& scene, const MotionState& end);
/// The same of a reduced state at phase 0, on an orbit for instance.
void write_end(ResultWriter& file, const Model& model, const Scene& scene, const Vec& state);

/// Groups /trajectory and /contacts, and /spectra of the stations.
void write_run(ResultWriter& file, const Run& run, const Model& model);

/// The run of a result, with all that was recorded of it; how long it took is not known.
struct StoredRun {
  Run run;
  MotionEnd end;  ///< of the motion; run.simulation.end is not set
};
/// @param model     whose motion it is
/// @param stations  as RunOptions has them, and the method
/// @throws FileError   if the file cannot be read
/// @throws ModelError  if it holds no motion, or that of another rotor
StoredRun stored_run(const std::string& path, const Model& model, const std::string& stations,
                     const std::string& method);
/// Writes the same groups of a stored run.
void write_run(ResultWriter& file, const StoredRun& stored, const Model& model);

/// Groups /campbell and /resonances; the first motion that bounces is the end of the result, so
/// that other motions can begin there.
void write_resonances(ResultWriter& file, const Model& model, const Assembler& assembler,
                      const ResonanceStudy& study);

/// Where the motion of a result ended.
/// @throws FileError, ModelError  if the file holds no such end
EarlierEnd earlier_end(const std::string& path);

/// The same if a model's [start] is such a result.
std::optional<EarlierEnd> earlier_end(const Start& start);

}  // namespace whirl::inline io

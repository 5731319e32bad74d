#pragma once
/// Planes, probes and runs of a file of balancing.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libdata/balancing/balancing.hpp"
#include "libdata/measured/probe_readings.hpp"
#include "libdyn/system/model.hpp"
#include "libio/model/config.hpp"
#include "libio/model/read_fields.hpp"

namespace whirl::inline io::balancing {

/// Planes as they are read.
struct Planes {
  std::vector<BalancingPlane> planes;
  /// A [[unbalance]] of no size at the station of each, for the model; of some there is none.
  std::vector<std::optional<ConfigNode>> stations;
};
Planes read_planes(const ConfigNode& root, const BalancingConvention& convention,
                   std::vector<Problem>& problems);

/// Probes as they are read.
struct Probes {
  std::vector<BalancingProbe> probes;
  std::optional<MeasurementSetup> setup;  ///< where they have stations
};
/// Those of the file, or if it has none those of the model.
/// @param root  of the file of balancing, or of the file of probes that it names
Probes read_probes(const ConfigNode& root, const Model& model,
                   const BalancingConvention& convention, std::vector<Problem>& problems);

/// A run as it is read.
struct Run {
  std::string name;
  double speed = 0.0;  ///< [rad/s]
  CVec weights{};      ///< with those that earlier runs left on the rotor [kg]
  CVec readings{};     ///< per probe; NaN: not read
  bool is_slow_roll = false;
};
struct Runs {
  std::vector<Run> runs;
  CVec kept;  ///< after the last run [kg]
  std::vector<std::string> notes;
};
/// @param folder   of records
/// @param accepts  whether signs of a rub in a record are notes, not problems
Runs read_runs(const ConfigNode& root, const Planes& planes, const Probes& probes,
               const BalancingConvention& convention, const std::filesystem::path& folder,
               bool accepts, std::vector<Problem>& problems);

/// An angle; a number without unit that no radian would be is reported.
std::optional<double> read_angle(TableReader& table, std::string_view key,
                                 bool is_required = false);
/// A reading's size, peak [SI]: with a unit, or a number in the unit of the probe.
std::optional<double> read_amplitude(TableReader& table, std::string_view key,
                                     const BalancingProbe& probe,
                                     const BalancingConvention& convention);

}  // namespace whirl::inline io::balancing

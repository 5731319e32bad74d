#pragma once
/// What a fit compares: measured records, the systems that could have made them, free parameters.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libdyn/system/contact_system.hpp"
#include "libdyn/system/system_slope.hpp"

namespace whirl::inline data {

/// Deviations of more than so many standard deviations are not chance.
inline constexpr double improbable = 6.0;

/// Readings of displacement probes while the rotor turned at a constant speed.
struct FitRecord {
  std::string name;    ///< for messages
  Vec times;           ///< ascending [s]
  Mat readings;        ///< probes x times [m]; NaN: missing
  Vec noise;           ///< standard deviation per probe [m]
  double phase = 0.0;  ///< of the rotor at the first time [rad]
  /// Revolutions after which the motion repeats, if the times are within one such period: a steady
  /// motion, see steady_record. 0: any motion.
  int period = 0;
  /// Whether the readings are displacements; else each probe adds a constant that is found with the
  /// parameters, as the voltage of its gap.
  bool is_offset_known = true;
  /// Orders of the speed, from 1, at which each probe adds a vector that is found with the
  /// parameters: runout. 0: none.
  int runout_orders = 0;
  std::vector<Eigen::Index> runout_of{};  ///< number of a probe's vectors, see RunoutTerms
};

/// A parameter that a fit finds.
struct FreeParameter {
  std::string path;
  std::string unit{};  ///< of its values, for people
  double start = 0.0;  ///< where the search begins
  double size = 0.0;   ///< scale of its values, > 0
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// Whether the lower bound is that of all values of this kind, and none was given for this one:
  /// the value may be far from it.
  bool is_lower_general = false;
};

/// A system at some values of the parameters, with its slopes by the parameters.
struct FitSystem {
  ContactSystem system;
  std::vector<SystemSlope> slopes;
  Vec runout{};  ///< coefficients of all probes, see RunoutTerms [m]
};

/// A record and the systems that it is compared with, all in the same n coordinates.
struct FitSource {
  FitRecord record;
  Mat rows;  ///< what the probes read of the coordinates, probes x n
  /// @param values  of the parameters, then of the runout
  /// @throws ModelError, NumericalError  for values that make no system
  std::function<FitSystem(const Vec& values)> system_at;
};

}  // namespace whirl::inline data

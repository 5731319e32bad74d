#pragma once
/// Records of a rig and a model with free values, made ready for a fit.

#include <string>
#include <vector>

#include "libdyn/fit/measured_fit.hpp"
#include "libio/measured/measurement.hpp"
#include "libio/model/free_parameters.hpp"

namespace whirl::inline io {

/// Which part of a record counts.
struct FitWindow {
  double from = 0.0;          ///< revolutions before it
  double revolutions = 20.0;  ///< at most; 0: all that there are
};

/// Reads records for a fit of a model.
///
/// @param notes  receives what is odd about them
/// @throws ModelError, FileError  for what is wrong with them, or with values of the model
std::vector<FitMeasurement> fit_measurements(const Model& model, const FreeParameters& free,
                                             const std::vector<RecordSource>& sources,
                                             const FitWindow& window,
                                             std::vector<std::string>& notes);

}  // namespace whirl::inline io

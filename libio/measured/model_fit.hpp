#pragma once
/// A model with free values, fitted to records of a rig.

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

/// Finds the free values of a model in records.
///
/// @return  with notes on the records before its own
/// @throws ModelError, FileError  for what is wrong with the records, their probes or values of the model
MeasuredFit fit_model(const Model& model, const FreeParameters& free,
                      const std::vector<SourcedRecord>& records, const FitWindow& window,
                      const MeasuredFitOptions& options);

}  // namespace whirl::inline io

#pragma once
/// A model with free values, fitted to records of a rig.

#include <vector>

#include "libdata/fit/measured_fit.hpp"
#include "libio/measured/measurement.hpp"
#include "libio/model/free_parameters.hpp"

namespace whirl::inline io {

/// Which part of a record counts.
struct FitWindow {
  double from = 0.0;          ///< revolutions of the record before the window
  double revolutions = 20.0;  ///< at most; 0: all that there are
};

/// A motion that was found.
struct FittedMotion {
  std::string record;  ///< name of the file of its record
  Model model;         ///< with the values that were found
  Scene scene;         ///< of the model
  MotionState start;   ///< at the first time that counts
};

struct ModelFit {
  MeasuredFit found;
  std::vector<FittedMotion> motions;  ///< a record each
};

/// Finds the free values of a model in records.
///
/// @return  with notes on the records before those of the fit
/// @throws ModelError, FileError  for what is wrong with the records, their probes or values of the
///                     model
ModelFit fit_model(const Model& model, const FreeParameters& free,
                   const std::vector<SourcedRecord>& records, const FitWindow& window,
                   const MeasuredFitOptions& options);

}  // namespace whirl::inline io

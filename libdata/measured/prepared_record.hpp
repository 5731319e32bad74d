#pragma once

#include "libdata/measured/running_modes.hpp"

namespace whirl::inline data {

/// Samples that modes are sought in.
struct PreparedRecord {
  Mat samples;                   ///< times x channels, each of mean zero and variance one
  double spacing = 0.0;          ///< time between them [s]
  Eigen::RowVectorXd deviation;  ///< standard deviation that a channel was divided by, in its unit
};

/// Looks at a record, takes harmonics of the speed out of it if that is asked for, and thins it
/// out.
///
/// @param found  has its channels; receives the speed and what was done about its harmonics
/// @throws ModelError, OptionError  as running_modes
PreparedRecord prepared(const Mat& samples, double spacing, const RunningModesOptions& options,
                        RunningModes& found);

}  // namespace whirl::inline data

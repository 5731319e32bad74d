#pragma once

#include <string>
#include <vector>

#include "libdyn/studies/work_precision_study.hpp"
#include "libdyn/system/model.hpp"
#include "libio/drawing/figure.hpp"

namespace whirl::inline io {

/// What a study of integrators has measured, for its figure. Errors and times stand method after
/// method, those of each method in the order of the tolerances.
struct WorkPrecision {
  std::string title, subtitle;
  std::vector<std::string> methods;
  std::vector<double> tolerances;
  std::vector<double> error, time;  ///< [-], [s]; NaN where a run failed
  double revolutions = 0.0;
  double reference_error = 0.0;
  std::string unit;  ///< of errors: "clearances"
};

/// What a study of a model has measured.
WorkPrecision work_precision_of(const WorkPrecisionStudy& study, const Model& model);

/// Time over error of every method, both logarithmic, its name at the end of its line.
Figure work_precision_figure(const WorkPrecision& data);

/// "tolerances from 1e-4 to 1e-12"
std::string tolerance_range(const std::vector<double>& tolerances);

}  // namespace whirl::inline io

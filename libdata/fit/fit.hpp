#pragma once
/// Parameters of a model that explain measured motions, and how sure they are.

#include <functional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdata/fit/fit_problem.hpp"

namespace whirl::inline data {

struct FitOptions {
  double window = 0.0;         ///< of multiple shooting [s]; 0: a revolution
  int most_iterations = 300;   ///< of the last stage, in which windows join
  bool is_noise_known = true;  ///< else its size follows from the residuals
  /// Asked before every window of a record; true: the fit ends as it is, without the errors of its
  /// parameters. May be empty.
  std::function<bool()> is_stopped{};
  std::function<void(long done, long total)> progress{};
};

struct FittedParameter {
  std::string path;
  std::string unit;    ///< of its values
  double start = 0.0;  ///< where the search began
  double value = 0.0;
  double standard_deviation = 0.0;  ///< infinite: records do not determine it; NaN: at a bound
  double lower = 0.0, upper = 0.0;  ///< ends of the interval of 95 %
  /// Whether half the interval is narrower than the value; else the records hardly determine the
  /// value.
  bool is_told = false;
  bool is_at_bound = false;

  static constexpr auto columns() {
    using P = FittedParameter;
    return ColumnList{
        column("path", &P::path, "", "of the value in the model").axis(),
        column("value", &P::value, "", "that explains the records, in its SI unit"),
        column("standard_deviation", &P::standard_deviation, "",
               "of the value; infinite: the records cannot tell it; NaN: its bound holds it"),
        column("unit", &P::unit, "", "SI unit of the value"),
        column("start", &P::start, "", "where the search began"),
        column("lower", &P::lower, "", "lower end of the interval of 95 %"),
        column("upper", &P::upper, "", "upper end of the interval of 95 %"),
        column("told", &P::is_told, "", "1: half the interval is narrower than the value"),
        column("at_bound", &P::is_at_bound, "", "1: a bound holds it")};
  }
};

/// What a fit leaves unexplained of a record.
struct FitResidual {
  std::string record;
  Vec of_probe;          ///< root mean square of reading less measurement, per probe [m]
  MotionState start;     ///< of the motion that was found, at the first time
  Mat predicted;         ///< probes x times, offsets included [m]
  Vec offset;            ///< that was found, per probe; zero where it was known [m]
  Vec offset_deviation;  ///< its standard deviation, likewise [m]
};

struct Fit {
  /// Whether the search has ended and, if the noise is known, the residuals are no larger than
  /// noise.
  bool has_converged = false;
  std::string why_not;  ///< why the fit has not converged; else empty
  std::vector<FittedParameter> parameters;
  Mat correlation;  ///< of their errors
  /// Largest standard deviation of a parameter over the least that an estimate without bias can
  /// have (Cramer and Rao); above 1 where gaps between windows are left and count as residuals.
  double over_least_deviation = 1.0;
  double residual =
      0.0;  ///< root mean square of all residuals over their noise: 1 where the model explains all
  double log_likelihood = 0.0;  ///< of the records, Gaussian noise
  long readings = 0;
  long windows = 0;
  int iterations = 0;
  long grazes = 0;  ///< of the motions that were found, where derivatives are one-sided
  std::vector<FitResidual> records;
};

/// Finds parameters by multiple shooting: least squares over the parameters and the state at the
/// start of each window, with exact derivatives through touches, releases and slip.
///
/// Gaps between windows are weighted more and more, until the errors of the parameters are those of
/// maximum likelihood to 1 %: in the end the motions in the windows of a record are one motion.
/// Where no search gets that far, as in long records of chaos, standard deviations are those of the
/// search as it has ended, gaps included (over_least_deviation).
///
/// @throws ModelError  for records without readings, parameters without a size or outside their
///                     bounds
/// @source [Bock1983]; covariance as [Seber2003], sec. 2.1
Fit fit(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& parameters,
        const FitOptions& options = {});

}  // namespace whirl::inline data

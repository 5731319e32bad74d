#pragma once
/// How far the errors of a fit go beyond those of white noise.

#include "libdata/fit/fit.hpp"
#include "libdata/fit/fit_problem.hpp"

namespace whirl::inline data {

/// How many successive samples count as one, since their errors hang together: the integrated
/// autocorrelation time, by sums of two successive correlations up to the first that is not
/// positive. About 1 of white noise; NaN among the samples counts as zero.
/// @source [Geyer1992]
double correlation_time(const Vec& samples);

/// The same of what fits leave of all probes, by their shares of the sum of squares.
double correlation_time(const std::vector<FitSource>& sources, const Fit& fit);

/// Makes all standard deviations and intervals larger.
void widen(Fit& fit, double factor);

}  // namespace whirl::inline data

#pragma once
/// How sure correction weights and predicted vibrations are.

#include <optional>
#include <vector>

#include "libdata/balancing/influence.hpp"

namespace whirl::inline data {

/// Variances of readings, E|error|^2 of complex ones, and how many runs they are known from.
struct ReadingVariance {
  Vec variance;  ///< per reading
  /// Spare runs that the least known of them is from; nothing: they were given.
  std::optional<Eigen::Index> spare;
};

/// Variances by what runs differ from their lines, those of all speeds of a probe together.
///
/// @param probe  number of the probe of every line, from 0
/// @param given  radius per probe that holds 95 % of its readings; 0: it is not known. Of a probe
///               with spare runs the larger of both counts.
/// @return       nothing if there is a probe without spare runs and without a given radius
std::optional<ReadingVariance> reading_variance(const std::vector<InfluenceLine>& lines,
                                                const std::vector<std::size_t>& probe,
                                                const Vec& given);

/// Radius about a complex estimate that holds 95 % of what it may be, over the root of its
/// variance: sqrt(ln 20) of a known variance, sqrt(n (20^(1/n) - 1)) of one from n spare runs, as
/// twice the ratio of two sums of squares of 2 and 2 n normal numbers has the distribution F(2,
/// 2n).
double radius_of_95_percent(std::optional<Eigen::Index> spare);

struct BalancingConfidence {
  Vec weights;   ///< radius about each weight that holds 95 % [kg]
  Vec readings;  ///< radius about each predicted reading that holds 95 % of what a run will read
};

/// Carries the variances on to weights and predictions, to first order:
///
///   dw = -(A^H D A)^-1 (A^H D dr + dA^H D r),   dr = x^T (dV_0, dA),   x = (1, w)
///
/// @param weight  of the readings: D = diag(weight^2)
/// @param w       all weights on the rotor, correction and kept ones [kg]
/// @source [Seber2003], sec. 2.1
BalancingConfidence confidence_of(const std::vector<InfluenceLine>& lines,
                                  const ReadingVariance& readings, const Vec& weight,
                                  const CVec& w);

}  // namespace whirl::inline data

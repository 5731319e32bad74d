#pragma once
/// Runout as a fit finds it: what a probe reads of a shaft that does not move, a vector per order
/// of the speed.

#include <string>
#include <vector>

#include "libdata/fit/fit_problem.hpp"
#include "libdyn/system/probes.hpp"

namespace whirl::inline data {

/// A vector of runout that was found. The reading has amplitude cos(order angle + phase) beside the
/// displacement, at the angle of the rotor.
struct FittedRunout {
  std::string probe;
  int order = 0;
  double amplitude = 0.0;           ///< [m]
  double phase = 0.0;               ///< [rad]
  double standard_deviation = 0.0;  ///< of either part of the vector [m]

  static constexpr auto columns() {
    using R = FittedRunout;
    return ColumnList{
        column("probe", &R::probe, "", "a probe, once per order").axis(),
        column("order", &R::order, "", "of the speed"),
        column("amplitude", &R::amplitude, "m", "of what it reads of a shaft that rests"),
        column("phase", &R::phase, "rad",
               "readings have amplitude cos(order angle of the rotor + phase)"),
        column("standard_deviation", &R::standard_deviation, "m", "of either part of the vector")};
  }
};

/// The vectors that are found: those of a probe are the same in all records.
class RunoutTerms {
 public:
  /// @param orders  of the speed, from 1; 0: no runout is found
  explicit RunoutTerms(int orders) : orders_(orders) {}

  /// Tells a record where the vectors of its probes are.
  void assign(const std::vector<Probe>& probes, FitRecord& record);

  /// The parts of all vectors, cosine and sine by order by probe, as parameters behind those of the
  /// model.
  /// @param size  scale of their values [m]
  std::vector<FreeParameter> parameters(double size) const;

  /// Vectors of parameters that were found, in the order of parameters().
  std::vector<FittedRunout> vectors(const Vec& values, const Vec& deviations) const;

 private:
  int orders_;
  std::vector<std::string> probes_{};
};

/// What a probe reads of runout at an angle of the rotor [m].
/// @param runout  coefficients of all probes, as RunoutTerms has them [m]
double runout_at(const FitRecord& record, const Vec& runout, Eigen::Index probe, double angle);

/// Derivatives of runout_at by the coefficients of a probe: those from first_runout() on.
Eigen::RowVectorXd runout_functions(const FitRecord& record, double angle);
Eigen::Index first_runout(const FitRecord& record, Eigen::Index probe);

}  // namespace whirl::inline data

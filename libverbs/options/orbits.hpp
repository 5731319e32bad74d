#pragma once
/// What orbit, continue and torus share: options, and where they begin.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/motions/run_result.hpp"
#include "libdyn/motions/transient.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libio/model/branch_parameters.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

/// A motion that has settled.
struct SettledVerbOptions {
  Option<long> discard{"discard", "N", "revolutions before it, for the transient; with --from none",
                       500, discard_range};
  Option<double> tolerance = tolerance_option();
  Option<std::string> isa = isa_option();
  auto fields() { return std::tie(discard, tolerance, isa); }
};

/// How orbits are found, of orbit and continue.
struct OrbitMethodVerbOptions {
  Option<OrbitMethod> method{"method", "M", "shooting or harmonic-balance", OrbitMethod::shooting};
  Option<long> harmonics{
      "harmonics", "N",
      "of harmonic balance, of the orbit's frequency; left out: as many as it takes",
      Whole{1, 10'000}};
  auto fields() { return std::tie(method, harmonics); }
};

/// What continue and torus follow motions along.
struct AlongVerbOptions {
  ListOption over;
  Option<int> points{"points", "N", "how many values a range without a step has", 101, point_range};
  Option<std::string> at;
  auto fields() { return std::tie(over, points, at); }
};

inline Option<OrbitFrame> frame_option() {
  return {"frame", "F", "in which it repeats: stationary or rotating", OrbitFrame::stationary};
}

/// Adds the forces of an orbit, over its period or some revolutions if these are more, and notes on
/// motions that no machine makes.
/// @param period  [revolutions]
MotionLoads add_loads(Report& report, const Model& model, const Scene& scene, const Vec& state,
                      double period);

/// Checks that an option, if it is given, goes with the method.
/// @param option  its name, with dashes
/// @throws ModelError  if it is one of harmonic balance only
void require_balance(OrbitMethod method, bool is_given, const char* option);

/// --harmonics; 0: left out.
/// @throws ModelError  if the speed itself, harmonic number `period`, is not among them
int checked_harmonics(const Option<long>& harmonics, int period);

/// The parameters of branches.
/// @throws ModelError  as branch_parameters
BranchParameters asked_parameters(const AlongVerbOptions& options, const Model& model);

/// The motion after the transient, from the start of the model or the end of a result.
Trajectory after_transient(const Invocation& call, const SettledVerbOptions& options,
                           const Option<std::string>& from, const Model& model, const Scene& scene);

/// A report with its headline, and with the notes on the model.
Report orbit_report(const Invocation& call, const Model& model, const std::string& what);

/// Says what was there already, that it was stopped, and where the result is.
void add_kept(const Invocation& call, const std::string& points, long resumed, Report& report);

}  // namespace whirl::inline cli

#pragma once
/// Speed against error of integrators on a model's motion, as a result.

#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/motions/work_precision.hpp"
#include "libdyn/studies/monitor.hpp"

namespace whirl::inline dyn {

struct WorkPrecisionOptions {
  std::vector<std::string> methods;  ///< as candidate_names; empty: all that suit the system
  std::vector<double> tolerances;
  long revolutions = 20;  ///< that are measured
  long discard = 500;     ///< before these
};

/// Group /bench.
struct WorkPrecisionStudy {
  WorkPrecisionOptions options;
  ReferenceMotion reference;
  std::vector<TimedRun> runs;  ///< tolerance by tolerance of method by method
  bool is_whole = true;        ///< false: it was stopped

  /// A number of each run over methods and tolerances; NaN where a run failed, or was not measured.
  Mat table(double (*number)(const TimedRun&)) const;
  Mat errors() const;
  Mat times() const;  ///< [s]
  Mat steps() const;  ///< per revolution
  Mat evaluations() const;

  static constexpr std::string_view group = "/bench";
  static constexpr auto columns() {
    using enum Written;
    using Study = WorkPrecisionStudy;
    constexpr std::string_view both = "methods tolerances";
    constexpr auto methods = [](auto& s) -> auto& {
      return s.options.methods;
    };
    constexpr auto tolerances = [](auto& s) -> auto& {
      return s.options.tolerances;
    };
    constexpr auto revolutions = [](const Study& s) {
      return static_cast<double>(s.options.revolutions);
    };
    constexpr auto made_by = [](auto& s) -> auto& {
      return s.reference.made_by;
    };
    constexpr auto error = [](auto& s) -> auto& {
      return s.reference.error;
    };
    constexpr auto growth = [](auto& s) -> auto& {
      return s.reference.growth;
    };
    constexpr auto counted = [](const Study& s) { return s.options.revolutions; };
    constexpr auto discard = [](const Study& s) { return s.options.discard; };
    return ColumnList{
        column("method", methods, "", "method").axis("methods+").only(in_file),
        column("tolerance", tolerances, "", "tolerance of a step")
            .axis("tolerances+")
            .within(valid::positive)
            .only(in_file),
        column("error", &Study::errors, "", "largest error at the end").along(both).only(in_file),
        column("time", &Study::times, "s", "processor time per revolution")
            .along(both)
            .only(in_file),
        column("steps", &Study::steps, "", "steps per revolution").along(both).only(in_file),
        column("evaluations", &Study::evaluations, "", "evaluations per revolution")
            .along(both)
            .only(in_file),
        column("revolutions", revolutions, "", "that are measured").only(in_file),
        column("reference", made_by, "", "how the reference was made").only(in_file).maybe(),
        column("reference_error", error, "", "the reference's own").only(in_file),
        column("growth", growth, "", "of a small deviation").only(in_file).maybe(),
        column("revolutions", counted, "", "that are measured").only(in_json),
        column("discard", discard, "", "revolutions before them").only(in_json),
        column("reference", &Study::reference, "", "what errors are measured against")
            .only(in_json),
        rows(&Study::runs, "runs").only(in_json)};
  }
};

/// Measures all methods at all tolerances, from the state after the revolutions that are discarded.
/// @throws NumericalError  if the discarded revolutions cannot be integrated
WorkPrecisionStudy work_precision_study(const ContactSystem& system, MotionState start,
                                        const WorkPrecisionOptions& options,
                                        const Monitor<WorkPrecisionStudy>& monitor = {});

}  // namespace whirl::inline dyn

#pragma once
/// What linear verbs share that run over a value of the model (modes, critical, unbalance).

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libdyn/linear/model_at.hpp"
#include "libio/model/model_family.hpp"
#include "libio/results/columns.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

/// Whether a call runs over a value.
/// @throws ModelError  for --points without --over
bool runs_over(const AxesVerbOptions& axes);

/// The value that a call runs over, and the models along it. The speed of a further shaft, as
/// rotor.hp.speed, may be one although the model has a ratio or a table of speeds: a constant speed
/// takes their place.
class LinearAxis {
 public:
  /// @throws ModelError  for a wrong model, option or axis, also at the ends of the axis
  LinearAxis(const Invocation& call, const AxesVerbOptions& axes);

  const Model& model() const { return model_; }  ///< as it is without --over
  const ParameterAxis& axis() const { return axis_; }
  ModelAt model_at() const;

 private:
  Model model_;
  ParameterAxis axis_;
  ModelFamily family_;
  std::optional<std::size_t> freed_;  ///< number of the rotor whose speed takes that place
};

/// Report on a result over values under a headline, with the file of --out.
/// @param text   the tables of the result
/// @param notes  on the result, before those on the model
template <class Result>
Report over_report(const Invocation& call, const LinearAxis& over, std::string_view what,
                   const Result& result, const std::string& text,
                   const std::vector<std::string>& notes = {}) {
  const Model& model = over.model();
  Report report = begin_report(call, model, record_of(result));
  report.text = headline(what, model) + "\n" + text;
  report.add_notes(notes);
  report.add_notes(linear_notes(model, speeds_over(call.values("over"), model.speed)));
  write_file(call, model, report, [&](ResultWriter& file) {
    file.attribute("/", "speed", model.speed);
    write_result(file, result);
  });
  return report;
}

}  // namespace whirl::inline cli

#pragma once
/// What the verbs share that compute many points (sweep, map, basins): options, the file of --out,
/// and the report.

#include <optional>
#include <string>
#include <vector>

#include "apps/verbs/common.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/results/kept_study.hpp"
#include "libio/text/interrupt.hpp"

namespace whirl::inline cli {

/// Options of all of them, behind those of one.
std::vector<OptionSpec> study_options(std::vector<OptionSpec> own);

/// Points of a study from the model, --over and --from.
/// @param least, most  numbers of axes that are right
/// @throws ModelError  for a wrong model, option or axis, also at the ends of the axes
StudyPoints study_points(const Invocation& call, std::size_t least, std::size_t most);

ClassifyOptions study_classify(const Invocation& call);
int study_threads(const Invocation& call);

/// Where the study is kept that a call asks for, and how it is followed; from now on Ctrl-C asks it
/// to stop.
/// @param start  where its motions begin, where that is the end of another result
/// @param what   is counted
/// @param notes  for its file
StudyKeeping study_keeping(const Invocation& call, const Model& model,
                           std::optional<EarlierEnd> start, std::string what,
                           std::vector<std::string> notes = {});

/// Report on a study under a headline.
/// @param record, text  what is found at its points
Report study_report(const Invocation& call, const Model& model, const StudyOutcome& outcome,
                    const Record& record, const std::string& text);

}  // namespace whirl::inline cli

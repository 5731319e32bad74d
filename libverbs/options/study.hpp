#pragma once
/// What the verbs share that compute many points (sweep, map, basins): options, the file of --out,
/// and the report.

#include <optional>
#include <string>
#include <vector>

#include "libio/results/kept_study.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/options/simulation.hpp"

namespace whirl::inline cli {

/// What a study varies.
struct AxesVerbOptions {
  ListOption over{"over", "PATH=A:B:STEP",
                  "a value of the model and what it runs over: first:last:step, first:last with "
                  "--points, or value,value,..."};
  Option<int> points{"points", "N", "how many values a range without a step has", point_range};
  auto fields() { return std::tie(over, points); }
};

/// Whether a study goes on from a result, and from its own file.
struct KeptVerbOptions {
  Option<std::string> from = from_option();
  Flag restart{"restart", "begin anew, whatever the file of --out holds"};
  auto fields() { return std::tie(from, restart); }
};

/// Further options of all studies.
struct StudyVerbOptions {
  Option<long> revolutions{"revolutions", "N", "revolutions that are measured", 1000,
                           revolution_range};
  Option<long> exponents{"exponents", "N",
                         "of these, over which Lyapunov exponents are averaged at most", 1000,
                         revolution_range};
  ExponentVerbOptions lyapunov{};
  Option<long> discard = discard_option();
  Option<double> tolerance = tolerance_option();
  Option<std::string> isa = isa_option();
  KeptVerbOptions kept{};
  Option<std::string> part{"part", "I/N",
                           "compute every N-th point only, from the I-th, into a file of its own; "
                           "`whirl merge` joins them",
                           [](const std::string& text) -> Parsed<std::string> {
                             const auto stripe = parse_stripe(text);
                             if (!stripe) return Parsed<std::string>::failed(stripe.problem);
                             return text;
                           }};
  auto fields() {
    return std::tie(revolutions, exponents, lyapunov, discard, tolerance, isa, kept, part);
  }
};

/// Points of a study.
/// @param least, most  numbers of axes that are right
/// @throws ModelError  for a wrong model, option or axis, also at the ends of the axes
StudyPoints study_points(const Invocation& call, const AxesVerbOptions& axes,
                         const KeptVerbOptions& kept, std::size_t least, std::size_t most);

ClassifyOptions study_classify(const StudyVerbOptions& options);
int study_threads(const Invocation& call);

/// Where the study that a call asks for is kept, and how it is followed; from now on Ctrl-C asks
/// the study to stop.
/// @param what   what is counted
/// @param notes  for the file of the study
StudyKeeping study_keeping(const Invocation& call, const Model& model,
                           const KeptVerbOptions& options, std::string what,
                           std::vector<std::string> notes = {});

/// Report on a study under a headline.
/// @param record, text  what is found at its points
Report study_report(const Invocation& call, const StudyPoints& points, const StudyOutcome& outcome,
                    const Record& record, const std::string& text);

}  // namespace whirl::inline cli

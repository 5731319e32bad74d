#include "libdata/fit/fit_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::inline data {

namespace {

constexpr double unexplained = 3.0;           ///< noise floors, from which what is left is told
constexpr double least_explained = 0.5;       ///< share of the readings, of a fit that is one
constexpr double clearly_above_least = 1.05;  ///< standard deviation over the least one
constexpr double hardly_apart = 0.98;         ///< correlation that is told

}  // namespace

void refuse_nonsense(MeasuredFit& found) {
  if (found.explained >= least_explained || found.residual < unexplained) return;
  found.same_end = 0;
  if (found.has_converged) {
    found.has_converged = false;
    found.why_not = fmt::format(
        "the motion found explains {} of the variance of the readings",
        found.explained > 0.0 ? fmt::format("{:.2g} %", 100.0 * found.explained) : "nothing");
  }
  found.notes.push_back(
      "so little is explained: are probes swapped, or is a gain, a unit or the sign of an angle "
      "wrong? Do they read gaps, so that offsets are to be found, too? Is the start far off?");
}

void add_notes(MeasuredFit& found) {
  std::string names;
  double most = 0.0;
  for (const FittedProbe& p : found.probes) {
    if (!(p.residual > unexplained * p.floor)) continue;
    most = std::max(most, p.residual / p.floor);
    if (names.find(p.name) == std::string::npos) names += (names.empty() ? "" : ", ") + p.name;
  }
  if (!names.empty()) {
    found.notes.push_back(fmt::format(
        "{}: up to {:.3g} times more is left than the noise that their upper frequencies show: the "
        "model may not explain the records, or a search from more starts finds more",
        names, most));
  }
  int of_runout = 0;  // one such pair is told
  for (Eigen::Index i = 0; i < found.correlation.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (!(std::abs(found.correlation(i, j)) > hardly_apart)) continue;
      const auto is_runout = [&](Eigen::Index p) {
        return found.parameters[static_cast<std::size_t>(p)].path.starts_with("runout of ");
      };
      if (is_runout(j) || (is_runout(i) && of_runout++ > 0)) continue;
      found.notes.push_back(fmt::format(
          "{} and {}: their errors are correlated by {:.5f}, the records tell one combination of "
          "them better than either",
          found.parameters[static_cast<std::size_t>(j)].path,
          found.parameters[static_cast<std::size_t>(i)].path, found.correlation(i, j)));
    }
  }
  if (found.grazes > 0) {
    found.notes.push_back(fmt::format(
        "the motions found graze contacts {} time{}: derivatives are one-sided there, and "
        "deviations less sure",
        found.grazes, found.grazes == 1 ? "" : "s"));
  }
  if (found.has_converged && found.over_least_deviation > clearly_above_least) {
    found.notes.push_back(fmt::format(
        "standard deviations are up to {:.3g} times the least possible: motions are too sensitive",
        found.over_least_deviation));
  }
  if (found.starts > 1 && found.same_end == 1) {
    found.notes.push_back(
        fmt::format("of {} starts one alone ends here: more may find better values", found.starts));
  }
}

}  // namespace whirl::inline data

#include "libio/page/machine_report.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "libbase/error.hpp"
#include "libio/figures/comparison.hpp"
#include "libio/results/call.hpp"

namespace whirl::inline io {

namespace {

struct Analysis {
  std::string_view verb, heading;
};

/// In the order of a report.
constexpr std::array<Analysis, 19> analyses{{{"lateral", "Lateral analysis"},
                                             {"static", "Sag and bearing loads"},
                                             {"modes", "Modes"},
                                             {"campbell", "Campbell diagram"},
                                             {"resonances", "Internal resonances"},
                                             {"critical", "Critical speeds"},
                                             {"unbalance", "Unbalance response"},
                                             {"frf", "Frequency response"},
                                             {"simulate", "Motion in time"},
                                             {"identify", "Modes in the motion"},
                                             {"classify", "Kind of motion"},
                                             {"orbit", "Periodic orbit"},
                                             {"sweep", "Along a parameter"},
                                             {"continue", "Branches of periodic orbits"},
                                             {"torus", "Quasi-periodic motion"},
                                             {"map", "In a plane of two parameters"},
                                             {"basins", "Coexisting motions"},
                                             {"fit", "Fit to measurements"},
                                             {"bench", "Speed against error"}}};

std::size_t place_of(const ResultView& result) {
  const std::string verb = verb_of(result);
  const auto found = std::find_if(analyses.begin(), analyses.end(),
                                  [&](const Analysis& a) { return a.verb == verb; });
  return static_cast<std::size_t>(found - analyses.begin());
}

}  // namespace

std::string verb_of(const ResultView& result) {
  try {
    return read_call(result.file).verb;
  } catch (const FileError&) {
    return "";
  }
}

std::string heading_of(const ResultView& result) {
  const std::size_t place = place_of(result);
  return place < analyses.size() ? std::string(analyses.at(place).heading) : verb_of(result);
}

bool is_one_machine(const std::vector<std::unique_ptr<ResultView>>& results) {
  if (results.size() < 2) return false;
  std::set<std::string> verbs;
  std::vector<std::string> texts;
  for (const auto& result : results) {
    const std::string verb = verb_of(*result);
    if (verb.empty() || !verbs.insert(verb).second) return false;
    texts.push_back(stored_model(result->file));
  }
  if (std::all_of(texts.begin(), texts.end(), [&](const auto& t) { return t == texts[0]; })) {
    return true;
  }
  const FigureTable rows = differences(texts, names_of(results));
  return !rows.header.empty() && std::all_of(rows.rows.begin(), rows.rows.end(), [](const auto& r) {
    return r.front().starts_with("operation.") || r.front().starts_with("report.");
  });
}

std::vector<const ResultView*> in_order(const std::vector<std::unique_ptr<ResultView>>& results) {
  std::vector<const ResultView*> ordered;
  for (const auto& result : results) ordered.push_back(result.get());
  std::stable_sort(ordered.begin(), ordered.end(), [](const ResultView* a, const ResultView* b) {
    return place_of(*a) < place_of(*b);
  });
  return ordered;
}

}  // namespace whirl::inline io

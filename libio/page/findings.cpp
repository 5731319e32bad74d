#include "libio/page/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "libdyn/studies/classification_result.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/page/machine_report.hpp"
#include "libio/results/study_status.hpp"

namespace whirl::inline io {

namespace {

using figures::result_of;

struct ByVerb {
  std::string_view verb;
  Findings (*find)(const ResultView& result);
};

Findings classify_findings(const ResultView& result) {
  const std::string group(ClassificationResult::group);
  if (!result.file.has_attribute(group, "motion")) {
    return {Standing::open, "The kind of the motion was not found."};
  }
  return {Standing::told,
          fmt::format("The motion is {}.", result.file.string_attribute(group, "motion"))};
}

constexpr std::array<ByVerb, 9> by_verb{{{"lateral", lateral_findings},
                                         {"static", static_findings},
                                         {"modes", modes_findings},
                                         {"campbell", campbell_findings},
                                         {"critical", critical_findings},
                                         {"unbalance", unbalance_findings},
                                         {"simulate", motion_findings},
                                         {"orbit", orbit_findings},
                                         {"classify", classify_findings}}};

}  // namespace

Findings findings_of(const ResultView& result) {
  const std::string verb = verb_of(result);
  const auto found =
      std::find_if(by_verb.begin(), by_verb.end(), [&](const ByVerb& k) { return k.verb == verb; });
  Findings f = found != by_verb.end()
                   ? found->find(result)
                   : Findings{Standing::told,
                              "No verdict: nothing was asked for that this analysis could pass or "
                              "fail. Its figures show what was found."};
  if (!says_complete(result.file)) {
    if (f.standing != Standing::failed) f.standing = Standing::open;
    f.sentences.insert(f.sentences.begin(), "The study is not complete.");
  }
  return f;
}

}  // namespace whirl::inline io

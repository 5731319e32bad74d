#pragma once
/// What can be said of a result on the first page of a printed report, and the tables behind it.

#include <string>
#include <vector>

#include "libio/figures/figures.hpp"
#include "libio/page/sheet.hpp"

namespace whirl::inline io {

/// How a result stands.
enum class Standing {
  passed,  ///< all of what was asked for is kept
  failed,  ///< some of it is not, or the rotor is unstable
  open,    ///< some of it could not be checked, or the computation is not complete
  told     ///< nothing was asked for: numbers speak
};

/// What was found. An analysis that asks for nothing has no verdict: it is `told`.
struct Findings {
  Standing standing = Standing::told;
  std::string headline;
  std::vector<std::string> sentences{};
  FigureTable summary{};        ///< stands on the first page; empty: none
  std::vector<Sheet> first{};   ///< tables that stand beside the verdict
  std::vector<Sheet> sheets{};  ///< all other tables of the result
};

/// Findings of a result by the verb that made it.
Findings findings_of(const ResultView& result);

// of the verbs, each in a file with its likes
Findings lateral_findings(const ResultView& result);
Findings static_findings(const ResultView& result);
Findings modes_findings(const ResultView& result);
Findings campbell_findings(const ResultView& result);
Findings critical_findings(const ResultView& result);
Findings unbalance_findings(const ResultView& result);
Findings motion_findings(const ResultView& result);
Findings orbit_findings(const ResultView& result);

/// Bearing loads, bending and clearances of a rotor at rest; empty where the file holds no rest.
std::vector<Sheet> rest_sheets(const ResultView& result);
/// Critical speeds; empty where the file holds none.
std::vector<Sheet> critical_sheets(const ResultView& result);

}  // namespace whirl::inline io

#pragma once
/// The page of a report: one HTML file with everything in it.

#include <memory>
#include <string>
#include <vector>

#include "libio/figures/figures.hpp"
#include "libio/page/cover.hpp"

namespace whirl::inline io {

struct ReportPage {
  std::string html;
  int figures = 0;
};

/// Every figure that the results hold, their facts and what moves, in one self-contained page.
///
/// Results of one machine (see machine_report.hpp) are one report of it: its drawing once, then a
/// section per analysis. Other results are shown one after the other, below figures that show them
/// over each other. A figure that fails is told with its reason, and the rest is drawn.
///
/// @param results  one or more
/// @param cover    its head
ReportPage report_page(const std::vector<std::unique_ptr<ResultView>>& results, const Cover& cover);

}  // namespace whirl::inline io

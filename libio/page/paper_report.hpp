#pragma once
/// The report for paper: everything on its pages, nothing behind a button.

#include <memory>
#include <string>
#include <vector>

#include "libio/page/cover.hpp"

namespace whirl::inline io {

struct PaperReport {
  std::string html;  ///< for write_pdf
  int figures = 0, tables = 0;
};

/// A house's own page; without a name the program's own one.
struct PaperTemplate {
  std::string name;  ///< of its file
  std::string html;
};

/// Cover, verdict, model, every case of every result with its figures, assumptions, what was not
/// checked, and where the numbers come from.
///
/// The page has no scripts. A figure that fails is told with its reason, and the rest is drawn.
/// @throws FileError  as filled_template
PaperReport paper_report(const std::vector<std::unique_ptr<ResultView>>& results,
                         const Cover& cover, const PaperTemplate& around = {});

}  // namespace whirl::inline io

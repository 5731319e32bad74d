#pragma once
/// The figures that a report of several results has.

#include <memory>
#include <string>
#include <vector>

#include "libio/figures/figures.hpp"

namespace whirl::inline io {

/// The figures of a kind of one result, with what other results lay over them.
/// @param results  all of the report, the one among them
std::vector<Figure> figures_with_others(const FigureKind& kind, const ResultView& result,
                                        const std::vector<std::unique_ptr<ResultView>>& results);

/// Figures of one kind and variant that all results have, over each other.
/// @param figures  of each result
/// @param names    of the results
std::vector<Figure> compared_figures(const std::vector<std::vector<Figure>>& figures,
                                     const std::vector<std::string>& names);

}  // namespace whirl::inline io

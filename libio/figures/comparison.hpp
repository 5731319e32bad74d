#pragma once
/// Several results side by side: figures of one kind drawn over each other, and how the models
/// differ.

#include <memory>
#include <string>
#include <vector>

#include "libio/figures/figures.hpp"

namespace whirl::inline io {

/// What tells results apart in a comparison: names of their files as far as they differ.
std::vector<std::string> names_of(const std::vector<std::unique_ptr<ResultView>>& results);

/// One figure with the curves of several of one kind and variant; a color stands for a result,
/// dashes and markers mean what they do in each figure. Axes are in the units of the first.
///
/// @param figures  one per name
/// @return         nothing where they cannot be drawn over each other: cells, several panels of
///                 different axes, layouts and stacked spectra
std::optional<Figure> overlay(const std::vector<const Figure*>& figures,
                              const std::vector<std::string>& names);

/// Values of the models that are not the same in all, by their paths, a column per model.
/// @param texts  of the model files
FigureTable differences(const std::vector<std::string>& texts,
                        const std::vector<std::string>& names);

}  // namespace whirl::inline io

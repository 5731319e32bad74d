#pragma once
/// Sizes of a rotor that are right and seldom meant.

#include <vector>

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"
#include "libio/model/config.hpp"

namespace whirl::inline io {

/// Shafts that are too long, too thick or too slim for machines; disks that are wider than the
/// shaft is long, or reach over a bearing.
/// @param root  tree of the model, for the places of its keys
void doubt_sizes(const ConfigNode& root, const Model& model, std::vector<Problem>& doubts);

/// Clearances above the radius of what is in them, where nothing else is doubted of them.
/// @param root, doubts  as of doubt_sizes
void doubt_clearances(const ConfigNode& root, const Model& model, std::vector<Problem>& doubts);

}  // namespace whirl::inline io

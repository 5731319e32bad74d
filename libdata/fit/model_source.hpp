#pragma once
/// Records compared with a model.

#include <functional>
#include <memory>
#include <vector>

#include "libdata/fit/fit_problem.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline data {

/// A source whose systems are those of a model.
///
/// All systems move in the shapes of one scene, see SystemSlope. No parameter may change the speed,
/// which is the one that the record was measured at.
///
/// Beyond a bound there may be no model. A value at a bound is therefore moved inside by a
/// millionth of the parameter's size, and the slopes at a value less than four steps (SystemSlope)
/// from a bound are those at four steps from it.
///
/// @param scene       of the model at the starts of the parameters
/// @param rows        as of FitSource
/// @param model_at    the model at values of the parameters, in their order [SI]
/// @throws ModelError  for a parameter that changes the speed
FitSource model_source(FitRecord record, std::shared_ptr<const Scene> scene, Mat rows,
                       const std::vector<FreeParameter>& parameters,
                       std::function<Model(const Vec& values)> model_at);

}  // namespace whirl::inline data

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
/// All of them move in the shapes of one scene, see SystemSlope. No parameter may change the speed:
/// that is what the record was measured at.
///
/// A value at a bound is taken a millionth of its size inside, and slopes within four steps of it
/// (SystemSlope) are those there: beyond a bound there may be no model.
///
/// @param scene       of the model at the starts of the parameters
/// @param rows        as of FitSource
/// @param model_at    the model at values of the parameters, in their order [SI]
/// @throws ModelError  for a parameter that changes the speed
FitSource model_source(FitRecord record, std::shared_ptr<const Scene> scene, Mat rows,
                       const std::vector<FreeParameter>& parameters,
                       std::function<Model(const Vec& values)> model_at);

}  // namespace whirl::inline data

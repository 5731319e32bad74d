#pragma once
/// Values of a model that a fit is free to choose, as a command line says it: --free.

#include <string>
#include <vector>

#include "libdyn/fit/fit_problem.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

struct FreeParameters {
  std::vector<FreeParameter> parameters;
  std::vector<ParameterAxis> axes;  ///< their paths and units, for a ModelFamily

  bool empty() const { return parameters.empty(); }
};

/// Reads PATH, PATH=LOW:HIGH, ... : values of a model, with the bounds that they must stay within.
///
/// A search begins at the model's own value, or in the middle of the bounds where that is zero or not in
/// the model. Numbers without unit are SI.
///
/// @param model  with the text that it was read from
/// @throws ModelError  for a path that is twice there, has no value or no number in the model and no
///                     bounds, and for bounds that are none
FreeParameters free_parameters(const Model& model, const std::string& list);

/// Those of a list that a model has, in its own words: what a candidate is without it does not fit.
/// @throws ModelError  as free_parameters, for paths that the model has
FreeParameters known_parameters(const Model& model, const std::string& list);

}  // namespace whirl::inline io

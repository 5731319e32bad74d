#pragma once
/// Values of a model that a fit is free to choose, as a command line says it: --free.

#include <string>
#include <vector>

#include "libdata/fit/fit_problem.hpp"
#include "libdyn/system/model.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

struct FreeParameters {
  std::vector<FreeParameter> parameters;
  std::vector<ParameterAxis> axes;  ///< their paths and units, for a ModelFamily

  bool empty() const { return parameters.empty(); }
};

/// Reads PATH, PATH=LOW:HIGH, ... : values of models, with the bounds that they must stay within.
///
/// A search begins at a model's own value, or in the middle of the bounds where that is zero or not
/// in the model. Numbers without unit are SI. Of several models each takes those values of the list
/// that stand in its file.
///
/// @param models  with the texts that they were read from
/// @return        of each model
/// @throws ModelError  for a path that stands there twice, a path that no model has, a path without
///                     bounds that has no number in its model, and for bounds that are not valid
std::vector<FreeParameters> free_parameters(const std::vector<Model>& models,
                                            const std::string& list);

}  // namespace whirl::inline io

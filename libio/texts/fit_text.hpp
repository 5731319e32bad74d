#pragma once

#include <string>

#include "libdata/fit/measured_fit.hpp"

namespace whirl::inline io {

/// Tables of the parameters, their correlations, the residual of each probe, and models beside one
/// another; then the --set lines that go on with these values.
/// @param model  file of the model
std::string text_of(const MeasuredFit& found, const std::string& model);

}  // namespace whirl::inline io

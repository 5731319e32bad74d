#pragma once
/// Laws of a model's supports beside the responses that they were fitted to.

#include "libdyn/linear/support_fits.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline io {

/// Reads the responses of a model's text again, and fits its laws. A law is told at the frequencies
/// of its response and at three between each two of these.
///
/// @param model  as read_model or parse_model gives it
/// @return       without fits: no support has a law that was fitted
SupportFits fitted_laws(const Model& model);

}  // namespace whirl::inline io

#pragma once
/// Signals that saturate, as contacts.

#include "libdyn/system/model.hpp"

namespace whirl::inline dyn {

/// Adds a contact behind the others for each limit that supports of a model have
/// (Support::limits): it touches while the signal is beyond the limit, with the force that the
/// support lacks by it. Readers of model files do this; models that are made in C++ need it once,
/// when all supports and contacts are there.
void add_limits(Model& model);

}  // namespace whirl::inline dyn

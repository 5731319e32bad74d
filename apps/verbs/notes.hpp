#pragma once
/// Notes of verbs: what of a model they leave out, and where they go beyond its data.

#include <vector>

#include "apps/invocation.hpp"

namespace whirl::inline cli {

/// Says which contacts and oil films are left out, and which bearing tables are held constant at
/// their ends for some speeds, one or more [rad/s].
void note_linear(const Model& model, const std::vector<double>& speeds, Report& report);
/// The second of these.
void note_tables(const Model& model, const std::vector<double>& speeds, Report& report);
/// For the speed of the model, or for those that --over goes through.
void note_tables(const Invocation& call, const Model& model, Report& report);

}  // namespace whirl::inline cli

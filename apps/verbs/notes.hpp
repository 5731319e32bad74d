#pragma once
/// Notes of verbs: what of a model they leave out, and where they go beyond its data.

#include "apps/invocation.hpp"

namespace whirl::inline cli {

/// Behind the number of a mode that hardly whirls, and what it means.
constexpr const char* heavy_mark = "*";
constexpr const char* heavy_legend =
    "\n  *: heavily damped, a damping ratio above 0.5; a mode of the bearings in most cases\n";

/// Says which contacts and oil films are left out.
void note_left_out(const Model& model, Report& report);

/// Says which bearing tables are held constant at their ends for speeds in a range [rad/s].
void note_tables(const Model& model, double lowest, double highest, Report& report);
/// The same for the speed of the model, or for those that --over goes through.
void note_tables(const Invocation& call, const Model& model, Report& report);

}  // namespace whirl::inline cli

#pragma once
/// Motions for people: how the rotor was reduced, what was integrated, what contacts and stations
/// do.

#include <string>
#include <vector>

#include "libdyn/motions/run_result.hpp"

namespace whirl::inline io {

/// What contacts did over so many revolutions.
std::string contacts_table(const std::vector<ContactMeasure>& contacts, long revolutions);

/// A line on the reduction, and a warning where its error is above the model's tolerance.
std::string reduction_text(const Scene& scene, const Model& model);

/// Forces on supports, and heat and moment of friction where something rubs.
std::string text_of(const MotionLoads& loads);

/// When loads begin [s], and of what the forces before and after are; empty: none begins.
std::string loads_begin_text(const std::vector<double>& begins);

/// What was integrated, how, at what cost, and what contacts and stations did.
/// @param stations  station_summaries of the run
std::string text_of(const Run& run, const Model& model, const RunSummary& summary,
                    const std::vector<StationSummary>& stations);

}  // namespace whirl::inline io

#pragma once
/// What identify does with a measured motion.

#include "libdyn/motions/identify.hpp"
#include "libverbs/options/measured.hpp"
#include "libverbs/options/running_modes.hpp"

namespace whirl::inline cli {

/// Headline of a MAC table.
std::string mac_heading(const Model& model, const IdentifyOptions& options);

/// What the motion of a record is made of.
Report identify_measured(const Invocation& call, const MeasuredVerbOptions& asked,
                         const MachineVerbOptions& machine_asked,
                         const RunningModesVerbOptions& running_asked,
                         const IdentifyOptions& options);

}  // namespace whirl::inline cli

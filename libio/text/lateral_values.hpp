#pragma once
/// What a machine is run at and what its impellers do, as options of a lateral analysis give it.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/lateral/lateral_rules.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// A speed above zero [rad/s].
Parsed<double> parse_running_speed(std::string_view text);

/// A cross-coupled stiffness above zero [N/m].
Parsed<double> parse_coupling(std::string_view text);

/// A density above zero [kg/m^3].
Parsed<double> parse_gas_density(std::string_view text);

/// Impellers, with commas between: power, diameter, least width and density ratio of each,
/// "1200kW:450mm:18mm:1.3".
Parsed<std::vector<Stage>> parse_stages(std::string_view text);

/// Says of bare numbers of --cross-coupling and --gas-density what they mean, and which US unit may
/// have been meant; empty texts: not given.
std::vector<std::string> bare_value_notes(const std::string& coupling,
                                          const std::string& gas_density);

}  // namespace whirl::inline io

#pragma once
/// Linear analyses over a value of the model for people: tables for some twenty of the values.

#include <string>
#include <vector>

#include "libdyn/linear/critical_over.hpp"
#include "libdyn/linear/modes_over.hpp"
#include "libdyn/linear/unbalance_over.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

/// Frequencies and logarithmic decrements, a table each, and thresholds of instability.
std::string text_of(const ModesOver& found, const ParameterAxis& axis);

/// Undamped and damped critical speeds.
std::string text_of(const CriticalOver& found, const ParameterAxis& axis);

/// Largest responses of stations and probes, and the peaks of all values.
std::string text_of(const UnbalanceOver& found, const ParameterAxis& axis);

/// What responses over a value leave out of a model.
std::vector<std::string> notes_of_unbalance_over(const Model& model);

}  // namespace whirl::inline io

#pragma once
/// A model for people: what it is, and what analyses leave out of it.

#include <string>
#include <string_view>
#include <vector>

#include "libdyn/system/model_facts.hpp"

namespace whirl::inline io {

/// "Sweep: two-disk rotor", the first line of what a verb says of a model.
std::string headline(std::string_view what, const Model& model);

/// Table of what a model has.
std::string text_of(const ModelFacts& facts, const Model& model);

/// Which bearing tables are held constant at their ends for some speeds, one or more [rad/s].
std::vector<std::string> table_notes(const Structure& structure, const std::vector<double>& speeds);

/// Which connections have coefficients that depend on the whirl frequency, so that a motion, which
/// contains many frequencies, takes the coefficients at its speed; empty: none.
std::vector<std::string> frequency_notes(const Structure& structure);

/// Which contacts and oil films the static sag leaves out, and the table_notes.
std::vector<std::string> left_out_notes(const Model& model, const std::vector<double>& speeds);

/// Which oil films are linearized about their equilibrium; none: no such film.
std::vector<std::string> film_notes(const Model& model);

/// That the speed is far outside of the range that the model gives its machine; none: the speed is
/// not.
std::vector<std::string> speed_notes(const Model& model);

/// All notes on a linear analysis: film_notes, left_out_notes and speed_notes.
std::vector<std::string> linear_notes(const Model& model, const std::vector<double>& speeds);

}  // namespace whirl::inline io

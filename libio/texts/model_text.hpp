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

/// Which connections have coefficients that depend on the whirl frequency, of which a motion that
/// contains many takes those of its speed; empty: none.
std::vector<std::string> frequency_notes(const Structure& structure);

/// Which contacts and oil films the static sag leaves out, and the same of tables.
std::vector<std::string> left_out_notes(const Model& model, const std::vector<double>& speeds);

/// Which oil films linear modes have about their equilibrium; none: no note.
std::vector<std::string> film_notes(const Model& model);

/// That the speed is far outside of the range that the model gives its machine; none: it is not.
std::vector<std::string> speed_notes(const Model& model);

/// The same of a linear analysis, and which oil films it linearizes.
std::vector<std::string> linear_notes(const Model& model, const std::vector<double>& speeds);

}  // namespace whirl::inline io

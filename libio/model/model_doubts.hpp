#pragma once
/// What in a model is right and seldom meant.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/system/model_facts.hpp"
#include "libio/model/named_files.hpp"

namespace whirl::inline io {

/// Numbers without a unit that are unlike those of machines (angles, densities, moduli, friction,
/// oil, clearances, unbalances, speeds), speeds far outside of the machine's own range, shafts as
/// long as houses, layers where something else is, and columns that tables of bearings lack.
///
/// @param text, name, sets, files  as of parse_model
/// @return  with their places, in the order in which they were found; each says what may be meant
/// @throws ModelError  for a wrong model
std::vector<Problem> model_doubts(const std::string& text, const std::string& name,
                                  const std::vector<std::string>& sets, const NamedFiles& files);

/// Says how far the speed is outside of the range that the model gives its machine; empty: the
/// speed is not far outside, or there is no range.
std::string speed_doubt(const Model& model);

/// Doubts about contacts that the rotor touches at rest.
std::vector<Problem> rest_doubts(const ModelFacts& facts, const Model& model);

}  // namespace whirl::inline io

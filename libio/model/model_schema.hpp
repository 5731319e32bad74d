#pragma once
/// The schema of model files, for editors.

#include <string>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io {

/// JSON Schema (draft 7) of a model file: tables, keys, units, ranges, choices, defaults.
///
/// It is made of what the reader asks for while it reads specimens of every kind of table, so that
/// it knows the keys that the reader knows, and no others. What one key says about another part of
/// the model (names of bodies, places on the shaft, two keys that exclude each other) is checked by
/// the reader alone.
///
/// @source JSON Schema draft 7, json-schema.org
Record model_schema();

/// Schema of a quantity: a number in SI, or a text with a unit of its dimension. Of units that are
/// made of several, only the spelling is checked.
/// @param unit  SI unit, as in dimension_of
Record quantity_schema(const std::string& unit, Range range);

/// Name of a quantity among the definitions of the schema: "positive-tilt-stiffness".
std::string quantity_definition(const std::string& unit, Range range);

}  // namespace whirl::inline io

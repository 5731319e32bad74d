#pragma once
/// A rotor of ROSS as a model file that a person can read.

#include <string>
#include <vector>

#include "libio/import/ross.hpp"

namespace whirl::inline io {

/// A file that goes with a model, such as a table of coefficients.
struct ImportedTable {
  std::string name;  ///< as the model names it
  std::string text;
};

struct ImportedModel {
  std::string text;  ///< of the model file
  std::vector<ImportedTable> tables;
  std::vector<std::string> left_out;           ///< what the model does not have, a sentence each
  std::vector<std::string> taken_differently;  ///< what means something else in the model
};

/// Writes a rotor as a model. Nodes keep their order and are counted from 1, those of ROSS from 0.
/// Equal elements beside one another become one segment of several, equal layers one layer.
///
/// Shear coefficients of ROSS's Hutchinson are written as numbers, since ROSS has 1 + nu where
/// [Hutchinson2001] has (1 + nu)^2:
///
///   kappa = 6 (1 + r^2)^2 (1 + nu)
///           / ((1 + r^2)^2 (7 + 12 nu + 4 nu^2) + 4 r^2 (5 + 6 nu + 2 nu^2))
///
/// with r the inner over the outer diameter.
///
/// @param source  name of the file that it was read from
/// @param stem    what names of tables begin with
/// @throws ModelError  if shaft elements leave nodes out, or a layer is not as long as the element
///                     that it lies on
ImportedModel model_of(const RossRotor& rotor, const std::string& source, const std::string& stem);

}  // namespace whirl::inline io

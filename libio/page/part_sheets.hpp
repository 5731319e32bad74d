#pragma once
/// What a model consists of, as tables of a printed report.

#include <vector>

#include "libdyn/system/model.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libio/page/sheet.hpp"

namespace whirl::inline io {

/// A model with its mesh.
struct ModelParts {
  const Model& model;
  const Assembler& assembler;
  const Structure& structure = model.structure;
  const Mesh& mesh = assembler.mesh();
};

/// Materials, sections, layers, and every station.
std::vector<Sheet> shaft_sheets(const ModelParts& parts);

/// Coefficients of bearings, seals and links, and the oil films. Connections of equal coefficients
/// share a table.
std::vector<Sheet> connection_sheets(const ModelParts& parts);

/// Disks, bodies, unbalances, forces, probes and contacts.
std::vector<Sheet> attached_sheets(const ModelParts& parts);

/// All tables of a model.
std::vector<Sheet> model_sheets(const ModelParts& parts);

/// A station along the shaft [mm], or the name of its body: for columns.
std::string z_text(const Station& station, const ModelParts& parts);

}  // namespace whirl::inline io

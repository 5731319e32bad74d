#pragma once
/// From models and results to what ParaView shows.

#include "libdyn/system/model.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libio/export/vtk.hpp"

namespace whirl::inline io {

/// Shaft with its diameters and layers, disks, spinning bodies, stators of all contacts.
///
/// Bodies have no place along the shaft: each is put where a contact, bearing or link joins it to
/// the shaft. Disks and bodies whose size the model does not give are symbols, see disk_shape.
VtkScene vtk_scene(const Model& model, const Assembler& assembler);

/// One cycle of a mode, q = Re(shape e^(i phase)): damping is left out.
///
/// A mode has no amplitude of its own: it gets the one that fits the scene, drawn to scale.
std::vector<VtkFrame> vtk_mode_frames(const Mode& mode, const DofMap& dofs, const VtkScene& scene,
                                      int frames);

/// A moment of a motion.
/// @param full      full vector of displacements
/// @param normal    normal force of every contact [N], friction force likewise
VtkFrame vtk_frame(const Model& model, const Assembler& assembler, double time, const Vec& full,
                   const Vec& normal, const Vec& friction);

}  // namespace whirl::inline io

#pragma once
/// Long motions for ParaView: a small XDMF file, with the numbers in an HDF5 file beside it.

#include <filesystem>
#include <vector>

#include "libio/export/vtk.hpp"

namespace whirl::inline io {

/// Writes "x.xdmf" and "x_xdmf.h5": the shaft's axis as lines at rest, with point data of every
/// frame.
///
/// Point data: "displacement [m]", "rotation [rad]", both true; "contact force [N]", the sum of
/// those on the rotor at a point; "radius [m]" of the shaft, 0 beside it. Without a shaft, points
/// alone. The .xdmf is removed first and written last: where there is one, it is complete.
///
/// @param frames  all with as many points and contacts as the scene
/// @return        paths of the files, the .xdmf first
/// @throws FileError  if a file cannot be written
std::vector<std::filesystem::path> write_xdmf_series(const std::filesystem::path& xdmf_path,
                                                     const VtkScene& scene,
                                                     const std::vector<VtkFrame>& frames,
                                                     Replaces replaces = Replaces::own_pictures);

}  // namespace whirl::inline io

#pragma once

#include <filesystem>

namespace whirl::inline io::hdf5 {

/// Reads all of a file in a child process first, as io::try_in_child.
///
/// HDF5 1.10 ends the process on some damaged files and never returns from others. Where a file has no
/// checksum to tell damage, a child finds out.
void try_in_child(const std::filesystem::path& file);

}  // namespace whirl::inline io::hdf5

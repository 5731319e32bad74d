#pragma once
/// The matrices of a rotor, M q'' + (C + Omega G) q' + K q = f, for programs that compute with
/// them. Omega H of damping that rotates is in K.

#include <filesystem>
#include <string>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

/// What each coordinate q_i is: "node 3 x", or several such names where a rigid bearing or link
/// holds them together.
std::vector<std::string> coordinate_names(const DofMap& dofs, const Model& model);

/// Position of each coordinate along the shaft [m]; NaN for a body and for an internal shape
/// function.
std::vector<double> coordinate_places(const DofMap& dofs, const Model& model,
                                      const Assembler& assembler);

/// Writes STEM_M.mtx, STEM_C.mtx, STEM_G.mtx, STEM_K.mtx (Matrix Market, coordinate format) and
/// STEM_dofs.csv, a line per coordinate.
///
/// Supports are eliminated, nothing is condensed: M is singular where there is no inertia.
/// @param Omega  spin speed, of bearings and rotating damping [rad/s]
/// @return       the files
/// @throws FileError
/// @source the format: NIST, https://math.nist.gov/MatrixMarket/formats.html
std::vector<std::filesystem::path> write_matrix_market(const std::filesystem::path& stem,
                                                       const Model& model,
                                                       const Assembler& assembler, double Omega,
                                                       Replaces replaces);

/// Writes STEM.mat (MATLAB 5): sparse M, C, G, K, the number Omega, and dofs, a row of characters
/// per coordinate.
/// @throws FileError
std::vector<std::filesystem::path> write_matlab(const std::filesystem::path& stem,
                                                const Model& model, const Assembler& assembler,
                                                double Omega, Replaces replaces);

}  // namespace whirl::inline io

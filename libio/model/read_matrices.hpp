#pragma once
/// Supports from matrices of finite element programs.

#include <cstddef>
#include <optional>
#include <vector>

#include "libfe/analyses/craig_bampton.hpp"
#include "libio/model/model_reading.hpp"

namespace whirl::inline io {

/// The keys mass_matrix, stiffness_matrix, damping_matrix and modes: files in MatrixMarket's form,
/// which are reduced to the interface and few modes. A stored model has the reduced matrices in it,
/// with a comment that says which rows the interface was.
///
/// @param rows  of each coordinate of the interface, from 1
/// @param item  number of the support, from 0
/// @return      nothing: no matrix is named, or one is wrong, which is reported
std::optional<StructureMatrices<Mat>> read_matrices(ModelReading& reading, TableReader& table,
                                                    std::size_t item,
                                                    const std::vector<long>& rows);

}  // namespace whirl::inline io

#pragma once
/// Invariant circles in a result file.

#include "libdyn/studies/torus_branch.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Group /torus: the circle, those along the parameter, and what the walk goes on from.
/// @param axis  of the parameter; does not count without walks
void write_torus(ResultWriter& file, const Scene& scene, const ParameterAxis& axis,
                 const TorusBranch& torus);

/// The same again, bit by bit; a circle without points where the file holds nothing to go on from.
/// @param states  of the circle's points
/// @throws FileError  if the file holds something else
TorusBranch read_torus(const ResultReader& file, Eigen::Index states);

}  // namespace whirl::inline io

#pragma once
/// Invariant circles in a result file.

#include "libdyn/studies/torus_result.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Group /torus: the circle, the circles along the parameter, and what the walk goes on from.
/// @param result  of the torus
void write_torus(ResultWriter& file, const TorusBranch& torus, TorusResult result);

/// Reads the circles again, bit by bit; a circle without points if the file holds nothing to go on
/// from.
/// @param states  of the circle's points
/// @throws FileError  if the file holds something else
TorusBranch read_torus(const ResultReader& file, Eigen::Index states);

}  // namespace whirl::inline io

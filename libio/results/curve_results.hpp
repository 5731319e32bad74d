#pragma once
/// Curves of bifurcations in the plane of two parameters, in a result file.

#include "libdyn/studies/bifurcation_curves.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// The parameters of curves: that of the branches, its range, and the second one.
struct CurveAxes {
  ParameterAxis first;
  ParameterRange along;
  ParameterAxis second;
};

/// Group /border: curves of bifurcations along a second parameter; nothing without curves.
void write_curves(ResultWriter& file, const BifurcationCurves& curves, const CurveAxes& axes);

/// The same curves again, bit by bit; none where there are none.
/// @param layout  of the branches that they go through
/// @throws FileError  if the file holds something else
BifurcationCurves read_curves(const ResultReader& file, const BranchLayout& layout);

}  // namespace whirl::inline io

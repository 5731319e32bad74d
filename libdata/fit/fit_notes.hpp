#pragma once
/// What is told of a fit that was found.

#include "libdata/fit/measured_fit.hpp"

namespace whirl::inline data {

/// A search that ended where the motion found has less than half of what was read, and what is left
/// is not noise, has not found a fit.
void refuse_nonsense(MeasuredFit& found);

/// Doubts: more left than noise, values that cannot be told apart, grazes, lonely ends of searches.
void add_notes(MeasuredFit& found);

}  // namespace whirl::inline data

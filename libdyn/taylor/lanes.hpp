#pragma once
/// How many motions step together.

namespace whirl::inline dyn {

/// Motions without tangents that a batch moves on at once, with the instruction set in use: as many
/// as two registers hold, one where it has no registers for lanes. A step of fewer takes as long.
int lanes_together();

}  // namespace whirl::inline dyn

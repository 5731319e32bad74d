#pragma once
/// Speeds of a command line without a unit: 3000 is 28 648 rpm, which few mean.

#include <string>
#include <vector>

#include "apps/invocation.hpp"

namespace whirl::inline cli {

/// A speed that was given as a bare number.
struct BareSpeed {
  std::string option;    ///< "--speed", "--over operation.speed="
  std::string value;     ///< "3000", "0:8000:50"
  std::string readings;  ///< "3000 rad/s = 28 648 rpm"

  /// "speed: 3000 rad/s = 28 648 rpm (no unit given; for revolutions per minute write 3000rpm)".
  std::string reading() const;
  /// A sentence that names the option.
  std::string warning() const;
};

/// All of a call: of --speed, --set and --over of operation.speed, --at along it, --speeds. Zero is
/// the same in every unit, and what is no number is told by whoever reads it.
/// @param speed  value of --speed, which stands among the sets too; empty: not given
std::vector<BareSpeed> bare_speeds(const Invocation& call, const std::string& speed);

}  // namespace whirl::inline cli

#pragma once
/// The shafts of a rotor of ROSS: those of coaxial rotors, and those that gears join.

#include <optional>
#include <string>
#include <vector>

#include "libio/import/ross.hpp"

namespace whirl::inline io {

struct RossShaft {
  std::string name;         ///< of the [[rotor]]; empty: the first shaft
  int first = 0, last = 0;  ///< nodes of ROSS
  double ratio = 1.0;       ///< of its speed to that of the first one
  double position = 0.0;    ///< of its left end, from that of the first one [m]
};

/// Two gears on two shafts.
struct RossTeeth {
  const RossGear *driving, *driven;
  double stiffness;  ///< [N/m]
  double centers;    ///< direction from the driving to the driven center [rad]
};

struct RossShafts {
  std::vector<RossShaft> shafts;
  std::vector<const RossElement*> elements, layers;  ///< the innermost ones, and those on them
  std::optional<RossTeeth> teeth;
  std::vector<std::string> left_out;           ///< a sentence each
  std::vector<std::string> taken_differently;  ///< likewise

  /// Whether a node of ROSS is on any of the shafts.
  bool has(int node) const { return shaft_of(node) != nullptr; }
  /// Null: a support.
  const RossShaft* shaft_of(int node) const;
  /// A node of a shaft as the model counts it: from 1, without those of supports.
  int number(int node) const;
};

/// Parts a rotor into its shafts. The second one turns with the speed ratio that the file tells, or
/// with that of the teeth; without both as the first one, which is said.
///
/// @param rotor  must outlive what is returned
/// @throws ModelError  if elements leave nodes out that are no supports, or a layer is not as long
///                     as the element that it lies on
RossShafts shafts_of(const RossRotor& rotor);

}  // namespace whirl::inline io

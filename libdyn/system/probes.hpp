#pragma once
/// What displacement probes read, as rows of results.

#include <string>
#include <tuple>

#include "libbase/column.hpp"
#include "libbase/constants.hpp"
#include "libfe/structure.hpp"

namespace whirl::inline dyn {

/// A probe as results name it; rows of results begin with its columns.
struct ProbeLabel {
  std::string name;
  double angle = 0.0;  ///< of its direction, from +x towards +y [rad]
  std::string unit;    ///< a length, in which people are told what it reads

  ProbeLabel() = default;
  ProbeLabel(const Probe& probe) : name(probe.name), angle(probe.angle), unit(probe.unit) {}

  double angle_deg() const { return angle / degree; }

  static constexpr auto columns() {
    using enum Written;
    return std::tuple{
        column("name", &ProbeLabel::name, "", "probe").axis(),
        column("angle", &ProbeLabel::angle, "rad", "direction of a probe, from +x towards +y")
            .only(in_file),
        column("angle_deg", &ProbeLabel::angle_deg, "", "the same in degrees").only(in_json),
        column("unit", &ProbeLabel::unit, "", "in which people are told what it reads")};
  }
};

}  // namespace whirl::inline dyn

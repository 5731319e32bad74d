#pragma once
/// What displacement probes read, as rows of results.

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "libbase/column.hpp"
#include "libbase/constants.hpp"
#include "libbase/linalg.hpp"
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

/// Labels of probes as columns of their own, for results whose rows are something else.
struct ProbeLabels {
  std::vector<std::string> names, units;
  std::vector<double> angles;  ///< [rad]

  ProbeLabels() = default;
  explicit ProbeLabels(const std::vector<Probe>& probes);

  std::size_t size() const { return names.size(); }
  ProbeLabel operator[](std::size_t i) const;
  std::vector<ProbeLabel> list() const;
};

/// Peak to peak of what a probe reads of a motion x + i y = f e^(i w t) + b e^(-i w t) [m]:
///
///   x cos a + y sin a = Re((f e^(-i a) + conj(b) e^(i a)) e^(i w t))
///
/// @param angle     a of the probe [rad]
/// @param forward   f [m]
/// @param backward  b [m]
double peak_to_peak(double angle, const Complex& forward, const Complex& backward);

}  // namespace whirl::inline dyn

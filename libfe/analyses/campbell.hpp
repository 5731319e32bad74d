#pragma once
/// Modes followed over speed.

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline fe {

/// One mode, followed through the speeds by its shape.
struct CampbellBranch {
  Whirl whirl = Whirl::planar;    ///< the sense it has at most speeds other than zero
  std::vector<double> frequency;  ///< damped, per speed [rad/s]; NaN where it does not oscillate
  std::vector<double> log_decrement;  ///< per speed; NaN likewise

  static constexpr auto columns() {
    return ColumnList{
        column("whirl", &CampbellBranch::whirl, "", "sense of whirl"),
        column("frequency", &CampbellBranch::frequency, "rad/s", "damped natural frequency")
            .along("speeds"),
        column("log_decrement", &CampbellBranch::log_decrement, "", "logarithmic decrement")
            .along("speeds")};
  }
};

/// A speed at which a branch meets an excitation line.
struct Crossing {
  double speed = 0.0;  ///< [rad/s]
  int branch = 0;      ///< from 0

  static constexpr auto columns() {
    return ColumnList{column("speed", &Crossing::speed, "rad/s", "critical speed"),
                      column("branch", &Crossing::branch, "", "branch that is critical")
                          .from_one()
                          .within(valid::numbers_of("branches"))};
  }
};

/// A speed at which a mode begins to grow by itself, or ceases to.
struct Threshold {
  double speed = 0.0;      ///< [rad/s]
  double frequency = 0.0;  ///< at which it whirls there [rad/s]
  int branch = -1;         ///< from 0; -1: the mode is none of those that are followed

  bool is_followed() const { return branch >= 0; }
  /// From 1.
  std::optional<int> mode() const {
    return is_followed() ? std::optional(branch + 1) : std::nullopt;
  }

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("speed", &Threshold::speed, "rad/s", "threshold of instability"),
        column("frequency", &Threshold::frequency, "rad/s", "of the whirl at the threshold"),
        column("branch", &Threshold::branch, "", "branch that loses its damping; 0: none of these")
            .from_one()
            .only(in_file),
        column("mode", &Threshold::mode, "", "branch that loses its damping").only(in_json)};
  }
};

/// A speed whose modes cannot be computed.
struct CampbellGap {
  double speed = 0.0;  ///< [rad/s]
  std::string why;

  static constexpr auto columns() {
    return ColumnList{column("speed", &CampbellGap::speed, "rad/s", "speed that is left out"),
                      column("why", &CampbellGap::why, "", "why")};
  }
};

struct Campbell {
  std::vector<double> speeds;  ///< [rad/s]
  std::vector<CampbellBranch> branches;
  std::vector<Crossing> crossings;    ///< with frequency = order * Omega, ascending speed
  std::vector<Threshold> thresholds;  ///< of the modes computed, ascending speed
  std::vector<CampbellGap> gaps;      ///< speeds at which every branch is NaN; most have none

  /// Speeds of the crossings [rad/s].
  std::vector<double> criticals() const;

  static constexpr std::string_view group = "/campbell";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("speed", &Campbell::speeds, "rad/s", "rotor speed")
            .axis("speeds+")
            .within(valid::finite)
            .as("speeds_rpm"),
        rows(&Campbell::branches, "branches").numbered("branch", "branch"),
        column("criticals", &Campbell::criticals, "rad/s", "critical speeds").only(in_json),
        rows(&Campbell::crossings, "crossings").prefixed("critical_").maybe().only(in_file),
        rows(&Campbell::thresholds, "thresholds").prefixed("threshold_").maybe(),
        rows(&Campbell::gaps, "gaps").maybe().only(in_json)};
  }
};

/// Modes of a structure over speeds, followed through crossings.
///
/// Modes of neighboring speeds belong together if their shapes agree (MAC weighted with M); where
/// they do not agree well, speeds between are computed too until they do. A speed whose modes
/// cannot be computed is left out and told, and its neighbors are compared with one another. A
/// branch ends where no mode is like it any more; if bearings change with speed, one begins for a
/// mode that comes among the lowest then.
///
/// Where more modes, or fewer, grow at a speed than at the one before, thresholds of instability
/// lie between: the roots over speed of the real parts of the eigenvalues, the largest one first.
/// Modes that do not oscillate at first, as those of bearings with oil films, count as others do.
///
/// @param speeds    ascending, nonnegative [rad/s]
/// @param branches  how many of the lowest modes at the first speed above zero are followed
/// @param order     excitation line whose crossings are reported, 1 for unbalance
/// @throws NumericalError  if modes cannot be computed at any speed
Campbell campbell(const Assembler& assembler, const std::vector<double>& speeds, int branches,
                  double order = 1.0);

/// MAC of two complex shapes with a weight: |a^H W b|^2 / (a^H W a  b^H W b).
double mac(const CVec& a, const CVec& b, const Sparse& W);

}  // namespace whirl::inline fe

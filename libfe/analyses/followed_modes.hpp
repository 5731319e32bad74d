#pragma once
/// Modes at many speeds: all at a few of them, each for itself between.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libfe/analyses/modes.hpp"

namespace whirl::inline fe {

/// The lowest oscillatory modes of a structure at the speeds of a range.
///
/// All modes are computed at the ends of spans of speeds. Between, each mode is followed from speed
/// to speed by Newton's iteration on its eigenpair, from where the speeds before lead: upward from
/// the lower end, and what the upper end has beyond that downward. A span is halved, with all modes
/// computed in the middle, where that leaves a doubt: a mode changes its shape between two speeds
/// or is lost, two become one, there are too few, or what arrives at one end is not what is there.
/// A mode that is among the lowest inside of a span only, not at its ends, is missed.
///
/// Modes of small systems are computed at every speed, and so are those at rest, where pairs are
/// one.
class FollowedModes {
 public:
  /// @param speeds  ascending, nonnegative [rad/s]
  /// @param count   modes wanted; fewer come if there are fewer
  FollowedModes(const Assembler& assembler, const ModeFinder& finder,
                const std::vector<double>& speeds, int count);

  /// Modes at a speed [rad/s], ascending frequency. Those between speeds that are known are
  /// followed from both.
  ///
  /// @throws NumericalError  if modes cannot be computed there
  const std::vector<Mode>& at(double Omega);
  /// Mass matrix at a speed [rad/s], by which shapes of modes there are compared.
  const Sparse& mass(double Omega) { return known_at(Omega).M; }

  /// The mode at a speed between two at which it is known; nothing where what it is followed to is
  /// not like both, or the system is small.
  ///
  /// @param guess  the mode at a speed as near as can be
  std::optional<Mode> like(const Mode& guess, const Mode& below, const Mode& above,
                           double Omega) const;

 private:
  /// What is known at a speed.
  struct Known {
    std::vector<Mode> modes;
    Sparse M;
    std::string why_not;  ///< they cannot be computed; empty: they can
  };
  const Known& known_at(double Omega);
  const Known& compute(double Omega);
  void follow_span(const std::vector<double>& speeds);
  std::vector<Known> followed(const std::vector<double>& speeds) const;
  Known between(double below, double above, double Omega) const;

  const Assembler& assembler_;
  const ModeFinder& finder_;
  std::size_t count_;
  bool is_large_;
  std::map<double, Known> known_;  ///< over speed
};

}  // namespace whirl::inline fe

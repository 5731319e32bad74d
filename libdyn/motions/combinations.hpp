#pragma once
/// Frequencies of a motion that are combinations of other ones.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"

namespace whirl::inline dyn {

/// A frequency that is a combination of others:
///
///   f = sum over terms of times * frequency
struct Combination {
  struct Term {
    int times = 0;
    double frequency = 0.0;  ///< signed [rad/s]

    static constexpr auto columns() {
      return ColumnList{column("times", &Term::times, "", "so many times"),
                        column("frequency", &Term::frequency, "rad/s", "signed frequency")};
    }
  };
  std::vector<Term> terms;  ///< the largest number of times first

  double frequency() const;
  /// The sum of all |times|.
  int order() const;
  /// "2 x 2377.2 - 4430.0", in rpm.
  std::string text() const;
};

/// The simplest combination of other frequencies that gives f, if there is any.
///
/// The simpler of two combinations has the lower order, or at the same order fewer terms. Among
/// enough combinations some meets any frequency by chance: the search ends where this would happen
/// to one frequency in twenty.
///
/// @param f          signed [rad/s]
/// @param others     signed, none of them near zero [rad/s]
/// @param tolerance  how far f may be from the combination [rad/s]
std::optional<Combination> combination_of(double f, std::span<const double> others,
                                          double tolerance);

}  // namespace whirl::inline dyn

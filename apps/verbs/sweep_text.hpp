#pragma once
/// A sweep for JSON and for people.

#include <string>

#include "libdyn/studies/sweep.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline cli {

/// One way of a sweep, in the order in which it went.
struct SweepWay {
  const SweepResult& sweep;
  const ParameterAxis& axis;
  std::size_t way = 0;  ///< 1: down

  std::size_t size() const { return axis.values.size(); }
  /// Number of the value that was the k-th.
  std::size_t value(std::size_t k) const { return way == 1 ? size() - 1 - k : k; }
  const std::optional<SweepPoint>& point(std::size_t k) const {
    return sweep.points[way * size() + value(k)];
  }
};

/// Entries of the values that are computed.
Record sweep_entries(const SweepWay& way);

/// Stretches of values with the same motion, for people.
std::string sweep_stretches(const SweepWay& way);

}  // namespace whirl::inline cli

#pragma once
/// Exact derivatives of revolutions by either of two parameters, anywhere in their plane.

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "libdyn/branches/range_slopes.hpp"

namespace whirl::inline dyn {

enum class PlaneParameter { first, second };

/// Ends of the range of a parameter.
struct ParameterEnds {
  double low = 0.0, high = 1.0;
};

/// The systems over a plane of two parameters p and q, whose numbers are interpolated along lines.
///
/// Most numbers are those of one parameter or a sum, c(p, q) = a(p) + b(q): slopes are then those
/// of one line each way, whose systems are made once. Otherwise, as for unbalance and speed, a line
/// is laid through every place, of five systems and more.
///
/// May be asked by several threads at once; what it says does not depend on who asked before.
class PlaneSlopes {
 public:
  using SceneAt = std::function<std::shared_ptr<const Scene>(double first, double second)>;

  /// @param at             the scene at two values within their ranges
  /// @param first, second  their ranges
  PlaneSlopes(SceneAt at, ParameterEnds first, ParameterEnds second)
      : at_(std::move(at)), ends_{first, second} {}

  /// The panel along a parameter that holds its value at a place; null: there is no slope, for the
  /// same reasons as along a range.
  std::shared_ptr<const SlopePanel> panel_at(PlaneParameter by, double first, double second) const;

 private:
  std::shared_ptr<const RangeSlopes> line(PlaneParameter by, double first, double second) const;
  /// Whether numbers are those of a sum, at some places.
  bool is_sum() const;

  SceneAt at_;
  std::array<ParameterEnds, 2> ends_;
  mutable std::mutex mutex_;
  mutable std::optional<bool> is_sum_{};  ///< once it is known
  mutable std::array<std::shared_ptr<const RangeSlopes>, 2> of_sum_{};
};

/// Where a depth comes nearest to zero with a rate of zero.
struct NearestGraze {
  static constexpr double none = 1e3;
  double depth = none;    ///< over the clearance: negative before a touch; none: it has no extremum
  std::size_t start = 0;  ///< number of the revolution
  double time = 0.0;      ///< since its start [s]
  int contact = 0;        ///< of ContactSystem::contacts()

  bool is_found() const { return depth != none; }
};

/// What is asked of a revolution; its end by the parameter always is.
struct RevolutionAsked {
  PlaneParameter by = PlaneParameter::first;
  bool by_start = false;
  Mat deviations{};                     ///< of the start, 2 n x any number
  const NearestGraze* graze = nullptr;  ///< in it
};

/// Derivatives of a revolution, its phases held.
struct RevolutionSlopes {
  Vec end;                               ///< of the end by the parameter
  std::vector<Mat> deviations_by_start;  ///< per deviation, of what it is at the end: 2 n x 2 n
  Mat deviations_by_parameter;           ///< 2 n x deviations
  Vec depth_by_start;                    ///< of NearestGraze::depth
  double depth_by_parameter = 0.0;
};

/// Derivatives of a revolution from phase 0 by its start and a parameter.
///
/// A depth has a rate of zero where it grazes: that its time moves changes nothing, and the slope
/// of the state there says that of the depth.
///
/// @param first  in whose basis states are told
/// @param panel  of the parameter, at its value
/// @return  nothing where motions have no derivative
std::optional<RevolutionSlopes> revolution_slopes(const Scene& scene, const Scene& first,
                                                  const SlopePanel& panel, double value,
                                                  const Vec& start, const RevolutionAsked& asked);

}  // namespace whirl::inline dyn

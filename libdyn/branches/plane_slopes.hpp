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

/// Systems over a plane of two parameters p and q, with their numbers interpolated along lines.
///
/// If every number is a sum c(p, q) = a(p) + b(q), as in most models, slopes come from one line
/// along each parameter, whose systems are made once. Otherwise, as for unbalance and speed, a line
/// of five systems or more is laid through every place.
///
/// Several threads may ask at once; an answer does not depend on who asked before.
class PlaneSlopes {
 public:
  using SceneAt = std::function<std::shared_ptr<const Scene>(double first, double second)>;

  /// @param at             the scene at two values within their ranges
  /// @param first, second  their ranges
  PlaneSlopes(SceneAt at, ParameterEnds first, ParameterEnds second)
      : at_(std::move(at)), ends_{first, second} {}

  /// The panel along a parameter that holds its value at a place; null: there is no slope, as of
  /// RangeSlopes without a model_at.
  std::shared_ptr<const SlopePanel> panel_at(PlaneParameter by, double first, double second) const;

 private:
  std::shared_ptr<const RangeSlopes> line(PlaneParameter by, double first, double second) const;
  /// Whether all numbers are such sums, compared at some places.
  bool is_sum() const;

  SceneAt at_;
  std::array<ParameterEnds, 2> ends_;
  mutable std::mutex mutex_;
  mutable std::optional<bool> is_sum_{};  ///< once it is known
  mutable std::array<std::shared_ptr<const RangeSlopes>, 2> of_sum_{};
};

/// Where the depth of a contact has the extremum nearest to zero.
struct NearestGraze {
  static constexpr double none = 1e3;
  double depth = none;    ///< over the clearance, < 0 without a touch; none: no extremum
  std::size_t start = 0;  ///< number of the revolution
  double time = 0.0;      ///< since the start of the revolution [s]
  int contact = 0;        ///< number in ContactSystem::contacts()

  bool is_found() const { return depth != none; }
};

/// What is asked of a revolution beside the derivative of its end by the parameter.
struct RevolutionAsked {
  PlaneParameter by = PlaneParameter::first;
  bool by_start = false;
  Mat deviations{};                     ///< of the start, 2 n x any number
  const NearestGraze* graze = nullptr;  ///< within the revolution; null: not asked
};

/// Derivatives of a revolution with the phases held.
struct RevolutionSlopes {
  Vec end;                               ///< of the end by the parameter
  std::vector<Mat> deviations_by_start;  ///< per deviation, of its value at the end: 2 n x 2 n
  Mat deviations_by_parameter;           ///< 2 n x deviations
  Vec depth_by_start;                    ///< of NearestGraze::depth
  double depth_by_parameter = 0.0;
};

/// Derivatives of a revolution from phase 0 by its start and a parameter.
///
/// The rate of a depth is zero where a contact grazes. That the instant of grazing moves changes
/// nothing, therefore, and the slope of the state at that instant gives the slope of the depth.
///
/// @param first  the scene in whose basis states are told
/// @param panel  of the parameter, at its value
/// @return  nothing where motions have no derivative
std::optional<RevolutionSlopes> revolution_slopes(const Scene& scene, const Scene& first,
                                                  const SlopePanel& panel, double value,
                                                  const Vec& start, const RevolutionAsked& asked);

}  // namespace whirl::inline dyn

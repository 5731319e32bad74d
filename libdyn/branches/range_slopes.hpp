#pragma once
/// Exact derivatives of motions by a parameter, anywhere in its range, from a few systems in it.

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "libdyn/system/scene.hpp"
#include "libdyn/system/system_slope.hpp"

namespace whirl::inline dyn {

/// A part of a parameter's range in which all numbers of a system are polynomials of it, to
/// rounding, of degree 2 or 8.
class SlopePanel {
 public:
  /// @param points   0 to 1, ascending
  /// @param systems  there
  SlopePanel(double low, double high, Vec points, const std::vector<ContactSystem>& systems);

  /// From a system at a point to the next: slopes of numbers that are straight lines between them.
  const std::vector<SystemSlope>& secants() const { return secants_; }
  /// What the secants weigh in a slope at a value, exactly where numbers are such polynomials.
  Vec weights(double value) const;

 private:
  double low_, high_;
  Vec points_;  ///< 0 to 1
  std::vector<SystemSlope> secants_;
};

/// The systems of branches, whose numbers are interpolated over the range of the parameter.
///
///   c(p) = sum_j l_j(p) c(p_j),   dc/dp = sum_k v_k(p) (c(p_k+1) - c(p_k)) / (p_k+1 - p_k)
///
/// p_j: three or nine Gauss points of a panel. It is checked at two more values that c is such a
/// polynomial to 2e-13; else panels are halved. A motion has a column for each of at most eight
/// secants, which take one pass, and the derivative of the motion is their sum with the weights v:
/// what depends on p is made once for all points of all branches.
///
/// There is no derivative where the parameter changes the shapes Phi that scenes move in, by a
/// single bit, where its numbers are no smooth function of it (as at the points of bearing tables),
/// where motion_slopes has none, and of Hertz contacts, blades and films, for which two plain motions are
/// several times cheaper.
///
/// May be asked by several threads at once; what it says does not depend on who asked before.
class RangeSlopes {
 public:
  using SceneAt = std::function<std::shared_ptr<const Scene>(double value)>;

  /// @param at     the scene at a value; asked between low and high
  /// @param first  whose shapes all of them move in
  RangeSlopes(SceneAt at, std::shared_ptr<const Scene> first, double low, double high)
      : at_(std::move(at)), first_(std::move(first)), low_(low), high_(high) {}

  /// The panel that holds a value, low to high; null: there is no slope.
  std::shared_ptr<const SlopePanel> panel_at(double value) const;

  /// Derivative by the parameter of where a motion ends, its start and the phases held.
  /// @param start        size 2 n
  /// @param revolutions  that it goes on for, any number above 0
  std::optional<Vec> end_slope(double value, const MotionState& start, double revolutions) const;

 private:
  struct Part {
    double low = 0.0, high = 0.0;
    std::shared_ptr<const SlopePanel> panel{};
    std::array<std::unique_ptr<Part>, 2> halves{};
    bool is_known = false;  ///< whether there is a panel
  };
  std::shared_ptr<const SlopePanel> panel_in(Part& part, double value, int depth) const;
  std::shared_ptr<const SlopePanel> made(double low, double high) const;
  /// Whether scenes move in the shapes of the first one, at two values of the range.
  bool keeps_shapes() const;
  /// @throws NumericalError, ModelError  where there is none, or none that moves in the first shapes
  std::shared_ptr<const Scene> scene_at(double value) const;

  SceneAt at_;
  std::shared_ptr<const Scene> first_;
  double low_, high_;
  mutable std::mutex mutex_;
  mutable std::optional<Part> whole_{};  ///< made when it is asked for
  mutable bool has_slopes_ = false;      ///< then: whether there can be any
};

}  // namespace whirl::inline dyn

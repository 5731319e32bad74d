#pragma once
/// Exact derivatives of motions by a parameter, anywhere in its range, from a few systems in it.

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "libdyn/orbits/harmonic_equations.hpp"
#include "libdyn/system/scene.hpp"
#include "libdyn/system/system_slope.hpp"
#include "libdyn/taylor/motion_slopes.hpp"

namespace whirl::inline dyn {

/// Tolerance of steps of motions whose slopes are wanted, small as impacts let errors grow.
inline constexpr double slope_tolerance = 1e-14;

/// A part of a parameter's range in which all numbers of a system are polynomials of the parameter
/// of degree 2 or 8, to rounding.
class SlopePanel {
 public:
  /// @param points   places in the panel, 0 to 1, ascending
  /// @param systems  at these points
  SlopePanel(double low, double high, Vec points, const std::vector<ContactSystem>& systems);

  /// Slopes of all numbers as straight lines from the system at each point to that at the next.
  const std::vector<SystemSlope>& secants() const { return secants_; }
  /// Weights of the secants in a slope at a value, exact where numbers are such polynomials.
  Vec weights(double value) const;

 private:
  double low_, high_;
  Vec points_;  ///< 0 to 1
  std::vector<SystemSlope> secants_;
};

/// A motion with its derivatives by the parameter of a panel at a value: by_parameter and
/// deviations_by_parameter have one column, the weighted sum over the secants.
/// @throws NumericalError  as motion_slopes for any parameters
MotionSlopes motion_slopes(const ContactSystem& system, const MotionState& start,
                           std::span<const double> times, const SlopePanel& panel, double value,
                           const SlopeOptions& options);

/// Systems along the parameter of branches, with their numbers interpolated over its range.
///
///   c(p) = sum_j l_j(p) c(p_j),   dc/dp = sum_k v_k(p) (c(p_k+1) - c(p_k)) / (p_k+1 - p_k)
///
/// p_j: three or nine Gauss points of a panel. Two more values show whether c is such a polynomial
/// to 2e-13 (2e-12 where shapes change); else the panel is halved. A motion has a column of slopes
/// for each of at most eight secants, which take one pass; the sum of these columns with the
/// weights v is the derivative of the motion. The systems of a panel are made once for all points
/// of all branches.
///
/// Where the parameter changes the shapes Phi that scenes move in, systems are told in the
/// coordinates of the first scene (BasisChange), in which numbers are smooth, whatever signs and
/// order shapes have. The derivative is that of the reduced equations, with what the parameter
/// changes in the shapes; its rounding is that of the shapes, which are solved for.
///
/// There is no derivative where numbers are no smooth function of the parameter (as at the points
/// of bearing tables, or where the number of modes changes). Motions have no derivative where
/// motion_slopes has none, and on oil films, for which a difference of two plain motions is nearly
/// twice as cheap.
///
/// Several threads may ask at once; an answer does not depend on who asked before.
class RangeSlopes {
 public:
  using SceneAt = std::function<std::shared_ptr<const Scene>(double value)>;
  using ModelAt = std::function<Model(double value)>;

  /// @param at        the scene at a value; asked between low and high
  /// @param first     the scene in whose coordinates all systems are told
  /// @param model_at  the model of the scene; null: there are no slopes where shapes change
  RangeSlopes(SceneAt at, std::shared_ptr<const Scene> first, double low, double high,
              ModelAt model_at = {})
      : at_(std::move(at)),
        model_at_(std::move(model_at)),
        first_(std::move(first)),
        low_(low),
        high_(high) {}

  /// The panel that holds a value, low to high; null: there is no slope.
  std::shared_ptr<const SlopePanel> panel_at(double value) const;

  /// Derivative of the end of a motion by the parameter, with the start and the phases held.
  /// @param start        size 2 n
  /// @param revolutions  length of the motion, any number above 0
  std::optional<Vec> end_slope(double value, const MotionState& start, double revolutions) const;

  /// Derivative by the parameter of the equations of harmonic balance at a value, as
  /// HarmonicEquations::slope takes it, in the coordinates of the scene there.
  std::optional<HarmonicProblem> problem_slope(double value) const;

 private:
  struct Part {
    double low = 0.0, high = 0.0;
    std::shared_ptr<const SlopePanel> panel{};
    double error = std::numeric_limits<double>::infinity();  ///< of the last polynomial tried
    std::array<std::unique_ptr<Part>, 2> halves{};
    bool is_known = false;  ///< whether it was tried to make a panel
  };
  /// @param error_of_whole  error of the part that this one is a half of
  std::shared_ptr<const SlopePanel> panel_in(Part& part, double value, int depth,
                                             double error_of_whole) const;
  /// Makes the panel of a part, if there can be one.
  void make(Part& part, double error_of_whole) const;
  /// Finds out, at two values of the range, whether there are systems in the coordinates of the
  /// first scene, and whether shapes change.
  void look() const;
  /// The system at a value, in the coordinates of the first scene.
  /// @throws NumericalError, ModelError  where there is no such system
  ContactSystem system_at(double value) const;

  SceneAt at_;
  ModelAt model_at_;
  std::shared_ptr<const Scene> first_;
  double low_, high_;
  mutable std::mutex mutex_;
  mutable std::optional<Part> whole_{};  ///< made when first asked for
  // known once whole_ is there:
  mutable bool has_slopes_ = false;   ///< whether there can be any slopes
  mutable bool is_reshaped_ = false;  ///< whether the parameter changes the shapes of scenes
};

}  // namespace whirl::inline dyn

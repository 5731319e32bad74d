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

/// Of steps of motions whose slopes are wanted: impacts let errors grow.
inline constexpr double slope_tolerance = 1e-14;

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

/// A motion with its derivatives by the parameter of a panel at a value: by_parameter and
/// deviations_by_parameter have one column, the sum of those of the secants.
/// @throws NumericalError  as of any parameters
MotionSlopes motion_slopes(const ContactSystem& system, const MotionState& start,
                           std::span<const double> times, const SlopePanel& panel, double value,
                           const SlopeOptions& options);

/// The systems of branches, whose numbers are interpolated over the range of the parameter.
///
///   c(p) = sum_j l_j(p) c(p_j),   dc/dp = sum_k v_k(p) (c(p_k+1) - c(p_k)) / (p_k+1 - p_k)
///
/// p_j: three or nine Gauss points of a panel. It is checked at two more values that c is such a
/// polynomial to 2e-13; else panels are halved. A motion has a column for each of at most eight
/// secants, which take one pass, and the derivative of the motion is their sum with the weights v:
/// what depends on p is made once for all points of all branches.
///
/// Where the parameter changes the shapes Phi that scenes move in, their systems are told in the
/// coordinates of the first scene (BasisChange), in which numbers are smooth, whatever signs and
/// order shapes have: the derivative is that of the reduced equations, what it changes in the
/// shapes included. It has the rounding of shapes, which are solved for.
///
/// There is no derivative where numbers are no smooth function of the parameter (as at the points
/// of bearing tables, or where the number of modes changes), and of motions where motion_slopes has
/// none, or on films, for which two plain motions are nearly twice as cheap.
///
/// May be asked by several threads at once; what it says does not depend on who asked before.
class RangeSlopes {
 public:
  using SceneAt = std::function<std::shared_ptr<const Scene>(double value)>;
  using ModelAt = std::function<Model(double value)>;

  /// @param at        the scene at a value; asked between low and high
  /// @param first     whose coordinates all of them are told in
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

  /// Derivative by the parameter of where a motion ends, its start and the phases held.
  /// @param start        size 2 n
  /// @param revolutions  that it goes on for, any number above 0
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
    bool is_known = false;  ///< whether there is a panel
  };
  /// @param error_of_whole  of the part that this is a half of
  std::shared_ptr<const SlopePanel> panel_in(Part& part, double value, int depth,
                                             double error_of_whole) const;
  /// Its panel, if it has one.
  void make(Part& part, double error_of_whole) const;
  /// Finds out, at two values of the range, whether there are systems in the coordinates of the
  /// first one, and whether shapes change.
  void look() const;
  /// In the coordinates of the first scene.
  /// @throws NumericalError, ModelError  where there is none
  ContactSystem system_at(double value) const;

  SceneAt at_;
  ModelAt model_at_;
  std::shared_ptr<const Scene> first_;
  double low_, high_;
  mutable std::mutex mutex_;
  mutable std::optional<Part> whole_{};  ///< made when it is asked for
  // then:
  mutable bool has_slopes_ = false;   ///< whether there can be any slopes
  mutable bool is_reshaped_ = false;  ///< whether the parameter changes the shapes of scenes
};

}  // namespace whirl::inline dyn

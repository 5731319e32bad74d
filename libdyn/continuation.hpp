#pragma once
/// Branches of periodic orbits along a parameter, round folds, stable or not.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "libdyn/orbit_equations.hpp"
#include "libfe/base/field.hpp"

namespace whirl {

enum class BifurcationKind { fold, period_doubling, neimark_sacker, pitchfork, grazing };
constexpr auto choices(BifurcationKind) {
  return std::array{Choice<BifurcationKind>{"fold", BifurcationKind::fold},
                    Choice<BifurcationKind>{"period-doubling", BifurcationKind::period_doubling},
                    Choice<BifurcationKind>{"neimark-sacker", BifurcationKind::neimark_sacker},
                    Choice<BifurcationKind>{"pitchfork", BifurcationKind::pitchfork},
                    Choice<BifurcationKind>{"grazing", BifurcationKind::grazing}};
}

struct ContinuationOptions {
  double low = 0.0, high = 1.0;  ///< range of the parameter, where a branch ends
  double first = 0.0;            ///< value at the start, within it
  double direction = 1.0;        ///< in which the parameter goes at the start: 1 or -1
  double largest_step = 0.0;     ///< of the parameter; 0: a hundredth of the range
  double smallest_step = 1e-9;   ///< of the arc length; what needs a shorter one ends the branch
  double located = 1e-9;         ///< of the range, to which bifurcations are located
  int period = 1;                ///< of the orbits [revolutions]; a segment each
  int most_points = 10000;

  /// @throws NumericalError  if a number is outside of what it may be
  void check() const;
  double range() const { return high - low; }
};

/// An orbit of a branch, and how the branch goes on from it.
struct BranchPoint {
  double value = 0.0;  ///< of the parameter
  Vec z;  ///< unknowns of the orbit (states of all segments) [scales], then the parameter, 0 at
          ///< low and 1 at high
  Vec tangent;        ///< to the branch, of length 1 in its metric
  double step = 0.0;  ///< of the arc length, to the next point
  CVec multipliers;   ///< the largest first; empty: start of a branch that is switched to
  double residual = 0.0;
  std::vector<ContactMeasure> contacts;  ///< shares of the period

  bool is_stable() const {
    return multipliers.size() > 0 && multipliers.cwiseAbs().maxCoeff() < 1.0;
  }
  /// State at phase 0 of revolution i of the period, if these are the unknowns.
  Vec state(const Vec& scale, int i = 0) const {
    return scale.cwiseProduct(z.segment(i * scale.size(), scale.size()));
  }
};

struct Bifurcation {
  BifurcationKind kind = BifurcationKind::fold;
  BranchPoint at;
  std::size_t after = 0;    ///< number of the point before it
  std::string contact;      ///< of a grazing: which
  double change = 0.0;      ///< of a grazing: in its impacts a period, along the branch
  Complex multiplier{1.0};  ///< the critical one; of a grazing NaN
};

struct Branch {
  int period = 1;
  std::vector<BranchPoint> points;
  std::vector<Bifurcation> bifurcations;  ///< in the order of the branch
  std::string end;                        ///< why it ended; empty: it goes on
};

/// Walks along a branch by pseudo-arclength.
///
///   r(z) = 0,  <t, z - z_predicted> = 0,   z = (x, u)
///   <a, b> = mean of a_i b_i over the unknowns x + a_u b_u
///
/// Newton's method corrects what the tangent t predicts. The derivative by the parameter is a central
/// difference of two further evaluations at each point. Steps follow the number of corrections and the
/// angle between tangents; where none converges they shrink. Bifurcations between two points show
/// by the signs of test functions (see bifurcation.hpp) or by other numbers of impacts; they are
/// located by solving for the point where that happens.
///
/// All that the walk depends on is in the branch: one that is read back goes on with the same numbers,
/// bit by bit.
///
/// @source [Keller1977]; [Kuznetsov2004], 10.2
class Continuation {
 public:
  /// Starts from an orbit near a start at the first value.
  /// @throws NumericalError  if there is none, or no tangent
  Continuation(FlowAt flow_at, const Vec& start, const ContinuationOptions& options);
  /// Goes on with a branch of at least one point.
  /// @param scale  of the states of its points
  Continuation(FlowAt flow_at, Vec scale, Branch branch, const ContinuationOptions& options);
  /// Both for other equations.
  /// @param x  their solution at the first value
  Continuation(OrbitEquations equations, const Vec& x, const ContinuationOptions& options);
  Continuation(OrbitEquations equations, Branch branch, const ContinuationOptions& options);

  /// Adds a point, and the bifurcations on the way to it; false: the branch has ended.
  bool advance();

  const Branch& branch() const { return branch_; }
  const Vec& scale() const { return scale_; }

 private:
  struct Trial {
    BranchPoint point;
    int corrections = 0;
    bool is_outside = false;  ///< of the range
    std::string failure;
    Mat jacobian;
  };
  /// What holds z in the corrector: <normal, z - at> = 0.
  struct Plane {
    Vec normal, at;
  };

  double value_of(double u) const;
  double dot(const Vec& a, const Vec& b) const;
  OrbitEquations::Evaluation evaluate(const Vec& z, Tangents wanted) const;
  void set_weights(Eigen::Index size);
  /// The first point, where the equations are solved.
  void begin(const Vec& x, double residual, const OrbitEquations::Evaluation& there);
  Vec derivative_by_parameter(const Vec& z) const;
  Trial correct(const Plane& plane, Vec by_parameter) const;
  /// Tangent at a point of the branch, and the derivative by the parameter.
  bool add_tangent(Trial& trial, const Vec& along, Vec& by_parameter) const;
  /// False: one of them could not be located.
  bool find_bifurcations(const BranchPoint& a, const BranchPoint& b);
  /// The point between two at an arc length from the first.
  Trial between(const BranchPoint& a, const BranchPoint& b, double length) const;
  bool locate(BifurcationKind kind, const BranchPoint& a, const BranchPoint& b);
  bool locate_grazings(const BranchPoint& a, const BranchPoint& b);
  /// Says why a branch ends where no step succeeds; a grazing ahead is looked for.
  void end_at_failure(const std::string& why);
  double limited(double step, const Vec& tangent) const;

  OrbitEquations equations_;
  ContinuationOptions options_;
  Vec scale_;  ///< of states, if these are the unknowns
  Branch branch_;
  Vec by_parameter_;  ///< derivative of the residual at the last point
  Vec weights_;
};

}  // namespace whirl

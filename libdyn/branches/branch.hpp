#pragma once
/// A branch of periodic motions along a parameter: its equations, its points, where it changes.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/orbits/shooting.hpp"

namespace whirl::inline dyn {

/// Equations for the unknowns x of a motion at a value of the parameter, as many as unknowns.
struct BranchEquations {
  struct Value {
    Vec residual;                          ///< of all equations, in scales; empty: they failed
    Mat jacobian;                          ///< by x, if it is wanted
    std::vector<ContactMeasure> contacts;  ///< shares of the period
    std::function<CVec()> multipliers;     ///< the largest first; likewise, where the residual is 0
    /// Derivative of the residual by the parameter's value at fixed x, exact; likewise. A null
    /// function, an empty value or a NumericalError: it is not known, and taken as a difference.
    std::function<Vec()> slope;
    Failure failure;
  };
  std::function<Value(const Vec& x, double value, WithTangent wanted)> at;
  double difference = 3e-6;  ///< of the parameter's range, for the derivative by it
};

enum class BifurcationKind { fold, period_doubling, neimark_sacker, pitchfork, grazing };
constexpr auto choices(BifurcationKind) {
  return std::array{Choice<BifurcationKind>{"fold", BifurcationKind::fold},
                    Choice<BifurcationKind>{"period-doubling", BifurcationKind::period_doubling},
                    Choice<BifurcationKind>{"neimark-sacker", BifurcationKind::neimark_sacker},
                    Choice<BifurcationKind>{"pitchfork", BifurcationKind::pitchfork},
                    Choice<BifurcationKind>{"grazing", BifurcationKind::grazing}};
}

/// A motion of a branch, and how the branch goes on from it.
struct BranchPoint {
  double value = 0.0;  ///< of the parameter
  Vec z;               ///< unknowns [scales], then the parameter, 0 at low and 1 at high
  Vec tangent;         ///< to the branch, of length 1 in its metric
  double step = 0.0;   ///< of the arc length, to the next point
  CVec multipliers;    ///< the largest first; empty: start of a branch that is switched to
  double residual = 0.0;
  std::vector<ContactMeasure> contacts;  ///< shares of the period

  bool is_stable() const {
    return multipliers.size() > 0 && multipliers.cwiseAbs().maxCoeff() < 1.0;
  }
  /// State at phase 0 of revolution i of the period.
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

/// What makes a branch end.
enum class EndKind {
  range,          ///< the end of the parameter's range
  closed,         ///< the first orbit again
  period_halved,  ///< its orbits come to repeat after half their period
  most_points,    ///< as many as asked for
  grazing,        ///< a contact touches otherwise from there on, and no orbit is found
  no_orbit,       ///< none is found, for another reason
  no_start,       ///< its first point could not be found
  untold          ///< a sentence in a file that does not say which
};
constexpr auto choices(EndKind) {
  return std::array{Choice<EndKind>{"range", EndKind::range},
                    Choice<EndKind>{"closed", EndKind::closed},
                    Choice<EndKind>{"period-halved", EndKind::period_halved},
                    Choice<EndKind>{"most-points", EndKind::most_points},
                    Choice<EndKind>{"grazing", EndKind::grazing},
                    Choice<EndKind>{"no-orbit", EndKind::no_orbit},
                    Choice<EndKind>{"no-start", EndKind::no_start},
                    Choice<EndKind>{"untold", EndKind::untold}};
}

/// The end of a branch.
struct BranchEnd {
  EndKind kind = EndKind::untold;
  std::string text;      ///< the whole sentence
  std::string reason{};  ///< of no_orbit: what failed there
};

struct Branch {
  int period = 1;
  std::vector<BranchPoint> points;
  std::vector<Bifurcation> bifurcations;  ///< in the order of the branch
  std::optional<BranchEnd> end;           ///< none: it goes on

  bool ends_as(EndKind kind) const { return end && end->kind == kind; }
  /// Why it ends, as a sentence; empty while it goes on.
  std::string end_text() const { return end ? end->text : ""; }
};

}  // namespace whirl::inline dyn

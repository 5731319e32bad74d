#pragma once
/// A branch of periodic motions along a parameter: its equations, points, bifurcations and end.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/orbits/shooting.hpp"

namespace whirl::inline dyn {

/// Equations of a motion at a value of the parameter, as many as there are unknowns x.
struct BranchEquations {
  struct Value {
    Vec residual;                          ///< of all equations, in scales; empty: see failure
    Mat jacobian;                          ///< of the residual by x, if wanted
    std::vector<ContactMeasure> contacts;  ///< shares of the period
    std::function<CVec()> multipliers;     ///< of a solution, largest first; set with the jacobian
    /// Exact derivative of the residual by the parameter's value at fixed x, if the jacobian is
    /// wanted. A null function, an empty value or a NumericalError: the derivative is not known,
    /// and a difference takes its place.
    std::function<Vec()> slope;
    Failure failure;
  };
  std::function<Value(const Vec& x, double value, WithTangent wanted)> at;
  double difference = 3e-6;  ///< step of a difference by the parameter, over its range
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
  double step = 0.0;   ///< arc length to the next point
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
  std::string contact;      ///< that grazes; of a grazing only
  double change = 0.0;      ///< of a grazing: of its contact's impacts a period
  Complex multiplier{1.0};  ///< the critical one; of a grazing NaN
};

/// What makes a branch end.
enum class EndKind {
  range,          ///< the end of the parameter's range
  closed,         ///< the branch comes back to its first orbit
  period_halved,  ///< the orbits repeat after half their period from there on
  most_points,    ///< the branch has as many points as asked for
  grazing,        ///< a contact grazes, and no orbit is found beyond
  no_orbit,       ///< no orbit is found, for another reason
  no_start,       ///< the first point of the branch was not found
  untold          ///< the kind is not known: the file has a sentence only
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
  std::optional<BranchEnd> end;           ///< nothing: the branch goes on

  bool ends_as(EndKind kind) const { return end && end->kind == kind; }
  /// Why the branch ends, as a sentence; empty while the branch goes on.
  std::string end_text() const { return end ? end->text : ""; }
};

}  // namespace whirl::inline dyn

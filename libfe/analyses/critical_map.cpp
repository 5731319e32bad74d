#include "libfe/analyses/critical_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/roots.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/shape_branches.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

constexpr double alike = 1e-3;       ///< relative difference of stiffnesses that count as one
constexpr double same_curve = 1e-9;  ///< likewise of curves, which would lie on each other
constexpr int curve_points = 200;    ///< steps of speed of a curve
constexpr double crossing_tolerance = 1e-10;  ///< of log10 of a stiffness
constexpr int most_criticals = 1000;          ///< below the top, before something is wrong

/// Whether the map gives a bearing another stiffness: one with no end on the shaft, or on a body
/// that spins, belongs to the foundation, which stays as it is. A rotor may be bodies alone.
bool is_swept(const Structure& s, const Connection& b) {
  const auto is_rotor = [&](const Station& station) {
    if (station.kind != Station::Kind::body) return station.kind != Station::Kind::ground;
    return std::any_of(s.bodies.begin(), s.bodies.end(),
                       [&](const Body& body) { return body.name == station.body && body.spins; });
  };
  if (b.is_rigid || b.is_clamped) return false;
  return s.shaft.empty() || is_rotor(b.from) || is_rotor(b.to);
}

/// Stiffness of a linearized connection at a speed; NaN where it has none.
Mat2 film_stiffness(const LinearizedConnection& film, double Omega) {
  try {
    return film.at(Omega, Omega).K;
  } catch (const NumericalError&) {
    return Mat2::Constant(std::nan(""));
  }
}

/// The structure without damping, its bearings as they are at rest. Linearized connections become
/// bearings, whose stiffness the map gives.
Structure undamped(Structure s) {
  for (const LinearizedConnection& film : s.linearized) {
    BearingCoefficients any;
    any.K = Mat2::Identity();
    s.bearings.push_back({.name = film.name,
                          .from = film.from,
                          .to = film.to,
                          .coefficients = constant_bearing(any)});
  }
  s.linearized.clear();
  for (auto* list : {&s.bearings, &s.links, &s.seals}) {
    for (Connection& c : *list) {
      BearingCoefficients at_rest = coefficients(c.coefficients, 0.0);
      at_rest.C = at_rest.Ct = Mat2::Zero();
      c.coefficients = constant_bearing(at_rest);
    }
  }
  const auto release = [](auto& part) {
    part.material.eta = 0.0;
    part.damping = {};
  };
  for (Segment& segment : s.shaft) release(segment);
  for (Rotor& rotor : s.rotors) {
    for (Segment& segment : rotor.shaft) release(segment);
  }
  for (Layer& layer : s.layers) release(layer);
  s.damping = {};
  s.modal_damping = {};
  return s;
}

/// Stiffnesses of the bearings, and how the map goes over them.
struct StiffnessRange {
  bool is_common = true;
  double first = 0.0, last = 0.0;  ///< of x; first = 0: no bearing has a stiffness
};

StiffnessRange range_of(const Structure& s, const CriticalMapOptions& options) {
  double softest = INFINITY, stiffest = 0.0, first = 0.0;
  bool is_variable = !s.linearized.empty(), is_same = true;
  const auto widen = [&](const Mat2& K) {
    for (const double k : {K(0, 0), K(1, 1)}) {
      if (!(k > 0.0)) continue;
      softest = std::min(softest, k);
      stiffest = std::max(stiffest, k);
    }
  };
  for (const LinearizedConnection& film : s.linearized) {
    for (const double Omega : options.film_speeds) widen(film_stiffness(film, Omega));
  }
  for (const Connection& b : s.bearings) {
    if (!is_swept(s, b)) continue;
    const auto told = told_speeds(b.coefficients), whirls = told_whirls(b.coefficients);
    std::vector<double> speeds(told.begin(), told.end());
    speeds.insert(speeds.end(), whirls.begin(), whirls.end());
    if (speeds.empty()) speeds.push_back(0.0);
    for (const double Omega : speeds) widen(coefficients(b.coefficients, Omega).K);
    const double k = coefficients(b.coefficients, 0.0).K(0, 0);
    if (first == 0.0) first = k;
    is_same = is_same && std::abs(k - first) <= alike * std::abs(first);
    is_variable = is_variable || depends_on_speed(b.coefficients);
  }
  if (!(stiffest > 0.0)) return {};
  if (is_variable || is_same) {
    return {true, softest / options.beyond, stiffest * options.beyond};
  }
  return {false, 1.0 / options.beyond, options.beyond};
}

/// Critical speeds of a structure whose bearings have another stiffness.
class Criticals {
 public:
  Criticals(const Structure& structure, bool is_common, double order)
      : structure_(undamped(structure)), is_common_(is_common), order_(order) {}

  /// @param x  stiffness [N/m], or factor
  System system(double x) const {
    Structure s = structure_;
    for (Connection& b : s.bearings) {
      if (!is_swept(structure_, b)) continue;
      BearingCoefficients c = coefficients(b.coefficients, 0.0);
      c.K = is_common_ ? Mat2(Mat2::Identity() * x) : Mat2(x * c.K);
      b.coefficients = constant_bearing(c);
    }
    return Assembler(s).at(0.0);
  }

  std::vector<ShapedValue> lowest(double x, int count) const {
    std::vector<ShapedValue> found;
    for (Critical& c : undamped_criticals(system(x), {.count = count, .order = order_})) {
      found.push_back({c.speed, std::move(c.shape)});
    }
    return found;
  }

  /// How many there are at x up to a speed, with one above it where there is one.
  int count_up_to(double speed, double x, int guess) const {
    for (int count = guess;; count *= 2) {
      const auto found = lowest(x, count);
      const bool is_all = static_cast<int>(found.size()) < count;
      if (is_all || found.back().value > speed || count >= most_criticals) return count;
    }
  }

 private:
  Structure structure_;
  bool is_common_;
  double order_;
};

/// Logarithms of numbers at equal ratios.
std::vector<double> logarithms(double first, double last, int per_decade) {
  const double decades = std::log10(last / first);
  const int steps = std::max(1, static_cast<int>(std::ceil(per_decade * decades)));
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k) values.push_back(std::log10(first) + decades * k / steps);
  return values;
}

/// What is found at the first of some places where anything is, and the place.
struct FirstFound {
  double at = 0.0;
  std::vector<ShapedValue> found;
};

std::optional<FirstFound> first_found(const std::vector<double>& places, const SolveShapes& solve) {
  for (const double at : places) {
    try {
      auto found = solve(at);
      if (!found.empty()) return FirstFound{at, std::move(found)};
    } catch (const NumericalError&) {
      continue;  // told by the walk along the map
    } catch (const ModelError&) {
      continue;
    }
  }
  return {};
}

/// A stiffness over speed, of both directions.
using StiffnessOverSpeed = std::function<Mat2(double Omega)>;

/// Stiffness of all connections that the map gives another one, by name.
std::vector<std::pair<std::string, StiffnessOverSpeed>> flexible_connections(const Structure& s) {
  std::vector<std::pair<std::string, StiffnessOverSpeed>> all;
  for (const Connection& b : s.bearings) {
    if (!is_swept(s, b)) continue;
    all.emplace_back(
        b.name, [c = b.coefficients](double Omega) -> Mat2 { return coefficients(c, Omega).K; });
  }
  for (const LinearizedConnection& film : s.linearized) {
    all.emplace_back(film.name, [film](double Omega) { return film_stiffness(film, Omega); });
  }
  return all;
}

/// A curve of the map, at every speed: the samples that it shows are beside it.
struct OwnStiffness {
  StiffnessCurve curve;
  std::function<double(double Omega)> at;  ///< [N/m]; NaN where an oil film has none
  std::vector<std::string> bearings, directions;

  /// Whether it has the samples of this one, too.
  bool has(const std::vector<double>& stiffness) const {
    return std::equal(stiffness.begin(), stiffness.end(), curve.stiffness.begin(),
                      [](double a, double b) {
                        return std::isfinite(a) == std::isfinite(b) &&
                               !(std::abs(a - b) > same_curve * std::abs(a));
                      });
  }
};

/// One for every stiffness that is not like another one at these speeds [rad/s].
std::vector<OwnStiffness> own_stiffnesses(const Structure& s, const std::vector<double>& speeds) {
  const auto add = [](std::vector<std::string>& list, const std::string& name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  };
  std::vector<OwnStiffness> all;
  const auto flexible = flexible_connections(s);
  for (const auto& [name, stiffness] : flexible) {
    for (const Eigen::Index direction : {0, 1}) {
      OwnStiffness one{{}, [of = stiffness, direction](double Omega) {
                         return of(Omega)(direction, direction);
                       }};
      for (const double Omega : speeds) one.curve.stiffness.push_back(one.at(Omega));
      auto like = std::find_if(all.begin(), all.end(), [&](const OwnStiffness& known) {
        return known.has(one.curve.stiffness);
      });
      if (like == all.end()) like = all.insert(all.end(), std::move(one));
      add(like->bearings, name);
      add(like->directions, direction == 0 ? "Kxx" : "Kyy");
    }
  }
  for (OwnStiffness& one : all) {
    one.curve.name = fmt::format("{}", fmt::join(one.directions, ", "));
    if (one.bearings.size() < flexible.size()) {
      one.curve.name += fmt::format(" of {}", fmt::join(one.bearings, ", "));
    }
  }
  return all;
}

/// The critical speed at log10 of a stiffness, on a branch between two of its points.
double speed_between(const ShapeBranch& branch, std::size_t i, double at, const SolveShapes& solve,
                     const Sparse& W) {
  const ShapedValue &left = branch.found[i], &right = branch.found[i + 1];
  const double share = (at - branch.at[i]) / (branch.at[i + 1] - branch.at[i]);
  if (share <= 0.0) return left.value;
  if (share >= 1.0) return right.value;
  const double expected = left.value * std::pow(right.value / left.value, share);
  double best = -INFINITY, speed = std::nan("");
  for (const ShapedValue& found : solve(at)) {
    const double score =
        std::max(mac(found.shape, left.shape, W), mac(found.shape, right.shape, W)) -
        std::abs(found.value - expected) / (right.value - left.value + 1e-3 * expected);
    if (score > best) best = score, speed = found.value;
  }
  return speed;
}

void add_crossings(CriticalMap& map, const std::vector<OwnStiffness>& curves,
                   const std::vector<ShapeBranch>& branches, const SolveShapes& solve,
                   const Sparse& W) {
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const auto gap = [&](double at, double speed) {
      const double k = curves[c].at(speed);
      return k > 0.0 ? std::log10(k) - at : std::nan("");
    };
    for (std::size_t b = 0; b < branches.size(); ++b) {
      const ShapeBranch& branch = branches[b];
      for (std::size_t i = 0; i + 1 < branch.at.size(); ++i) {
        const double before = gap(branch.at[i], branch.found[i].value);
        const double after = gap(branch.at[i + 1], branch.found[i + 1].value);
        if (!(before * after <= 0.0) || before == 0.0) continue;
        const auto speed = [&](double at) {
          try {
            return speed_between(branch, i, at, solve, W);
          } catch (const NumericalError&) {
            return std::nan("");
          }
        };
        const double at = bracketed_root([&](double x) { return gap(x, speed(x)); }, branch.at[i],
                                         branch.at[i + 1], crossing_tolerance);
        if (!std::isfinite(at)) continue;
        map.crossings.push_back({c, b, std::pow(10.0, at), speed(at)});
      }
    }
  }
}

Whirl usual_sense(const ShapeBranch& branch, const DofMap& dofs) {
  std::vector<Whirl> seen;
  for (const ShapedValue& found : branch.found) seen.push_back(whirl_of(orbits(dofs, found.shape)));
  return most_frequent(seen);
}

/// Branches over all values of x at which any of them was found.
void add_branches(CriticalMap& map, const std::vector<ShapeBranch>& branches, const DofMap& dofs) {
  std::vector<double> all;
  for (const ShapeBranch& b : branches) all.insert(all.end(), b.at.begin(), b.at.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (const double at : all) map.x.push_back(std::pow(10.0, at));
  for (const ShapeBranch& b : branches) {
    CriticalMapBranch branch{usual_sense(b, dofs), std::vector<double>(all.size(), std::nan(""))};
    for (std::size_t i = 0; i < b.at.size(); ++i) {
      const auto place = std::lower_bound(all.begin(), all.end(), b.at[i]) - all.begin();
      branch.speed[static_cast<std::size_t>(place)] = b.found[i].value;
    }
    map.branches.push_back(std::move(branch));
  }
}

}  // namespace

CriticalMap critical_map(const Structure& given, const CriticalMapOptions& options) {
  CriticalMap map;
  Structure structure = given;
  if (options.film_speeds.empty()) structure.linearized.clear();
  const StiffnessRange range = range_of(structure, options);
  if (!(range.first > 0.0)) return map;
  map.is_common = range.is_common;
  for (const auto& swept : flexible_connections(structure)) {
    if (!map.swept.empty()) map.swept += ", ";
    map.swept += swept.first;
  }
  const Criticals criticals(structure, range.is_common, options.critical.order);
  int count = options.critical.count;
  const SolveShapes solve = [&](double at) { return criticals.lowest(std::pow(10.0, at), count); };

  // the picture's top are the stiffest bearings; below it nothing is left out at any stiffness
  const std::vector<double> at = logarithms(range.first, range.last, options.steps_per_decade);
  const auto stiff = first_found({at.rbegin(), at.rend()}, solve);
  const auto soft = first_found(at, solve);
  if (!stiff || !soft) {
    for (const ShapeGap& gap : follow_shapes(at, solve, Sparse(), 0.0).gaps) {
      map.gaps.push_back({gap.at, gap.reason});
    }
    return map;
  }
  map.top = stiff->found.back().value;
  const double step = at[1] - at[0];
  const double headroom = std::pow(10.0, 0.5 * step);  // speeds rise by the root of the stiffness
  count = criticals.count_up_to(headroom * map.top, std::pow(10.0, soft->at), count) + 2;

  const System system = criticals.system(std::pow(10.0, soft->at));
  ShapeBranches followed = follow_shapes(at, solve, system.M, map.top);
  std::erase_if(followed.branches,
                [&](const ShapeBranch& b) { return b.found.front().value > map.top; });
  add_branches(map, followed.branches, system.dofs);
  for (ShapeGap& gap : followed.gaps) {
    map.gaps.push_back({std::pow(10.0, gap.at), std::move(gap.reason)});
  }
  if (!map.is_common || map.branches.empty()) return map;
  double low = map.top;
  for (const ShapeBranch& b : followed.branches) low = std::min(low, b.found.front().value);
  for (int k = 0; k <= curve_points; ++k) {
    map.curve_speeds.push_back(low *
                               std::pow(map.top / low, static_cast<double>(k) / curve_points));
  }
  std::vector<OwnStiffness> curves = own_stiffnesses(structure, map.curve_speeds);
  add_crossings(map, curves, followed.branches, solve, system.M);
  for (OwnStiffness& one : curves) map.curves.push_back(std::move(one.curve));
  return map;
}

CriticalMap critical_map_of(const Structure& structure, const CriticalSpeeds& found) {
  // the map has speeds in proportion to the first one
  if (structure.rotor_of_own_speed()) return {};
  CriticalMapOptions options;
  options.critical.order = found.order;
  for (const Critical& c : found.criticals) {
    if (c.order == found.order) options.film_speeds.push_back(c.speed);
  }
  if (options.film_speeds.empty()) return {};
  options.critical.count = static_cast<int>(options.film_speeds.size());
  return critical_map(structure, options);
}

}  // namespace whirl::inline fe

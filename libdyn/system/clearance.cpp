#include "libdyn/system/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/numerics/roots.hpp"
#include "libbase/structs/names.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/unbalance.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int moments = 720;  ///< of a period; the largest distance is right to 1e-5
constexpr double clearance_tolerance = 1e-9;  ///< of the ends of a range, relative

/// The largest of what is a distance at every place of an orbit.
template <class Distance>
double largest_in_period(Complex x, Complex y, const Distance& distance) {
  double largest = 0.0;
  for (int i = 0; i < moments; ++i) {
    const Complex turn = std::polar(1.0, 2.0 * std::numbers::pi * i / moments);
    largest = std::max(largest, distance(Vec2((x * turn).real(), (y * turn).real())));
  }
  return largest;
}

/// The largest distance in a period of an orbit from a point.
double farthest(Complex x, Complex y, const Vec2& from) {
  if (from.isZero(0.0)) return Orbit(x, y).major();
  return largest_in_period(x, y, [&](const Vec2& u) { return (u - from).norm(); });
}

/// Motion of one point less that of another.
template <class Vector>
auto relative(const Vector& full, const DofMap& dofs, const Point& at, const Point& against,
              int component) {
  using Number = typename Vector::Scalar;
  const int a = dofs.full_index(at, component), b = dofs.full_index(against, component);
  return (a >= 0 ? full(a) : Number()) - (b >= 0 ? full(b) : Number());
}

/// A clearance, and how much of it the rotor takes.
struct Gap {
  std::string name;
  double clearance = 0.0;
  Vec2 offset = Vec2::Zero();
  AnyGeometry geometry;
  Point at, against;

  int first() const { return closing_of(geometry) == Closing::tilts ? THETA_X : X; }

  /// The largest distance in a period.
  /// @param full  complex amplitudes of the full vector
  double distance(const CVec& full, const DofMap& dofs) const {
    const Complex x = relative(full, dofs, at, against, first()),
                  y = relative(full, dofs, at, against, first() + 1);
    if (const auto n = direction_of(geometry)) {
      return std::abs((*n)(0) * x + (*n)(1) * y) - n->dot(offset);
    }
    if (!is_wall(geometry)) return arm_of(geometry) * farthest(x, y, offset);
    return largest_in_period(x, y, [&](const Vec2& motion) { return distance_of(motion); });
  }

  /// The distance at one instant, of the motion that closes the clearance.
  double distance_of(const Vec2& motion) const {
    return arm_of(geometry) * whirl::distance_of(geometry, clearance, motion - offset);
  }

  /// The distance of a rotor at rest.
  double distance_at_rest(const Vec& full, const DofMap& dofs) const {
    return distance_of({relative(full, dofs, at, against, first()),
                        relative(full, dofs, at, against, first() + 1)});
  }
};

std::vector<Gap> gaps_of(const Model& model, const Assembler& assembler) {
  std::vector<Gap> gaps;
  for (const Contact& c : model.contacts) {
    if (!is_with_stator(c)) continue;
    gaps.push_back({named("contact", c.name), c.clearance, c.offset, geometry_of(c),
                    assembler.point(c.at), assembler.point(c.against)});
  }
  const auto add = [&](std::string_view kind, const std::vector<Connection>& list) {
    for (const Connection& c : list) {
      if (!(c.clearance > 0.0)) continue;
      gaps.push_back({named(kind, c.name), c.clearance, Vec2::Zero(), geometry::Ring{},
                      assembler.point(c.from), assembler.point(c.to)});
    }
  };
  add("bearing", model.structure.bearings);
  add("seal", model.structure.seals);
  for (const OilFilm& film : model.films) {
    gaps.push_back({named("oil film", film.name), film.bearing.clearance, film.offset,
                    geometry::Ring{}, assembler.point(film.at), assembler.point(film.against)});
  }
  return gaps;
}

}  // namespace

std::vector<RunningClearance> running_clearances(const Model& model, const Assembler& assembler,
                                                 const Vec& displacement) {
  std::vector<RunningClearance> all;
  for (const Gap& gap : gaps_of(model, assembler)) {
    all.push_back({gap.name, gap.clearance, gap.distance_at_rest(displacement, assembler.dofs())});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.left() < b.left(); });
  return all;
}

std::vector<RunningClearance> largest_distances(const Model& model, const Assembler& assembler,
                                                const Mat& basis, const Mat& coordinates) {
  const DofMap& dofs = assembler.dofs();
  std::vector<RunningClearance> all;
  for (const Gap& gap : gaps_of(model, assembler)) {
    Mat rows = Mat::Zero(2, basis.cols());
    for (const int side : {0, 1}) {
      for (int axis = 0; axis < 2; ++axis) {
        const int i = dofs.full_index(side == 0 ? gap.at : gap.against, gap.first() + axis);
        if (i >= 0) rows.row(axis) += (side == 0 ? 1.0 : -1.0) * basis.row(i);
      }
    }
    const Mat motion = rows * coordinates;
    double largest = -INFINITY;
    for (Eigen::Index k = 0; k < motion.cols(); ++k) {
      largest = std::max(largest, gap.distance_of(motion.col(k)));
    }
    all.push_back({gap.name, gap.clearance, largest});
  }
  return all;
}

std::vector<ClearanceUse> clearance_uses(const Model& model, const Assembler& assembler,
                                         const std::vector<double>& speeds,
                                         const Excitation* load) {
  UnbalanceSolver solver = load ? UnbalanceSolver(assembler, *load) : UnbalanceSolver(assembler);
  const DofMap dofs = solver.dofs();
  const std::vector<Gap> gaps = gaps_of(model, assembler);
  std::vector<ClearanceUse> uses;
  for (const Gap& gap : gaps) uses.push_back({.name = gap.name, .clearance = gap.clearance});
  if (gaps.empty()) return uses;
  std::vector<double> before(gaps.size(), -1.0);  // what was missing or too much at the last speed
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    const auto full = solver.at(speeds[s]);
    for (std::size_t i = 0; i < gaps.size() && full; ++i) {
      const double distance = gaps[i].distance(*full, dofs), excess = distance - gaps[i].clearance;
      ClearanceUse& use = uses[i];
      if (distance > use.largest) use.largest = distance, use.at = speeds[s];
      double border = speeds[s];
      if (s > 0 && (excess > 0.0) != (before[i] > 0.0)) {
        const double root = bracketed_root(
            [&](double Omega) {
              const auto there = solver.at(Omega);
              return there ? gaps[i].distance(*there, dofs) - gaps[i].clearance : INFINITY;
            },
            speeds[s - 1], speeds[s], clearance_tolerance * speeds[s]);
        if (std::isfinite(root)) border = root;
      }
      if (excess > 0.0 && before[i] <= 0.0) use.beyond.push_back({border, speeds[s]});
      if (excess > 0.0) use.beyond.back().last = speeds[s];
      if (excess <= 0.0 && before[i] > 0.0) use.beyond.back().last = border;
      before[i] = excess;
    }
  }
  return uses;
}

}  // namespace whirl::inline dyn

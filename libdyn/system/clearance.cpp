#include "libdyn/system/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "libbase/names.hpp"
#include "libbase/roots.hpp"
#include "libfe/modes.hpp"
#include "libfe/unbalance.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int moments = 720;        ///< of a period; the largest distance is right to 1e-5
constexpr double tolerance = 1e-9;  ///< of the ends of a range, relative

/// A clearance and how much of it the rotor takes, from complex amplitudes of the full vector.
struct Gap {
  std::string name;
  double clearance = 0.0;
  std::function<double(const CVec& full)> distance;
};

/// The largest distance in a period of an orbit from a point.
double farthest(Complex x, Complex y, const Vec2& from) {
  if (from.isZero(0.0)) return Orbit(x, y).major();
  double largest = 0.0;
  for (int i = 0; i < moments; ++i) {
    const Complex turn = std::polar(1.0, 2.0 * std::numbers::pi * i / moments);
    largest = std::max(largest, (Vec2((x * turn).real(), (y * turn).real()) - from).norm());
  }
  return largest;
}

/// Motion of one point less that of another.
Complex relative(const CVec& full, const DofMap& dofs, const Point& at, const Point& against,
                 int component) {
  const int a = dofs.full_index(at, component), b = dofs.full_index(against, component);
  return (a >= 0 ? full(a) : Complex()) - (b >= 0 ? full(b) : Complex());
}

std::vector<Gap> gaps_of(const Model& model, const Assembler& assembler, const DofMap& dofs) {
  std::vector<Gap> gaps;
  const auto motion = [&](const Station& at, const Station& against, const Vec2& offset,
                          const AnyGeometry& geometry) {
    const int first = closing_of(geometry) == Closing::tilts ? THETA_X : X;
    return [&dofs, offset, first, arm = arm_of(geometry), direction = direction_of(geometry),
            from = assembler.point(at), to = assembler.point(against)](const CVec& full) {
      const Complex x = relative(full, dofs, from, to, first),
                    y = relative(full, dofs, from, to, first + 1);
      if (direction)
        return std::abs((*direction)(0) * x + (*direction)(1) * y) - direction->dot(offset);
      return arm * farthest(x, y, offset);
    };
  };
  for (const Contact& c : model.contacts) {
    gaps.push_back(
        {named("contact", c.name), c.clearance, motion(c.at, c.against, c.offset, geometry_of(c))});
  }
  for (const OilFilm& film : model.films) {
    gaps.push_back({named("oil film", film.name), film.bearing.clearance,
                    motion(film.at, film.against, film.offset, geometry::Ring{})});
  }
  return gaps;
}

}  // namespace

std::vector<ClearanceUse> clearance_uses(const Model& model, const Assembler& assembler,
                                         const std::vector<double>& speeds) {
  UnbalanceSolver solver(assembler);
  const DofMap dofs = solver.dofs();
  const std::vector<Gap> gaps = gaps_of(model, assembler, dofs);
  std::vector<ClearanceUse> uses;
  for (const Gap& gap : gaps) uses.push_back({.name = gap.name, .clearance = gap.clearance});
  if (gaps.empty()) return uses;
  std::vector<double> before(gaps.size(), -1.0);  // what was missing or too much at the last speed
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    const auto full = solver.at(speeds[s]);
    for (std::size_t i = 0; i < gaps.size() && full; ++i) {
      const double distance = gaps[i].distance(*full), excess = distance - gaps[i].clearance;
      ClearanceUse& use = uses[i];
      if (distance > use.largest) use.largest = distance, use.at = speeds[s];
      double border = speeds[s];
      if (s > 0 && (excess > 0.0) != (before[i] > 0.0)) {
        const double root = bracketed_root(
            [&](double Omega) {
              const auto there = solver.at(Omega);
              return there ? gaps[i].distance(*there) - gaps[i].clearance : INFINITY;
            },
            speeds[s - 1], speeds[s], tolerance * speeds[s]);
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

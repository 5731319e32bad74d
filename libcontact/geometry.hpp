#pragma once
/// What a contact geometry states.
///
/// A geometry is a struct of one place that may touch, with
///
///   static constexpr std::string_view name;   the word in the model file
///   static constexpr Closing closing;         motion of the rotor that closes the clearance
///   static constexpr bool rubs_apart;         only friction acts on the lateral displacement
///   static constexpr bool may_stick;          friction may switch its sign at once and stick
///   static constexpr bool takes_offset;       the clearance may lie off the rotor's axis
///   static constexpr bool turns;              the place turns: when it is matters
///   static constexpr bool is_wall;            it is met all around, on a curve that is no circle
///   static constexpr bool reads_rates;        only of one whose depth follows from rates, too
///   static constexpr auto fields();           keys of one that laws share (struct field)
///   int places() const;                       of one contact of the model
///   Self place(i, speeds) const;              number i of them at speeds of what touches
///   double arm() const;                       of the closing motion, u = arm times it [m, or 1]
///   double tip_radius() const;                of the place about the rotor's axis, 0: at u [m]
///   std::optional<double> rim_radius() const; that slips; nothing: the contact says it [m]
///   std::optional<Vec2> direction() const;    the one in which it is met; nothing: all around
///   ContactGap<T> gap(space, at, motion) const;   kinematics, for doubles and duals
///   double beyond(gap, space) const;          above zero in touch, smooth, of order one
///   std::optional<Polynomial> beyond(x, y) const;   the same of d / clearance along a path
///
/// and a wall in place of formulas for circles, which the lanes of libdyn/taylor know,
///
///   std::optional<WallProblem> problem() const;      what is wrong with it, beyond its fields()
///   WallNumbers<double> numbers(clearance) const;    what its shape follows from
///   static T square(x, y, numbers);           one on the wall; t^2 times it at (t x, t y)
///   static WallGap<T> wall(x, y, numbers);    beside the wall
///
/// both for numbers of any kind, series among them. Laws say how hard a place presses, libdyn
/// whether it touches, slides or sticks.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "libbase/numerics/linalg.hpp"
#include "libbase/numerics/polynomial.hpp"
#include "libbase/structs/instant.hpp"

namespace whirl::inline contact {

/// Motion of the rotor that closes a clearance.
enum class Closing {
  lateral,  ///< (x, y)
  tilts     ///< (-theta_y, theta_x), the axial motion of points on x and y per radius
};

/// The space between rotor and stator.
struct ContactSpace {
  double clearance = 0.0;  ///< [m]
  double rim_speed = 0.0;  ///< of the rotor's surface in the slip [m/s]
};

/// How fast the two parts of a contact turn [rad/s].
struct PartSpeeds {
  double at = 0.0;          ///< of the part that touches
  double against = 0.0;     ///< of the part that it touches
  double phase_rate = 1.0;  ///< above 0: phases of motions are told by it
};

/// Motion of a place over (d, w, v): displacement from the middle of the clearance [m], its rate,
/// and the velocity that friction sees [m/s].
template <class T>
struct GapMotion {
  std::array<T, 2> d, w, v;
};

/// Where a place is to its stator; the force on the rotor is -N n - T t.
template <class T>
struct ContactGap {
  /// Distance from the middle of the stator's curvature, infinite of a plane; of a wall the
  /// clearance times the root of its square() [m].
  T r;
  T depth;             ///< beyond the surface [m]
  T rate;              ///< of the depth [m/s]
  T slip;              ///< slip velocity [m/s]
  std::array<T, 2> n;  ///< normal, from rotor to stator

  std::array<T, 2> t() const { return {-n[1], n[0]}; }
};

inline double value_of(double x) {
  return x;
}

/// The gap to a circle: d from its center, which touches at a distance.
///
///   r = |d|,   n = d / r,   depth = r - distance,   slip = rim_speed + t . v
template <class T>
ContactGap<T> gap_to_circle(const GapMotion<T>& m, double distance, double rim_speed) {
  using std::sqrt;
  ContactGap<T> g;
  g.r = sqrt(m.d[0] * m.d[0] + m.d[1] * m.d[1]);
  if (value_of(g.r) > 0.0) {
    g.n = {m.d[0] / g.r, m.d[1] / g.r};
  } else {
    g.n = {T(1.0), T(0.0)};
  }
  const auto t = g.t();
  g.depth = g.r - distance;
  g.rate = g.n[0] * m.w[0] + g.n[1] * m.w[1];
  g.slip = rim_speed + (t[0] * m.v[0] + t[1] * m.v[1]);
  return g;
}

/// Numbers that the shape of a wall follows from.
template <class T>
using WallNumbers = std::array<T, 4>;

/// A number of a wall that is none: its key, what it is, what it must be.
struct WallProblem {
  std::string_view key;
  double found = 0.0;
  std::string_view expected;
};

/// Where a place is to a wall that is no circle.
template <class T>
struct WallGap {
  T depth;   ///< beyond the wall [m]
  T nx, ny;  ///< slope of the depth, of length one on the wall: the normal
};

/// The gap to a wall, d from its middle. The force -N n of a law does no work but on the depth.
template <class Wall, class T>
ContactGap<T> gap_to_wall(const GapMotion<T>& m, const WallNumbers<T>& of, const T& clearance,
                          const T& rim_speed) {
  using std::sqrt;
  ContactGap<T> g;
  const T square = Wall::square(m.d[0], m.d[1], of);
  if (value_of(square) == 0.0) {  // the middle; NaN takes the other branch and stays NaN
    g.r = T(0.0);
    g.depth = -clearance;
    g.n = {T(1.0), T(0.0)};
  } else {
    const WallGap<T> at = Wall::wall(m.d[0], m.d[1], of);
    g.r = clearance * sqrt(square);
    g.depth = at.depth;
    g.n = {at.nx, at.ny};
  }
  const auto t = g.t();
  g.rate = g.n[0] * m.w[0] + g.n[1] * m.w[1];
  g.slip = rim_speed + (t[0] * m.v[0] + t[1] * m.v[1]);
  return g;
}

/// Coefficients of a polynomial of s on [0, 1].
using PathPowers = Eigen::Ref<const Vec, 0, Eigen::InnerStride<>>;

/// x^2 + y^2 - 1: exact, where a distance is a root.
inline Polynomial beyond_unit_circle(const PathPowers& x, const PathPowers& y) {
  Polynomial g;
  const auto terms = static_cast<int>(x.size());
  g.degree = 2 * (terms - 1);
  for (int j = 0; j < terms; ++j) {
    for (int k = 0; k < terms; ++k) {
      g.c[static_cast<std::size_t>(j + k)] += x(j) * x(k) + y(j) * y(k);
    }
  }
  g.c[0] -= 1.0;
  return g;
}

}  // namespace whirl::inline contact

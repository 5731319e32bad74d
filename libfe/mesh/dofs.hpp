#pragma once
/// Degrees of freedom: which entry of a vector is which displacement of which point.

#include <optional>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libfe/mesh/mesh.hpp"

namespace whirl::inline fe {

/// Components of the displacement of a point, in this order.
enum Component { X = 0, Y = 1, THETA_X = 2, THETA_Y = 3 };

/// A coordinate that stands for two states of a support, see state_coordinates.hpp.
struct StateCoordinate {
  int index = 0;  ///< in the full vector
  /// Eigenvalue of the second state where it is none of the support's: nothing moves this state and
  /// it moves nothing [rad/s].
  std::optional<double> idle{};
};

/// Relation between the displacements of all points and the coordinates that are solved for.
///
/// The full vector holds (x, y, theta_x, theta_y) of every node, then of every body (x, y, and the
/// tilts if it has them), then the amplitudes of internal shape functions and the states of
/// supports. The coordinates q are what is left after supports are eliminated and massless dofs
/// condensed: full = T q.
struct DofMap {
  int nodes = 0;
  std::vector<int> body_start;   ///< index of x of each body in the full vector
  std::vector<bool> body_tilts;  ///< whether that body has tilts
  int full_size = 0;
  std::vector<StateCoordinate> states{};
  Sparse T;           ///< full_size x size()
  int condensed = 0;  ///< dofs without inertia that T expresses by others

  int size() const { return static_cast<int>(T.cols()); }
  int bodies() const { return static_cast<int>(body_start.size()); }

  /// Index in the full vector, or -1 where a point lacks the component (ground, bodies' tilts).
  int full_index(const Point& point, int component) const {
    if (point.kind == Point::Kind::node) return 4 * point.index + component;
    if (point.kind == Point::Kind::ground) return -1;
    const auto body = static_cast<std::size_t>(point.index);
    if (component >= THETA_X && !body_tilts[body]) return -1;
    return body_start[body] + component;
  }

  /// Row r with displacement = r . q; zero where the point lacks the component.
  Vec row(const Point& point, int component) const {
    const int i = full_index(point, component);
    if (i < 0) return Vec::Zero(size());
    Vec unit = Vec::Zero(full_size);
    unit(i) = 1.0;
    return T.transpose() * unit;
  }

  /// Points in the order nodes, bodies.
  std::vector<Point> points() const {
    std::vector<Point> all;
    for (int i = 0; i < nodes; ++i) all.push_back({Point::Kind::node, i});
    for (int i = 0; i < bodies(); ++i) all.push_back({Point::Kind::body, i});
    return all;
  }
};

}  // namespace whirl::inline fe

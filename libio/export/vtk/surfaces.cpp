#include "libio/export/vtk/surfaces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::inline io {

using Eigen::Vector3d;

namespace vtk {

namespace {

using Ring = std::vector<int>;

/// Builds the surfaces of one member, normals outward.
class Builder {
 public:
  Builder(Surfaces& surfaces, int facets, Part part, std::size_t index)
      : surfaces_(surfaces), facets_(facets), part_(part), member_(static_cast<int>(index) + 1) {}

  /// A circle of vertices about the center's arm, from +x towards +y.
  Ring ring(const Vertex& center, double radius) {
    return ring(center, radius, [](const Vec2&) { return 0.0; });
  }
  /// @param gap_at  the gap beyond the radius, in a direction of length one
  template <class GapAt>
  Ring ring(const Vertex& center, double radius, const GapAt& gap_at) {
    Ring result;
    for (int i = 0; i < facets_; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / facets_;
      const Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
      result.push_back(static_cast<int>(surfaces_.vertices.size()));
      surfaces_.vertices.push_back(center);
      surfaces_.vertices.back().arm += radius * direction;
      surfaces_.vertices.back().gap += gap_at(direction.head<2>()) * direction;
    }
    return result;
  }

  /// Quadrangles between two rings; the normal is that of (along the ring) x (from ring to ring).
  void band(const Ring& from, const Ring& to) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (part_ == disk_symbol && is_open(static_cast<int>(i))) continue;
      const std::size_t next = (i + 1) % from.size();
      add({from[i], from[next], to[next], to[i]});
    }
  }

  /// A plate across the shaft's surface in a direction, so wide, its normal towards the rotor.
  void plate(const Vertex& left, const Vertex& right, double radius, double gap, const Vec2& to) {
    const Vector3d n(to(0), to(1), 0.0), t(-to(1), to(0), 0.0);
    std::vector<int> corners;
    for (const auto& [end, side] : {std::pair(&left, -1.0), std::pair(&left, 1.0),
                                    std::pair(&right, 1.0), std::pair(&right, -1.0)}) {
      corners.push_back(static_cast<int>(surfaces_.vertices.size()));
      surfaces_.vertices.push_back(*end);
      surfaces_.vertices.back().arm += radius * (n + side * t);
      surfaces_.vertices.back().gap += gap * n;
    }
    add(std::move(corners));
  }

  /// The polygon that closes a ring, with its normal towards -z or +z.
  void left_cap(Ring ring) {
    std::reverse(ring.begin(), ring.end());
    add(std::move(ring));
  }
  void right_cap(const Ring& ring) { add(ring); }

  /// The four sides of a pyramid from a tip down to the corners of its foot, in their order.
  void sides(const Vertex& tip, const std::vector<Vertex>& corners) {
    const int first = add_vertices(corners), top = add_vertices({tip});
    for (int i = 0; i < 4; ++i) add({top, first + i, first + (i + 1) % 4});
  }
  /// A polygon, its normal by the order of its corners.
  void polygon(const std::vector<Vertex>& corners) {
    const int first = add_vertices(corners);
    std::vector<int> all;
    for (int i = 0; i < static_cast<int>(corners.size()); ++i) all.push_back(first + i);
    add(std::move(all));
  }

 private:
  /// Whether a facet is of a sector that a symbol leaves out.
  bool is_open(int facet) const {
    const int sectors = std::min(24, facets_);
    return sectors * facet / facets_ % 2 == 1;
  }
  int add_vertices(const std::vector<Vertex>& vertices) {
    const int first = static_cast<int>(surfaces_.vertices.size());
    surfaces_.vertices.insert(surfaces_.vertices.end(), vertices.begin(), vertices.end());
    return first;
  }
  void add(std::vector<int> vertices) {
    surfaces_.cells.push_back({std::move(vertices), part_, member_});
  }

  Surfaces& surfaces_;
  int facets_;
  Part part_;
  int member_;
};

/// Whether a shaft piece ends at a point in a neighbor of the same radius, and needs no face there.
bool continues(const VtkScene& scene, const VtkShaftPiece& piece, bool at_right) {
  const int point = at_right ? piece.right : piece.left;
  const double radius = at_right ? piece.right_radius : piece.left_radius;
  return std::any_of(scene.shaft.begin(), scene.shaft.end(), [&](const VtkShaftPiece& other) {
    if (&other == &piece) return false;
    return (other.left == point && std::abs(other.left_radius - radius) < 1e-9 * radius) ||
           (other.right == point && std::abs(other.right_radius - radius) < 1e-9 * radius);
  });
}

/// Length of the rotor, or its diameter if that is larger [m].
double size_of(const VtkScene& scene) {
  double size = 0.0;
  if (!scene.z.empty()) {
    const auto [first, last] = std::minmax_element(scene.z.begin(), scene.z.end());
    size = *last - *first;
  }
  for (const VtkDisk& d : scene.disks) size = std::max(size, 2.0 * d.outer_radius);
  for (const VtkStator& s : scene.stators) {
    size = std::max(size, 2.0 * (s.rotor_radius + s.clearance));
  }
  return size > 0.0 ? size : 1.0;
}

/// A point of the scene, or of the ground, with an arm to a place along the shaft.
Vertex vertex_at(const VtkScene& scene, int point, double x, double y, double z) {
  const double from = point < 0 ? 0.0 : scene.z[static_cast<std::size_t>(point)];
  return {point, point, 0.0, Vector3d(x, y, z - from)};
}

/// A square across y below the axis, its normal up.
std::vector<Vertex> square_at(const VtkScene& scene, const VtkSupport& s, double half) {
  std::vector<Vertex> corners;
  for (const auto& [x, z] : {std::pair{half, half}, {half, -half}, {-half, -half}, {-half, half}}) {
    corners.push_back(vertex_at(scene, s.to, x, -s.foot, s.z + z));
  }
  return corners;
}

void add_supports(Surfaces& surfaces, const VtkScene& scene) {
  constexpr double plate = 1.6;  // of a foot, wider than what stands on it
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const VtkSupport& s = scene.supports[k];
    const double half = 0.5 * s.width;
    Builder(surfaces, 4, support, k)
        .sides(vertex_at(scene, s.from, 0.0, -s.tip, s.z), square_at(scene, s, half));
    Builder(surfaces, 4, foot, k).polygon(square_at(scene, s, plate * half));
  }
}

}  // namespace

Surfaces surfaces_of(const VtkScene& scene, const VtkOptions& options) {
  Surfaces surfaces;
  for (std::size_t k = 0; k < scene.shaft.size(); ++k) {
    const VtkShaftPiece& piece = scene.shaft[k];
    Builder builder(surfaces, options.facets, shaft, k);
    Ring before;
    for (int i = 0; i <= options.sections; ++i) {
      const double s = static_cast<double>(i) / options.sections;
      const double radius = (1.0 - s) * piece.left_radius + s * piece.right_radius;
      const Ring ring = builder.ring({piece.left, piece.right, s, Vector3d::Zero()}, radius);
      if (i == 0 && !continues(scene, piece, false)) builder.left_cap(ring);
      if (i > 0) builder.band(before, ring);
      before = ring;
    }
    if (!continues(scene, piece, true)) builder.right_cap(before);
  }
  for (std::size_t k = 0; k < scene.disks.size(); ++k) {
    const VtkDisk& d = scene.disks[k];
    const bool is_symbol = !d.not_given.empty();
    Builder builder(surfaces, options.facets, is_symbol ? disk_symbol : disk, k);
    const double bore = is_symbol ? std::max(d.inner_radius, 0.05 * d.outer_radius)  // no caps
                                  : d.inner_radius;
    const Vertex left{d.point, d.point, 0.0, Vector3d(0.0, 0.0, -0.5 * d.width)};
    const Vertex right{d.point, d.point, 0.0, Vector3d(0.0, 0.0, 0.5 * d.width)};
    const Ring outer_left = builder.ring(left, d.outer_radius);
    const Ring outer_right = builder.ring(right, d.outer_radius);
    builder.band(outer_left, outer_right);
    if (bore > 0.0) {
      const Ring inner_left = builder.ring(left, bore);
      const Ring inner_right = builder.ring(right, bore);
      builder.band(inner_right, inner_left);
      builder.band(inner_left, outer_left);
      builder.band(outer_right, inner_right);
    } else {
      builder.left_cap(outer_left);
      builder.right_cap(outer_right);
    }
  }
  for (std::size_t k = 0; k < scene.stators.size(); ++k) {
    const VtkStator& s = scene.stators[k];
    Builder builder(surfaces, options.facets, stator, k);
    const double width = s.width > 0.0 ? s.width : 0.2 * (s.rotor_radius + s.clearance);
    const double z = s.z - (s.point < 0 ? 0.0 : scene.z[static_cast<std::size_t>(s.point)]);
    const Vector3d offset(s.offset.x(), s.offset.y(), 0.0);
    const Vertex left{s.point, s.point, 0.0, Vector3d(0.0, 0.0, z - 0.5 * width), offset};
    const Vertex right{s.point, s.point, 0.0, Vector3d(0.0, 0.0, z + 0.5 * width), offset};
    if (const auto direction = direction_of(s.geometry)) {
      builder.plate(left, right, s.rotor_radius, s.clearance, *direction);
      continue;
    }
    const auto gap = [&](const Vec2& along) { return reach_of(s.geometry, s.clearance, along); };
    builder.band(builder.ring(left, s.rotor_radius, gap), builder.ring(right, s.rotor_radius, gap));
  }
  add_supports(surfaces, scene);
  return surfaces;
}

Placement place(const Vertex& vertex, const VtkScene& scene, const Mat& motion) {
  const Vector3d arm = vertex.arm + vertex.gap;
  if (vertex.left < 0) return {arm, Vector3d::Zero(), Vector3d::Zero()};
  const double s = vertex.share;
  const double z_left = scene.z[static_cast<std::size_t>(vertex.left)];
  const double z_right = scene.z[static_cast<std::size_t>(vertex.right)];
  const Eigen::RowVector4d left = motion.row(vertex.left), right = motion.row(vertex.right);

  // cubic Hermite polynomials; slopes are dx/dz = theta_y, dy/dz = -theta_x
  const double L = z_right - z_left;
  const double h_right = s * s * (3.0 - 2.0 * s), h_left = 1.0 - h_right;
  const double slope_left = L * s * (1.0 - s) * (1.0 - s), slope_right = -L * s * s * (1.0 - s);
  const Vector3d u(
      h_left * left[0] + h_right * right[0] + slope_left * left[3] + slope_right * right[3],
      h_left * left[1] + h_right * right[1] - slope_left * left[2] - slope_right * right[2], 0.0);
  const Vector3d theta((1.0 - s) * left[2] + s * right[2], (1.0 - s) * left[3] + s * right[3], 0.0);
  const Vector3d axis(0.0, 0.0, (1.0 - s) * z_left + s * z_right);
  return {axis + arm, u + theta.cross(arm), theta};
}

double force_scale(const VtkScene& scene, const std::vector<VtkFrame>& frames) {
  double largest = 0.0;
  for (const VtkFrame& frame : frames) {
    for (const VtkForce& f : frame.forces) {
      if (f.force.allFinite()) largest = std::max(largest, f.force.norm());
    }
  }
  return largest > 0.0 ? 0.15 * size_of(scene) / largest : 1.0;
}

}  // namespace vtk

std::string symbols_told(const VtkScene& scene) {
  constexpr std::size_t most = 3;  // names
  std::vector<std::string> names;
  for (const VtkDisk& d : scene.disks) {
    if (!d.not_given.empty()) names.push_back(fmt::format("the {} of {}", d.not_given, d.name));
  }
  if (names.empty()) return "";
  const std::size_t more = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - more);
  return fmt::format("Thin, broken and not to scale, as the model does not give {}{}",
                     fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

double vtk_fitting_scale(const VtkScene& scene, const std::vector<VtkFrame>& frames) {
  constexpr double drawn_share = 0.12;  // of the scene's size
  constexpr double drawn_tilt = 0.35;   // [rad], of which a disk looks 6 % too large
  double inverse = 0.0;
  for (const VtkFrame& frame : frames) {
    for (Eigen::Index i = 0; i < frame.motion.rows(); ++i) {
      const double r = frame.motion.row(i).head<2>().norm() / (drawn_share * vtk::size_of(scene));
      const double tilt = frame.motion.row(i).tail<2>().norm() / drawn_tilt;
      for (const double demand : {r, tilt}) {
        if (std::isfinite(demand)) inverse = std::max(inverse, demand);
      }
    }
  }
  return inverse > 0.0 ? 1.0 / inverse : 1.0;
}

double vtk_deflection_scale(const VtkScene& scene, const std::vector<VtkFrame>& frames) {
  return std::max(1.0, vtk_fitting_scale(scene, frames));
}

}  // namespace whirl::inline io

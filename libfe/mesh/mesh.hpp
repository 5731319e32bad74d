#pragma once
/// Nodes of the shaft: where they are, what lies between them, which station is which node.

#include <cstddef>
#include <optional>
#include <vector>

#include "libfe/parts/station.hpp"

namespace whirl::inline fe {

struct Layer;
struct Structure;

/// A point that has displacements: a node of the shaft, a body, or the ground.
struct Point {
  enum class Kind { node, body, ground };
  Kind kind = Kind::ground;
  int index = 0;  ///< of the node or body, from 0

  bool operator==(const Point&) const = default;
};

/// A piece of one segment between two neighboring nodes.
struct MeshElement {
  int left = 0, right = 0;      ///< nodes, from 0
  int shaft = 0;                ///< 0: the first one, else that of a rotor, from 1
  int segment = 0;              ///< of the shaft
  double from = 0.0, to = 1.0;  ///< fractions of the segment's length
};

/// A piece of a layer beside one element of the shaft.
struct MeshLayer {
  int element = 0;              ///< that it lies beside, from 0
  int layer = 0;                ///< from 0
  double from = 0.0, to = 1.0;  ///< fractions of the layer's length
};

/// Nodes in the order of their numbers: those of the first shaft, then those of each rotor.
///
/// Segments with a given number of elements make equal ones; their nodes are numbered left to
/// right. Segments without one are divided at the stations and finely enough for their shape. A
/// station between the nodes of a given mesh adds a node with a number after all others, so that
/// numbers that a model file uses keep their place.
struct Mesh {
  std::vector<double> z;              ///< position of each node [m]
  std::vector<int> shaft_of;          ///< number of the shaft of each node
  std::vector<int> left_to_right;     ///< nodes, shaft by shaft, ordered by position
  std::vector<MeshElement> elements;  ///< shaft by shaft, left to right
  std::vector<MeshLayer> layers{};    ///< element by element

  int nodes() const { return static_cast<int>(z.size()); }
  /// Nodes of every shaft, left to right.
  std::vector<std::vector<int>> lines() const;
  /// Where a point is along the shaft [m]; nothing: it is a body or the ground.
  std::optional<double> position_of(const Point& point) const {
    if (point.kind != Point::Kind::node) return std::nullopt;
    return z.at(static_cast<std::size_t>(point.index));
  }
};

/// @throws ModelError  for stations off the shaft, unknown nodes or bodies, unfit segments, layers
///                     that do not end right of where they begin, and two positions nearer than
///                     1e-5 of the shaft's length without being the same
Mesh make_mesh(const Structure& structure);

/// The point that a station stands for; the mesh has a node there.
/// @throws ModelError  if there is none
Point resolve(const Station& station, const Structure& structure, const Mesh& mesh);

/// Where a layer begins and ends along the shaft [m].
struct LayerSpan {
  double from = 0.0, to = 0.0;
  int shaft = 0;  ///< on which it lies
};
/// @throws ModelError  as resolve
LayerSpan span_of(const Layer& layer, const Structure& structure, const Mesh& mesh);

/// Outer diameter of a shaft and its layers at a position [m]; the larger one at a step.
/// @param shaft  0: the first one, else that of a rotor, from 1
double shaft_diameter(const Structure& structure, const Mesh& mesh, double z, int shaft = 0);

/// The same at a node, of its own shaft.
double diameter_at(const Structure& structure, const Mesh& mesh, int node);

/// Number of the shaft that a point belongs to, from 0; nothing: the ground, or a rotor that is not
/// there.
std::optional<int> shaft_of(const Point& point, const Structure& structure, const Mesh& mesh);

/// Speed of the shaft that a point belongs to over that of the first shaft, of a body whether it
/// spins or not; 0: the ground; NaN: its speed is its own.
double shaft_ratio(const Point& point, const Structure& structure, const Mesh& mesh);

/// The same of what is at a point: of a body that does not spin it is 0.
double spin_ratio(const Point& point, const Structure& structure, const Mesh& mesh);

/// The same as speeds where the first shaft has a speed [rad/s].
double shaft_speed(const Point& point, const Structure& structure, const Mesh& mesh, double Omega);
double spin_speed(const Point& point, const Structure& structure, const Mesh& mesh, double Omega);

/// All stations of a structure, in the order disks, bearings, links, gears, supports, unbalances,
/// forces, probes, layers, others.
std::vector<const Station*> all_stations(const Structure& structure);

}  // namespace whirl::inline fe

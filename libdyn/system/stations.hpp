#pragma once
/// Names of points: what a person calls a node.

#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline dyn {

struct Model;

/// A point with the names of what is there ("left disk", "seal"), joined by " + ".
struct NamedPoint {
  Point point;
  std::string name;  ///< empty if nothing is there
  int node() const { return point.kind == Point::Kind::node ? point.index + 1 : 0; }
  /// "7 seal", "stator".
  std::string label() const;
};

/// Nodes and bodies of a model with their names, as a result; group /points.
struct PointNames {
  Vec z;                                ///< of the nodes along the shaft [m]
  std::vector<std::string> node_names;  ///< "": nothing is there
  std::vector<std::string> body_names;

  static constexpr std::string_view group = "/points";
  static constexpr auto columns() {
    return ColumnList{
        column("z", &PointNames::z, "m", "position of the nodes along the shaft")
            .along("nodes+")
            .within(valid::finite)
            .maybe(),
        column("node_name", &PointNames::node_names, "", "what is at the nodes")
            .along("nodes")
            .maybe(),
        column("body_name", &PointNames::body_names, "", "bodies").along("bodies+").maybe()};
  }
};
PointNames point_names(const Model& model, const Assembler& assembler);

/// All points in the order of position along the shaft, then bodies.
std::vector<NamedPoint> named_points(const Model& model, const Assembler& assembler);

/// Points asked for by a list "seal,left disk,7,all": names, node numbers, or "all".
///
/// An empty list stands for all points with a disk, contact, oil film, bearing, seal or probe, and
/// all bodies.
/// @throws OptionError  for an unknown name, with the known ones
std::vector<NamedPoint> select_points(const Model& model, const Assembler& assembler,
                                      const std::string& list);

}  // namespace whirl::inline dyn

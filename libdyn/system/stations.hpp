#pragma once
/// Names of points: what a person calls a node.

#include <string>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libfe/assemble.hpp"

namespace whirl {

/// A point with the names of what is there ("left disk", "seal"), joined by " + ".
struct NamedPoint {
  Point point;
  std::string name;  ///< empty if nothing is there
  int node() const { return point.kind == Point::Kind::node ? point.index + 1 : 0; }
};

/// All points in the order of position along the shaft, then bodies.
std::vector<NamedPoint> named_points(const Model& model, const Assembler& assembler);

/// Points asked for by a list "seal,left disk,7,all": names, node numbers, or "all".
///
/// An empty list stands for everything with a contact, a disk or a bearing, and all bodies.
/// @throws ModelError  for an unknown name, with the nearest one
std::vector<NamedPoint> select_points(const Model& model, const Assembler& assembler,
                                      const std::string& list);

}  // namespace whirl

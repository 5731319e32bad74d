#pragma once
/// What linear analyses over a value of the model share.

#include <functional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libbase/structs/parameter_name.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/shape_branches.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline dyn {

/// The model at a value of a parameter [SI]; throws ModelError where there is no model.
using ModelAt = std::function<Model(double value)>;

/// A parameter, and the values that it takes; results over values begin with its columns.
struct OverValues {
  ParameterName parameter{};
  std::vector<double> values{};  ///< ascending [SI]

  std::string_view path() const { return parameter.path; }
  std::string_view unit() const { return parameter.unit; }

  static constexpr auto columns() {
    using enum Written;
    using O = OverValues;
    return ColumnList{column("parameter", &O::path, "", "path of the value").only(in_json),
                      column("unit", &O::unit, "", "SI unit of the values").only(in_json),
                      column("value", &O::values, unit_of_parameter, "of the parameter")
                          .axis("values+")
                          .within(valid::finite)
                          .as("values")};
  }
};

/// A value at which nothing can be computed.
struct ValueGap {
  double value = 0.0;  ///< [SI]
  std::string why;

  static constexpr auto columns() {
    return ColumnList{column("value", &ValueGap::value, unit_of_parameter, "that is left out"),
                      column("why", &ValueGap::why, "", "why")};
  }
};
std::vector<ValueGap> gaps_of(const ShapeBranches& followed);

/// A place of a branch at one of the values that were asked for; branches have places between, too.
struct ToldAt {
  Eigen::Index index = 0;  ///< of the value
  const ShapedValue& found;
};
std::vector<ToldAt> told_places(const ShapeBranch& branch, const std::vector<double>& values);
/// Whether a branch is ever among so many lowest solutions at its places.
bool is_among_lowest(const std::vector<ToldAt>& places, int count);

/// Solutions computed beyond those that are wanted, for newcomers.
inline constexpr int spare_solutions = 2;
/// Frequency or speed up to which shapes must agree: a little more than that of the highest
/// solution wanted, at the first or the last value that can be computed, whichever is higher.
/// @param count  of solutions wanted
/// @throws NumericalError, ModelError  what the first value throws, if all throw
double shape_limit(const std::vector<double>& values, const SolveShapes& solve, int count);

/// Shapes of models that differ, told at the same points: the nodes of a first model by their
/// places along the shaft, then its bodies. A shape is taken as straight between the nodes of
/// another mesh.
class ShapeSampler {
 public:
  explicit ShapeSampler(const Assembler& first);

  /// x, y, theta_x, theta_y at all points; tilts times a length, so that they count like
  /// displacements.
  /// @throws ModelError  if the bodies are not those of the first model
  CVec at_points(const Assembler& assembler, const DofMap& dofs, const CVec& shape) const;

  /// A unit matrix of the size of at_points, the weight with which shapes are followed.
  Sparse weight() const;

 private:
  std::vector<double> places_;  ///< 0 to 1 along the shaft
  double length_ = 1.0;         ///< of tilts [m]
  int bodies_ = 0;
};

}  // namespace whirl::inline dyn

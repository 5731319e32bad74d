#include "libio/results/curve_results.hpp"

#include "libio/results/branch_ends.hpp"
#include "libio/results/branch_walks.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/row_datasets.hpp"

namespace whirl::inline io {

namespace {

const std::string curve_group = "/border";

std::string curve_path(const char* name) {
  return curve_group + "/" + name;
}

struct CurvePoint {
  int number;  ///< of its curve, from 1
  const BranchPoint* point;

  /// Whether no other multiplier is outside of the unit circle.
  int is_stable() const {
    const CVec& others = point->multipliers;
    return others.size() == 0 || others.cwiseAbs().maxCoeff() < 1.0 ? 1 : 0;
  }
};

std::vector<CurvePoint> points_of(const BifurcationCurves& curves) {
  std::vector<CurvePoint> rows;
  int number = 0;
  for (const BifurcationCurve& c : curves.curves) {
    ++number;
    for (const BranchPoint& p : c.branch.points) rows.push_back({number, &p});
  }
  return rows;
}

void write_curve_list(ResultWriter& file, const BifurcationCurves& curves) {
  using Curve = BifurcationCurve;
  const RowDatasets rows(file, curves.curves, curve_path("number"));
  rows.numbers("curve");
  rows.one(curve_path("kind"), {"", "kind of the bifurcation"},
           [](const Curve& c) { return std::string(name_of(c.kind)); });
  rows.one(curve_path("contact"), {"", "contact that grazes"},
           [](const Curve& c) { return c.contact; });
  rows.one(curve_path("period"), {"", "period of the orbits [revolutions]"},
           [](const Curve& c) { return c.branch.period; });
  std::vector<std::optional<BranchEnd>> ends;
  for (const Curve& c : curves.curves) ends.push_back(c.branch.end);
  write_ends(file, curve_group, curve_path("number"), ends);
}

}  // namespace

void write_curves(ResultWriter& file, const BifurcationCurves& curves, const CurveAxes& axes) {
  if (curves.curves.empty()) return;
  write_curve_list(file, curves);
  const RowDatasets points(file, points_of(curves), curve_path("first"));
  points.axis({axes.first.unit, axes.first.path},
              [&](const CurvePoint& p) { return first_value(axes.along, *p.point); });
  points.one(curve_path("second"), {axes.second.unit, axes.second.path},
             [](const CurvePoint& p) { return p.point->value; });
  points.one(curve_path("curve"), {"", "curve of a point"},
             [](const CurvePoint& p) { return p.number; });
  points.one(curve_path("stable"), {"", "1: no other multiplier is outside of the unit circle"},
             [](const CurvePoint& p) { return p.is_stable(); });
  write_curve_walk(file, curve_group, curves.curves);
  file.attribute(curve_group, "complete", curves.is_complete() ? 1 : 0);
}

BifurcationCurves read_curves(const ResultReader& file, const BranchLayout& layout) {
  if (!file.has(curve_path("walk"))) return {};
  return {.curves = read_curve_walk(file, curve_group, layout)};
}

}  // namespace whirl::inline io

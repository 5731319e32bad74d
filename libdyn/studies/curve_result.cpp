#include "libdyn/studies/curve_result.hpp"

namespace whirl::inline dyn {

CurveResult curve_result(const BifurcationCurves& curves, const ParameterName& first,
                         const ParameterRange& along, const ParameterName& second) {
  CurveResult result{.first = first, .second = second, .is_complete = curves.is_complete() ? 1 : 0};
  int number = 0;
  for (const BifurcationCurve& c : curves.curves) {
    CurveRow row{EndTexts(c.branch),
                 ++number,
                 c.kind,
                 c.contact,
                 c.branch.period,
                 c.branch_number,
                 Mat(std::ssize(c.branch.points), 2)};
    Eigen::Index i = 0;
    for (const BranchPoint& p : c.branch.points) {
      const CVec& others = p.multipliers;
      const bool is_stable = others.size() == 0 || others.cwiseAbs().maxCoeff() < 1.0;
      result.places.push_back({first_value(along, p), p.value, number, is_stable ? 1 : 0});
      row.points.row(i++) << result.places.back().first, p.value;
    }
    result.curves.push_back(std::move(row));
  }
  return result;
}

}  // namespace whirl::inline dyn

#include "libdyn/studies/bifurcation_curves.hpp"

#include <algorithm>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double finest = 1e-5;     ///< arc length, to which a curve comes near its end
constexpr double on_branch = 1e-8;  ///< residual of a grazing that is on its branch

bool is_followed(const Bifurcation& b) {
  if (b.kind == BifurcationKind::pitchfork) return false;
  // a grazing that ends a branch is not on it
  return b.kind != BifurcationKind::grazing || b.at.residual < on_branch;
}

/// Derivatives of a revolution at a place; nothing where they are not known.
std::optional<RevolutionSlopes> slopes_at(const PlaneScenes& scenes, double along, double across,
                                          const Vec& start, const RevolutionAsked& asked) {
  try {
    const auto panel = scenes.slopes ? scenes.slopes->panel_at(asked.by, along, across) : nullptr;
    if (!panel) return std::nullopt;
    const double value = asked.by == PlaneParameter::first ? along : across;
    return revolution_slopes(*scenes.at(along, across), *scenes.first, *panel, value, start, asked);
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

BranchEquations equations_of(const BegunWalk& curve, const PlaneScenes& scenes,
                             const ParameterRange& along) {
  return bifurcation_curve_equations(curve.kind, flows_of(scenes, curve.contact),
                                     scenes.first->contacts.state_scale(), along.low, along.high);
}

ContinuationOptions walk_options(const BegunWalk& curve, const BifurcationCurveOptions& options) {
  ContinuationOptions how = options.across.options(curve.direction);
  how.period = curve.branch.period;
  how.most_points = options.most_points;
  how.smallest_step = finest;
  return how;
}

/// The first point of a curve, at the bifurcation that it goes through.
Branch begun_at(const Bifurcation& bifurcation, const BegunWalk& curve, const PlaneScenes& scenes,
                const BifurcationCurveOptions& options) {
  try {
    return Continuation(equations_of(curve, scenes, options.along), bifurcation.at.z,
                        walk_options(curve, options))
        .branch();
  } catch (const NumericalError& error) {  // a point where two of them meet, say
    Branch none{.period = curve.branch.period,
                .points = {bifurcation.at},
                .end = BranchEnd{EndKind::no_start, error.what()}};
    none.points[0].value = options.across.first;
    Vec z(bifurcation.at.z.size() + 1);  // the second parameter is appended
    z << bifurcation.at.z, 0.0;
    none.points[0].z = z;
    return none;
  }
}

}  // namespace

FlowPlane flows_of(const PlaneScenes& scenes, const std::string& contact) {
  return {[&scenes](double a, double b) { return flow_of(scenes.at(a, b), *scenes.first); },
          [&scenes, contact](double a, double b, std::span<const Vec> starts) {
            const auto scene = scenes.at(a, b);
            const BasisChange change(*scene, *scenes.first);
            std::vector<Vec> own;
            for (const Vec& y : starts) own.push_back(change.to(y));
            return nearest_graze(*scene, contact, own);
          },
          [&scenes](double a, double b, const Vec& start, const RevolutionAsked& asked) {
            return slopes_at(scenes, a, b, start, asked);
          }};
}

bool BifurcationCurves::is_complete() const {
  return std::all_of(curves.begin(), curves.end(),
                     [](const auto& c) { return c.branch.end.has_value(); });
}

double first_value(const ParameterRange& along, const BranchPoint& point) {
  return along.low + point.z(point.z.size() - 2) * (along.high - along.low);
}

BifurcationCurves begin_curves(const PlaneScenes& scenes, const BranchTree& tree,
                               const BifurcationCurveOptions& options) {
  BifurcationCurves curves;
  for (std::size_t k = 0; k < tree.branches.size(); ++k) {
    const Branch& branch = tree.branches[k].branch;
    for (const Bifurcation& b : branch.bifurcations) {
      if (!is_followed(b)) continue;
      for (const double direction : options.across.directions()) {
        BifurcationCurve curve{.kind = b.kind,
                               .contact = b.contact,
                               .branch_number = static_cast<int>(k) + 1,
                               .direction = direction,
                               .branch = {.period = branch.period}};
        curve.branch = begun_at(b, begun_walk(curve), scenes, options);
        curves.curves.push_back(std::move(curve));
      }
    }
  }
  return curves;
}

BegunWalk begun_walk(const BifurcationCurve& curve) {
  return {.is_curve = true,
          .branch = curve.branch,
          .direction = curve.direction,
          .kind = curve.kind,
          .contact = curve.contact};
}

WalkNews walk_curve(const PlaneScenes& scenes, const BifurcationCurveOptions& options,
                    BegunWalk begun, const StretchLimits& limits) {
  const ContinuationOptions how = walk_options(begun, options);
  BranchEquations equations = equations_of(begun, scenes, options.along);
  return walk_stretch(
      {std::move(equations), std::move(begun.branch), how, std::move(begun.by_parameter)}, limits);
}

}  // namespace whirl::inline dyn

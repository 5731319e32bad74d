#include "libio/model/branch_setup.hpp"

#include "libbase/error.hpp"
#include "libdyn/branches/range_slopes.hpp"
#include "libdyn/system/stations.hpp"

namespace whirl::inline io {

BranchSetup branch_setup(BranchParameters parameters, BranchTreeOptions tree,
                         const std::string& stations) {
  BranchSetup setup{.parameters = std::move(parameters), .tree = std::move(tree)};
  setup.tree.along = setup.parameters.along.range;
  setup.at_first = setup.parameters.model(setup.tree.along.first);
  setup.scene = std::make_shared<const Scene>(make_scene(setup.at_first));
  for (const NamedPoint& p : select_points(setup.at_first, setup.scene->assembler, stations)) {
    setup.tree.stations.push_back(p.point);
    setup.stations.push_back(p.label());
  }
  return setup;
}

BranchStudyOptions BranchSetup::options() const {
  BranchStudyOptions options{.tree = tree, .threads = threads};
  if (has_curves()) {
    options.curves = {tree.along, parameters.across->range, tree.most_points};
  }
  return options;
}

BranchScenes BranchSetup::scenes() const {
  const SceneAt along = [this](double value) { return parameters.scene(value); };
  const ParameterRange& range = tree.along;
  const RangeSlopes::ModelAt model = [this](double value) { return parameters.model(value); };
  BranchScenes scenes{
      {scene, along,
       std::make_shared<const RangeSlopes>(along, scene, range.low, range.high, model)},
      {scene, [this](double a, double b) { return parameters.scene(a, b); }}};
  if (parameters.across) {
    const ParameterRange& across = parameters.across->range;
    scenes.plane.slopes =
        std::make_shared<const PlaneSlopes>(scenes.plane.at, ParameterEnds{range.low, range.high},
                                            ParameterEnds{across.low, across.high});
  }
  return scenes;
}

BranchResult BranchSetup::result(const BranchTree& found) const {
  BranchResult result = branch_result(found, parameters.along.axis.name(), stations);
  result.method = tree.method;
  result.fixed = parameters.fixed();
  return result;
}

CurveResult BranchSetup::result(const BifurcationCurves& found) const {
  return curve_result(found, parameters.along.axis.name(), tree.along,
                      parameters.across->axis.name());
}

TorusSetup torus_setup(const Model& model, std::optional<BranchParameters> parameters,
                       TorusOptions options) {
  TorusSetup setup{.parameters = std::move(parameters), .options = options, .at_first = model};
  if (setup.parameters) {
    if (setup.parameters->across) throw ModelError({"--over"}, "", "found 2 of them, expected one");
    setup.options.along = setup.parameters->along.range;
    setup.at_first = setup.parameters->model(setup.options.along->first);
  }
  setup.scene = std::make_shared<const Scene>(make_scene(setup.at_first));
  return setup;
}

ParameterScenes TorusSetup::scenes() const {
  return {scene, [this](double value) { return parameters->scene(value); }};
}

TorusResult TorusSetup::result(const TorusBranch& torus) const {
  return torus_result(*scene, torus, parameters ? parameters->along.axis.name() : ParameterName{});
}

}  // namespace whirl::inline io

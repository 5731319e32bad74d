#include "apps/verbs/continue_call.hpp"

#include "apps/verbs/common.hpp"
#include "apps/verbs/orbits.hpp"
#include "libbase/error.hpp"

namespace whirl::inline cli {

namespace {

/// @throws ModelError  for options that do not go together
void require_that_fits(const ContinueCall& asked) {
  const bool is_rotating = asked.tree.frame == OrbitFrame::rotating;
  if (is_rotating && asked.parameters.across) {
    throw ModelError({"--frame rotating"}, "", "expected one --over beside it");
  }
  if (asked.tree.method != OrbitMethod::harmonic_balance) return;
  if (asked.tree.generations > 0 || asked.parameters.across || is_rotating) {
    throw ModelError({asked.tree.generations > 0 ? "--switch"
                      : is_rotating              ? "--frame rotating"
                                                 : "--over"},
                     "", "goes with --method shooting only");
  }
}

}  // namespace

ContinueCall continue_call(const Invocation& call, const Model& model) {
  ContinueCall asked;
  asked.tree.frame = orbit_frame(call);
  if (asked.tree.frame == OrbitFrame::rotating && (call.has("switch") || call.has("period"))) {
    throw ModelError({"--frame rotating"}, "", "expected neither --period nor --switch beside it");
  }
  asked.parameters = branch_parameters(call, model);
  asked.tree.along = asked.parameters.along.range;
  asked.tree.period = static_cast<int>(call.integer("period"));
  asked.tree.most_points = static_cast<int>(call.integer("most"));
  asked.tree.generations = static_cast<int>(call.integer("switch", 0));
  asked.tree.method = orbit_method(call);
  require_that_fits(asked);
  asked.tree.harmonics = harmonics_of(call, asked.tree.period);
  asked.at_first = asked.parameters.model(asked.tree.along.first);
  asked.scene = std::make_shared<const Scene>(make_scene(asked.at_first));
  const ParameterAxis& axis = asked.parameters.along.axis;
  asked.names = {.path = axis.path, .unit = axis.unit, .stations = {}};
  for (const NamedPoint& p :
       select_points(asked.at_first, asked.scene->assembler, call.text("stations"))) {
    asked.tree.stations.push_back(p.point);
    asked.names.stations.push_back(p.label());
  }
  return asked;
}

}  // namespace whirl::inline cli

#include "apps/verbs/torus_call.hpp"

#include "libbase/error.hpp"

namespace whirl::inline cli {

TorusCall torus_call(const Invocation& call, const Model& model) {
  TorusCall asked;
  asked.options = {.circle = {.period = static_cast<int>(call.integer("period")),
                              .harmonics = static_cast<int>(call.integer("harmonics"))},
                   .sections = call.integer("revolutions", 200),
                   .most_points = static_cast<int>(call.integer("most"))};
  if (!call.over.empty()) {
    asked.parameters = branch_parameters(call, model);
    if (asked.parameters->across) throw ModelError({"--over"}, "", "found 2 of them, expected one");
    asked.options.along = asked.parameters->along.range;
  }
  asked.at_first = asked.parameters ? asked.parameters->model(asked.options.along->first) : model;
  asked.scene = std::make_shared<const Scene>(make_scene(asked.at_first));
  return asked;
}

}  // namespace whirl::inline cli

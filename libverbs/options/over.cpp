#include "libverbs/options/over.hpp"

#include <algorithm>

#include "libdyn/linear/own_speed_branches.hpp"

namespace whirl::inline cli {

namespace {

ParameterAxis axis_of(const AxesVerbOptions& axes) {
  ParameterAxis axis = parse_axes(axes.over.values, axes.points.value_or(0), 1, 1).front();
  std::sort(axis.values.begin(), axis.values.end());
  axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
  return axis;
}

/// The rotor of the model whose ratio, or table of speeds, the axis puts a constant speed for.
std::optional<std::size_t> freed_rotor(const Model& model, const ParameterAxis& axis) {
  const auto rotor = rotor_of_speed(model.structure, axis.path);
  const bool is_speed = axis.unit.empty() || axis.unit == "rad/s";
  if (!rotor || !is_speed || model.structure.rotors[*rotor].own.size() == 1) return {};
  return rotor;
}

}  // namespace

bool runs_over(const AxesVerbOptions& axes) {
  if (axes.over.values.empty() && axes.points) {
    throw axes.points.wrong("it is the number of values of --over, which is not given");
  }
  return !axes.over.values.empty();
}

LinearAxis::LinearAxis(const Invocation& call, const AxesVerbOptions& axes)
    : model_(call.model()),
      axis_(axis_of(axes)),
      family_(model_, {axis_}),
      freed_(freed_rotor(model_, axis_)) {
  // what is wrong at the ends is said before the work
  for (const double value : {axis_.values.front(), axis_.values.back()}) model_at()(value);
}

ModelAt LinearAxis::model_at() const {
  return [this](double value) {
    if (!freed_) return family_.model(std::span(&value, 1));
    Model member = model_;
    Rotor& rotor = member.structure.rotors[*freed_];
    rotor.lead = {0.0};
    rotor.own = {value};
    return member;
  };
}

}  // namespace whirl::inline cli

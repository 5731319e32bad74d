#pragma once
/// The list of integrators. A member has a `name` and `integrate` (see methods/dop853.hpp).

#include <string_view>
#include <variant>
#include <vector>

#include "libdyn/methods/collocation.hpp"
#include "libdyn/methods/cvode.hpp"
#include "libdyn/methods/dop853.hpp"

namespace whirl {

using AnyMethod = std::variant<Dop853, CvodeAdams, CvodeBdf, Collocation>;

/// Names of all methods, in the order of the list.
std::vector<std::string_view> method_names();

/// The method of a name; "cvode" stands for cvode-adams.
/// @throws ModelError  for an unknown name, with the known ones
AnyMethod method_named(std::string_view name);

/// Integrates over whole revolutions; see Dop853::integrate.
inline Integration integrate(const AnyMethod& method, const ContactSystem& system,
                             MotionState& state, long revolutions,
                             const IntegrationOptions& options, const Observer& observer = {}) {
  return std::visit(
      [&](const auto& m) { return m.integrate(system, state, revolutions, options, observer); },
      method);
}

}  // namespace whirl

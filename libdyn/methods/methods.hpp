#pragma once
/// The list of integrators, the default first. A member has a `name` and `integrate` (see
/// methods/dop853.hpp).

#include <string_view>
#include <variant>
#include <vector>

#include "libdyn/methods/arkode.hpp"
#include "libdyn/methods/collocation.hpp"
#include "libdyn/methods/cvode.hpp"
#include "libdyn/methods/dop853.hpp"
#include "libdyn/methods/rk4.hpp"
#include "libdyn/taylor/taylor.hpp"

namespace whirl::inline dyn {

using AnyMethod =
    std::variant<Taylor, Collocation, Dop853, CvodeAdams, CvodeBdf, Arkode, ArkodeDirk, Rk4>;

/// The method that suits a system: collocation, whose steps do not follow fast modes, for modes
/// much faster than the contacts, else Taylor series.
AnyMethod suitable_method(const ContactSystem& system);

/// The name of a method.
std::string_view name_of_method(const AnyMethod& method);

/// What a method cannot do.
const Abilities& abilities_of(const AnyMethod& method);

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

}  // namespace whirl::inline dyn

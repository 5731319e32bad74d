#pragma once
/// What a call of `whirl torus` asks for.

#include <memory>
#include <optional>

#include "apps/verbs/branch_parameters.hpp"
#include "libdyn/studies/torus_branch.hpp"

namespace whirl::inline cli {

struct TorusCall {
  std::optional<BranchParameters> parameters{};
  TorusOptions options{};
  Model at_first{};  ///< the model at the first value
  std::shared_ptr<const Scene> scene{};

  ParameterAxis axis() const { return parameters ? parameters->along.axis : ParameterAxis{}; }
};

/// @throws ModelError  for options that are wrong
TorusCall torus_call(const Invocation& call, const Model& model);

}  // namespace whirl::inline cli

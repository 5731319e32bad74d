#pragma once
/// What `whirl continue` says.

#include "apps/verbs/continue_call.hpp"

namespace whirl::inline cli {

/// All of it, as JSON and for people.
Report continue_report(const Invocation& call, const Model& model, const ContinueCall& asked,
                       const FollowedBranches& found);

}  // namespace whirl::inline cli

#pragma once

#include <string>
#include <string_view>

#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Says where an integration failed: time, what contacts and films do, size of the state.
std::string failure_text(const ContactSystem& system, const MotionState& state,
                         std::string_view what);

/// Says that the journal of a film is not inside its bearing.
std::string left_bearing_text(const ReducedFilm& film);

/// Whether a state is beyond all bounds, or no number.
bool is_boundless(const ContactSystem& system, const Eigen::Ref<const Vec>& y);

/// Sets outcome and failure of an integration that failed: left_bearing where a journal has left
/// its bearing, else as given.
void fail(Integration& result, const ContactSystem& system, const MotionState& state,
          Outcome outcome, std::string_view what);

}  // namespace whirl::inline dyn

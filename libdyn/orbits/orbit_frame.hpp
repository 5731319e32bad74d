#pragma once

#include <array>

#include "libbase/structs/field.hpp"

namespace whirl::inline dyn {

/// The frame in which orbits are closed.
enum class OrbitFrame { stationary, rotating };
constexpr auto choices(OrbitFrame) {
  return std::array{Choice<OrbitFrame>{"stationary", OrbitFrame::stationary},
                    Choice<OrbitFrame>{"rotating", OrbitFrame::rotating}};
}

}  // namespace whirl::inline dyn

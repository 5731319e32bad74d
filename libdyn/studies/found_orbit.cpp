#include "libdyn/studies/found_orbit.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libdyn/orbits/cycle.hpp"

namespace whirl {

namespace {

constexpr long most_recurrence = 64;  ///< revolutions in which a motion is to come back

}  // namespace

double guessed_period(const Scene& scene, const Vec& start) {
  const auto guess = recurrence(scene, start, most_recurrence);
  if (guess) return *guess;
  throw NumericalError(
      fmt::format("the motion does not come back within {} revolutions as seen from the rotor, or "
                  "stands still there",
                  most_recurrence));
}

}  // namespace whirl

#pragma once
/// Touches of contacts in a recorded motion, in the order in which they begin.

#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/motions/simulate.hpp"

namespace whirl::inline dyn {

/// A touch as the samples of a recording show it: between two of them a shorter one is missed.
struct ContactTouch {
  std::string contact;
  double begins = 0.0, ends = 0.0;  ///< first and last sample in touch, since the start [s]
  double largest = 0.0;             ///< normal force [N]

  static constexpr auto columns() {
    using T = ContactTouch;
    return ColumnList{column("contact", &T::contact, "", "that touches"),
                      column("begins", &T::begins, "s", "first sample in touch, since the start"),
                      column("ends", &T::ends, "s", "last sample in touch, since the start"),
                      column("max_normal", &T::largest, "N", "largest normal force in between")};
  }
};

/// The last touches of all contacts.
/// @param most  how many at most
std::vector<ContactTouch> touches_of(const Recording& recording, std::size_t most = 1000);

}  // namespace whirl::inline dyn

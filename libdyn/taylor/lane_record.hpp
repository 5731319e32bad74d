#pragma once
/// What the engine keeps per lane in plain numbers.

#include <functional>
#include <memory>
#include <vector>

#include "libdyn/flow/free_flight.hpp"
#include "libdyn/system/events.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

struct LaneRecord {
  Trajectory* trajectory = nullptr;
  long last = 0;  ///< revolution at which it is done
  long revolution = 0;
  long first_revolution = 0;
  double first_phase = 0.0;
  long first_step = 0;  ///< of the engine, when it was loaded
  long no_steps = 0;    ///< of the engine, in which no time passed here
  int instant_events = 0;
  long events = 0;
  std::vector<double> impacts;
  long free_since = 0;       ///< revolution after the last contact
  long events_before = 0;    ///< at the end of the revolution before
  long certificate_due = 0;  ///< revolution at which free flight is looked into
  std::unique_ptr<FreeFlight> free_flight;
  std::unique_ptr<EventWatcher> watcher;  ///< for events that are rare
};

/// Asks every few hundred steps whether to go on.
struct Watch {
  long steps = 0, revolutions = 0;  ///< revolutions done in all lanes

  bool says_stop(const std::function<bool(long)>& ask) {
    constexpr long interval = 256;
    return ask && ++steps % interval == 0 && !ask(revolutions);
  }
};

}  // namespace whirl::inline dyn

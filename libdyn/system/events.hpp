#pragma once
/// Events of contacts: where they happen within a step, and what changes there.

#include <optional>
#include <span>

#include "libbase/numerics/polynomial.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// What can end the present state of a contact. Each kind has a function that is positive before
/// the event.
enum class EventKind : unsigned char {
  touch,        ///< apart:     1 - r^2 / clearance^2
  release,      ///< in touch:  N, or r^2 / clearance^2 - 1 for laws that are continuous
  pull,         ///< in touch, of laws with a rate factor: that factor
  retouch,      ///< receding:  -N, or minus the rate factor
  part,         ///< receding:  r^2 / clearance^2 - 1
  slip_stop,    ///< sliding:   sign of the slip times the slip velocity
  stick_limit,  ///< sticking:  (mu N)^2 - T^2, sums over contacts that slip alike
};

struct Event {
  double s = 0.0;  ///< place within the step, 0 to 1
  int contact = 0;
  EventKind kind = EventKind::touch;
};

/// Watches the contacts of one motion.
class EventWatcher {
 public:
  explicit EventWatcher(const ContactSystem& system);

  /// The first event within a step.
  std::optional<Event> first(const Step& step) const;

  /// Function of an event and its rate [1/s] at a state; dimensionless, positive before the event.
  double value(const Event& event, const Instant& at, const double* y,
               const ContactStates& states) const;

  /// The same from the forces of the event's contact, for all kinds but stick_limit, which asks for
  /// more.
  double value(const Event& event, const ContactForces& f, const ContactState& state) const;

  /// The function of stick_limit.
  double stick_margin(int contact, const Hold& hold) const;

  /// Changes the states of the contacts at an event. Contacts that slip alike begin and end to
  /// stick together.
  void apply(const Event& event, const Instant& at, const double* y, ContactStates& states);

  /// A step was made without an event inside: no contact starts on a surface any more.
  void moved_on();

  /// Kinds that can end a contact's state. Of contacts that stick and slip alike, the first one
  /// stands for all.
  std::span<const EventKind> kinds(int contact, const ContactStates& states) const;

  /// Whether the function of this kind is zero by definition at the start of the next step.
  bool on_surface(int contact, EventKind kind) const;

  /// Whether the slope of this function is zero there, too: of a slip that begins where sticking
  /// ends, as T is mu N then.
  bool is_level(int contact, EventKind kind) const;

 private:
  Polynomial polynomial(const Step& step, int contact, EventKind kind) const;
  void enter_touch(int contact, const Instant& at, const double* y, ContactStates& states);
  /// Sets the states of the contacts in touch that slip like a given one, and what is known of
  /// their slip at the event.
  void set_group(int contact, const ContactState& to, bool is_level, ContactStates& states);

  const ContactSystem& system_;
  std::vector<unsigned> surface_;  ///< per contact, a bit per kind
  std::vector<char> is_level_;     ///< per contact, of its slip
  std::vector<double> force_scale_, speed_scale_;
};

}  // namespace whirl::inline dyn

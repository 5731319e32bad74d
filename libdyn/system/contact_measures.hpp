#pragma once
/// What contacts do over a stretch of motion.

#include <array>
#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

enum class Regime { none, intermittent, permanent };
constexpr auto choices(Regime) {
  return std::array{Choice<Regime>{"none", Regime::none},
                    Choice<Regime>{"intermittent", Regime::intermittent},
                    Choice<Regime>{"permanent", Regime::permanent}};
}

/// What a contact of the model did over a stretch of motion: times, which add up.
struct ContactTimes {
  std::string name;
  double in_touch = 0.0;  ///< with any of its blades [s]
  double sticking = 0.0;  ///< [s]
  /// How often the contact came to touch, all blades together. Where the force lets go and presses
  /// again while the rotor stays beyond the surface, as with damped laws, there is no new touch.
  double impacts = 0.0;
  double max_normal = 0.0;      ///< of one blade [N]
  double max_tangential = 0.0;  ///< of one blade [N]

  /// Adds what the contact did in the stretch that follows.
  void append(const ContactTimes& later);
};

/// What a contact of the model does, with all of its blades together.
struct ContactMeasure {
  std::string name;
  double duty = 0.0;            ///< share of time in touch, with any of its blades
  double impacts = 0.0;         ///< as of ContactTimes
  double sticking = 0.0;        ///< share of time sticking
  double max_normal = 0.0;      ///< of one blade [N]
  double max_tangential = 0.0;  ///< of one blade [N]
  double mean_slip = 0.0;       ///< mean slip velocity while in touch [m/s]
  double touch_time = 0.0;      ///< time in touch, summed over blades [s]

  Regime regime() const {
    if (duty == 0.0) return Regime::none;
    return duty >= 1.0 ? Regime::permanent : Regime::intermittent;
  }
};

/// What friction at a contact does, of all of its blades; NaN: not told, as of older files.
struct FrictionLoad {
  double energy = nan;                         ///< that becomes heat [J]
  double mean_power = nan, max_power = nan;    ///< [W]
  double mean_torque = nan, max_torque = nan;  ///< about the axis of the rotor [N.m]
};

/// What a contact does in a motion.
struct ContactDoing {
  Regime regime = Regime::none;
  double duty = 0.0;             ///< share of time in touch
  double impacts_per_rev = 0.0;  ///< how often the contact begins to touch
  double sticking = 0.0;         ///< share of time
  double max_normal = 0.0;       ///< [N]
  double max_tangential = 0.0;   ///< [N]

  static constexpr auto columns() {
    using C = ContactDoing;
    return ColumnList{column("regime", &C::regime, "", "regime of a contact"),
                      column("duty", &C::duty, "", "share of time in touch"),
                      column("impacts_per_rev", &C::impacts_per_rev, "", "impacts per revolution"),
                      column("sticking", &C::sticking, "", "share of time sticking"),
                      column("max_normal", &C::max_normal, "N", "largest normal force"),
                      column("max_tangential", &C::max_tangential, "N", "largest friction force")};
  }
};
/// @param revolutions  of the measure; 0 counts as 1
ContactDoing contact_doing(const ContactMeasure& measure, long revolutions);

/// Times as shares of a whole [s]; slip velocities do not follow from times: NaN.
std::vector<ContactMeasure> shares_of(const std::vector<ContactTimes>& times, double whole);

/// Collects measures from the steps of a motion.
class ContactMeter {
 public:
  explicit ContactMeter(const ContactSystem& system);

  void add(const Step& step);
  /// Goes on with the same contacts in another system.
  void go_on_in(const ContactSystem& system) { system_ = &system; }

  /// Measures of all that was added.
  std::vector<ContactMeasure> measures() const;
  /// The same of friction.
  std::vector<FrictionLoad> friction() const;

 private:
  struct Sum {
    ContactTimes times;
    double touches = 0.0;                      ///< time in touch, summed over blades [s]
    double slip = 0.0;                         ///< distance slipped in that time [m]
    double heat = 0.0;                         ///< of friction [J]
    double impulse = 0.0;                      ///< of the moment of friction [N.m.s]
    double max_power = 0.0, max_torque = 0.0;  ///< [W], [N.m]
  };
  void add_heat(const Step& step, int k, const std::vector<ContactForces>& forces);

  const ContactSystem* system_;
  std::vector<Sum> sums_;
  std::vector<bool> was_apart_;
  bool has_begun_ = false;
  double time_ = 0.0;
};

}  // namespace whirl::inline dyn

#pragma once
/// When a contact touches on a periodic motion.

#include <functional>
#include <vector>

#include "libbase/numerics/fourier.hpp"
#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// A contact on the motion that closes it; two more rows are the motion where friction acts
/// elsewhere.
class PeriodicContact {
 public:
  /// @param contact  must live on, as must the motion
  /// @param motion   2 rows, or 4 of a contact that rubs apart
  PeriodicContact(const ReducedContact& contact, const Periodic& motion);

  /// A stretch of touching, without an event inside.
  struct Span {
    double from = 0.0, to = 0.0;  ///< angles, 0 <= from < 2 pi, to - from <= 2 pi
    double sign = 1.0;            ///< of the slip
    bool begins = true,
         ends = true;  ///< touches and releases there; else the slip changes its sign
    bool is_whole() const { return !begins && !ends && is_uncut; }
    bool is_uncut = false;  ///< the contact touches all the time and always slips in one sense
  };
  std::vector<Span> spans() const;

  /// Kinematics and normal force at an angle; friction is left zero.
  ContactForces at(double theta) const;

 private:
  double gap(const ContactForces& f) const;
  std::vector<Span> spans_between(const std::vector<double>& touches) const;
  /// Angles where a function of the forces changes its sign, ascending.
  std::vector<double> zeros(const std::function<double(const ContactForces&)>& f,
                            bool looks_between) const;

  const ReducedContact& contact_;
  const Periodic& motion_;
  /// Whether the contact is at the end where it began; an element of a rolling bearing may be where
  /// another one was.
  bool closes_;
  double stiffness_;  ///< that makes forces comparable with depths [N/m]
  std::vector<double> angles_;
  std::vector<ContactForces> grid_;
};

}  // namespace whirl::inline dyn

#pragma once
/// The hardest touches of motions, and what these would do to a machine.

#include <cstddef>
#include <vector>

#include "libcontact/contact.hpp"
#include "libdyn/system/contact_measures.hpp"

namespace whirl::inline dyn {

struct Model;

/// The largest forces at a contact over one or many motions, and in which of these.
struct HardestTouch {
  double normal = 0.0;      ///< [N]
  std::size_t pressed = 0;  ///< number of the motion with that normal force
  double rubbing = 0.0;     ///< largest friction force times the share of time in touch [N]
  std::size_t rubbed = 0;   ///< number of the motion with that friction
};

/// The hardest touches at each contact of a model.
class HardestTouches {
 public:
  /// Takes what contact number i does in motion number `motion`.
  void add(std::size_t motion, std::size_t i, double normal, double tangential, double duty);
  void add(std::size_t motion, const std::vector<ContactMeasure>& contacts);
  void add(std::size_t motion, const std::vector<ContactDoing>& contacts);

  const std::vector<HardestTouch>& contacts() const { return contacts_; }

 private:
  std::vector<HardestTouch> contacts_{};
};

/// Depth at which a contact law presses with a normal force, at rest [m]. NaN: the force jumps at a
/// touch, so that it tells no depth.
double depth_under(const AnyContactLaw<>& law, double normal);

/// What friction at a contact takes from a rotor whose speed is kept.
struct FrictionPower {
  double power = 0.0;        ///< at most, friction force times speed of the rim [W]
  double revolutions = 0.0;  ///< until friction has taken the energy of the spin; NaN: not known
};
/// @param rubbing  as of HardestTouch [N]
FrictionPower friction_power(const Model& model, const Contact& contact, double rubbing);

}  // namespace whirl::inline dyn

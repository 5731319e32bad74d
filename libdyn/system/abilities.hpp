#pragma once
/// What systems ask of whoever computes their motions, and who cannot do it.

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// Something that a system has and not every method or solver can compute.
enum class Need {
  other_orders,         ///< forces of another order than 1
  several_revolutions,  ///< forces that repeat after several revolutions, not after each
  irrational_orders,    ///< forces that never repeat with the revolution
  own_frequencies,      ///< forces with a frequency of their own
  films,                ///< oil films
  blades,               ///< contacts with many places, which turn
  faces,                ///< contacts whose friction acts elsewhere than the normal force
  saturation,           ///< signals that saturate
  standstill,           ///< a rotor that does not spin forward
  directions            ///< gravity, bearings, contacts or forces that tell directions apart
};
inline constexpr std::array needs{Need::other_orders,
                                  Need::several_revolutions,
                                  Need::irrational_orders,
                                  Need::own_frequencies,
                                  Need::films,
                                  Need::blades,
                                  Need::faces,
                                  Need::saturation,
                                  Need::standstill,
                                  Need::directions};

/// A need in words.
std::string_view name_of(Need need);

/// Whether a system has a need. Whether it tells directions apart only its motions say, see
/// rotating_flow: false.
bool has_need(const ContactSystem& system, Need need);

/// What somebody who computes motions cannot do; all else they can.
struct Abilities {
  std::string_view who;  ///< "method collocation"
  std::span<const Need> cannot{};
  std::string_view instead{};  ///< what a user can do then: "take the method taylor"

  bool can(Need need) const;
  /// Whether a system needs nothing else.
  bool can(const ContactSystem& system) const;
  /// The sentence that refuses a need.
  std::string refusal(Need need) const;
  /// The sentence that refuses a system, with the first need that is too much; empty: it is none.
  std::string refusal(const ContactSystem& system) const;
  /// @throws ModelError  with that sentence
  void require(const ContactSystem& system) const;
};

}  // namespace whirl::inline dyn

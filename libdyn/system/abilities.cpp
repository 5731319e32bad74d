#include "libdyn/system/abilities.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"

namespace whirl::inline dyn {

static_assert(needs.size() == static_cast<std::size_t>(Need::directions) + 1, "all are listed");

namespace {

bool any_load(const ContactSystem& system, bool has_order) {
  const auto loads = system.other_loads();
  return std::any_of(loads.begin(), loads.end(), [&](const ReducedExcitation& load) {
    return (load.order > 0.0) == has_order;
  });
}

template <class Is>
bool any_contact(const ContactSystem& system, const Is& is) {
  return std::any_of(system.contacts().begin(), system.contacts().end(), is);
}

}  // namespace

std::string_view name_of(Need need) {
  switch (need) {
    case Need::other_orders:
      return "a force of another order than 1";
    case Need::several_revolutions:
      return "forces or cages that repeat after several revolutions only";
    case Need::irrational_orders:
      return "a force or cage of an order that is no fraction of small whole numbers";
    case Need::own_frequencies:
      return "a force with a frequency of its own";
    case Need::films:
      return "an oil film";
    case Need::blades:
      return "a contact of blades or rolling elements";
    case Need::faces:
      return "a contact of a face";
    case Need::saturation:
      return "a current or voltage that saturates";
    case Need::standstill:
      return "a rotor that does not spin forward";
    case Need::directions:
      return "gravity, bearings, contacts or forces that tell directions apart";
  }
  return "";
}

bool has_need(const ContactSystem& system, Need need) {
  switch (need) {
    case Need::other_orders:
      return any_load(system, true);
    case Need::several_revolutions:
      return system.repeats_after() > 1;
    case Need::irrational_orders:
      return !any_load(system, false) && system.repeats_after() == 0;
    case Need::own_frequencies:
      return any_load(system, false);
    case Need::films:
      return !system.films().empty();
    case Need::blades:
      return any_contact(system, [](const ReducedContact& c) { return c.turns(); });
    case Need::faces:
      return any_contact(system,
                         [](const ReducedContact& c) { return c.rubs_apart() && !c.is_limit(); });
    case Need::saturation:
      return any_contact(system, [](const ReducedContact& c) { return c.is_limit(); });
    case Need::standstill:
      return !(system.Omega() > 0.0);
    case Need::directions:
      return false;
  }
  return false;
}

bool Abilities::can(Need need) const {
  return std::find(cannot.begin(), cannot.end(), need) == cannot.end();
}

bool Abilities::can(const ContactSystem& system) const {
  return std::none_of(cannot.begin(), cannot.end(),
                      [&](Need need) { return has_need(system, need); });
}

std::string Abilities::refusal(Need need) const {
  return fmt::format("not possible with {}{}{}", name_of(need), instead.empty() ? "" : ": ",
                     instead);
}

std::string Abilities::refusal(const ContactSystem& system) const {
  for (const Need need : cannot) {
    if (has_need(system, need)) return refusal(need);
  }
  return "";
}

void Abilities::require(const ContactSystem& system) const {
  const std::string sentence = refusal(system);
  if (!sentence.empty()) throw ModelError({std::string(who)}, "", sentence);
}

}  // namespace whirl::inline dyn

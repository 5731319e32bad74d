#include "libio/texts/resonance_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// Sizes of the orbits of both modes in the contacts: "0.10 0.32 | 0.95 0.04".
std::string sizes_text(const ResonancePlace& place) {
  std::string fast, slow;
  for (const ContactOrbits& c : place.contacts) {
    const auto add = [](std::string& all, double size) {
      all += (all.empty() ? "" : " ") + (std::isfinite(size) ? fmt::format("{:.2f}", size) : "-");
    };
    add(fast, c.fast);
    add(slow, c.slow);
  }
  return fast + " | " + slow;
}

std::string bouncing_text(const ResonancePlace& place) {
  const std::optional<Bouncing>& b = place.bouncing;
  if (!place.is_confirmed) return "not looked for";
  if (!b) return "none found";
  return fmt::format("{} at {}, {:.4f} revolutions", b->is_stable() ? "stable" : "unstable",
                     shown_value(b->speed, "rpm", ".1f"), b->turns);
}

std::string seen_from_rotor(const ResonancePlace& r) {
  return fmt::format("{}, {}", shown_number(r.p * r.frequency, "rpm", ".1f"),
                     shown_number(r.q * r.frequency, "rpm", ".1f"));
}

}  // namespace

std::string text_of(const ResonanceStudy& study) {
  if (study.places.empty()) return "  none between these speeds\n";
  const auto branch = [&](int number) {
    return fmt::format("{} {}", number + 1,
                       name_of(study.diagram.branches[static_cast<std::size_t>(number)].whirl));
  };
  TableColumns<ResonancePlace> columns{
      shown("speed", "rpm", ".1f"),
      {"ratio", [](const ResonancePlace& r) { return fmt::format("{}:{}", r.p, r.q); }},
      {"faster mode", [&](const ResonancePlace& r) { return branch(r.fast); }},
      {"slower mode", [&](const ResonancePlace& r) { return branch(r.slow); }},
      {shown_heading("seen from the rotor", "rpm"), seen_from_rotor}};
  const std::vector<ContactOrbits>& contacts = study.places.front().contacts;
  if (!contacts.empty()) columns.push_back({"at the contacts", sizes_text});
  if (study.is_confirmed) columns.push_back({"bouncing", bouncing_text});
  std::string text = table_of(study.places, columns), names;
  for (const ContactOrbits& c : contacts) names += (names.empty() ? "" : ", ") + c.name;
  if (names.empty()) return text;
  return text +
         fmt::format(
             "\n  at the contacts ({}): orbits of both modes by their largest on the rotor\n",
             names);
}

}  // namespace whirl::inline io

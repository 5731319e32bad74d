#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_member.hpp"
#include "libio/model/read_parts.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline io {

namespace {

/// Keys that only members have which were not chosen: each is told once, with all that have it.
template <class List>
void refuse_others(TableReader& table, std::string_view key, const List& chosen) {
  std::vector<std::pair<std::string, std::string>> owners;  // of the keys that are there
  std::set<std::string> own;
  for_each_with_keys<List>([&](const auto& member) {
    for (const std::string& name : keys_of_member(member)) {
      if (member.name == name_of(chosen)) own.insert(name);
      if (!table.has(name)) continue;
      const auto known = std::find_if(owners.begin(), owners.end(),
                                      [&](const auto& owner) { return owner.first == name; });
      if (known == owners.end()) {
        owners.emplace_back(name, in_quotes(member.name));
      } else {
        known->second += " or " + in_quotes(member.name);
      }
    }
  });
  for (const auto& [name, members] : owners) {
    if (own.contains(name)) continue;
    table.node(name);
    table.problem(name, fmt::format("goes with {} = {}", key, members));
  }
}

/// What does not go with a contact's geometry.
void check_geometry(const Contact& contact, TableReader& table) {
  const AnyGeometry geometry = geometry_of(contact);
  if (own_geometry(contact.law) && table.has("geometry")) {
    table.problem("geometry", "the law says what it touches: leave it out");
  }
  if (rim_radius_of(geometry) && table.has("radius")) {
    table.problem("radius", "the law says where it slips: leave it out");
  }
  if (contact.friction.is_exact() && !may_stick(geometry)) {
    table.problem(
        "slip_tolerance",
        "found none, but this contact cannot stick: give a width to the sign of the slip, such "
        "as \"1 mm/s\", or say slip = \"forward\"");
  }
  if (!takes_offset(geometry) && table.has("offset")) {
    table.problem("offset",
                  fmt::format("a {} has none: its clearance is axial", name_of(geometry)));
  }
  if (const auto problem = problem_of(geometry)) {
    table.problem(problem->key,
                  fmt::format("found {:g}, expected {}", problem->found, problem->expected));
  }
  if (const auto* tips = std::get_if<BladeTip<>>(&contact.law)) {
    table.at_most("blades", tips->blades, 1000);
    if (tips->blade_length > tips->tip_radius && tips->tip_radius > 0.0) {
      table.problem("blade_length", "is more than the tip_radius, in which it lies");
    }
  }
}

void read_contacts(ModelReading& reading) {
  reading.for_each("contact", [&](TableReader& table, std::size_t i) {
    Contact contact;
    contact.where = table.where();
    contact.name = table.string("name").value_or(fmt::format("contact {}", i + 1));
    const auto at = reading.station(table);
    if (at) contact.at = *at;
    if (const auto against = table.string("against")) {
      if (const auto s = reading.named_station(*against, table, "against", true, at)) {
        contact.against = *s;
      }
      if (at && at->kind == Station::Kind::body && at->body == *against) {
        table.problem("against", "the body would touch itself");
      }
    }
    table.read(contact);
    table.read(contact.friction);
    read_member(table, "law", contact.law);
    if (read_member(table, "geometry", contact.geometry)) {
      refuse_others(table, "geometry", contact.geometry);
    }
    contact.offset = read_center(table);
    check_geometry(contact, table);
    const AnyGeometry geometry = geometry_of(contact);
    const auto rim = rim_radius_of(geometry);
    if (rim) contact.friction.radius = *rim;
    const Body* body = at ? reading.body_at(*at) : nullptr;
    if (body && !body->tilts && closing_of(geometry) == Closing::tilts) {
      table.problem("body",
                    fmt::format("a {} touches as it tilts, but {} does not: give it tilts = true",
                                name_of(geometry), in_quotes(at->body)));
    }
    if (!table.has("radius") && !rim) {
      reading.missing_radii.push_back(
          {reading.model.contacts.size(), table.where(), table.path("radius")});
    }
    if (at) reading.model.structure.stations.push_back(*at);
    if (contact.against.kind == Station::Kind::position) {
      reading.model.structure.stations.push_back(contact.against);
    }
    reading.model.contacts.push_back(contact);
  });
}

}  // namespace

ModelTable contact_table() {
  return {.name = "contact",
          .meaning = "where the rotor may touch a stator",
          .read = read_contacts,
          .is_of_rotor = false,
          .example =
              "body = \"b\"\n"
              "clearance = 1\n"
              "stiffness = 1\n",
          .switches = {{"law", "radial"}, {"geometry", "ring"}},
          .notes = {{"law", "law of the normal force", "\"radial\""},
                    {"geometry", "what touches what, of a law that leaves it open", "\"ring\""},
                    {"offset", "[x, y] of the center of the clearance circle", "[0, 0]"}}};
}

}  // namespace whirl::inline io

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "libio/model/model_builder.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"

namespace whirl {

namespace {

/// Reads the law of the given name into the contact.
template <std::size_t... I>
void read_law(const std::string& name, TableReader& table, AnyContactLaw<>& to,
              std::index_sequence<I...>) {
  const auto try_one = [&](auto law) {
    if (decltype(law)::name != name) return;
    table.read(law);
    to = law;
  };
  (try_one(std::variant_alternative_t<I, AnyContactLaw<>>{}), ...);
}

template <std::size_t... I>
std::vector<std::string> law_names(std::index_sequence<I...>) {
  return {std::string(std::variant_alternative_t<I, AnyContactLaw<>>::name)...};
}
/// Keys of all laws, so that a wrong name of the law is one mistake and not many.
template <std::size_t... I>
void accept_all_laws(TableReader& table, std::index_sequence<I...>) {
  const auto accept = [&](const auto&... field) { (table.node(field.name), ...); };
  (std::apply(accept, std::variant_alternative_t<I, AnyContactLaw<>>::fields()), ...);
}
/// What does not go with a law's geometry.
void check_geometry(const Contact& contact, TableReader& table) {
  const Geometry geometry = geometry_of(contact.law);
  if (geometry == Geometry::ring) return;
  if (table.has("radius")) {
    table.problem("radius", "the law says where it slips: leave it out");
  }
  if (contact.friction.is_exact() && !can_stick(geometry)) {
    table.problem(
        "slip_tolerance",
        "found none, but this law cannot stick: give a width to the sign of the slip, such "
        "as \"1 mm/s\", or say slip = \"forward\"");
  }
  if (geometry == Geometry::face && table.has("offset")) {
    table.problem("offset", "a face has none: its clearance is axial");
  }
  if (const auto* tips = std::get_if<BladeTip<>>(&contact.law)) {
    table.at_most("blades", tips->blades, 1000);
    if (tips->blade_length > tips->tip_radius && tips->tip_radius > 0.0) {
      table.problem("blade_length", "is more than the tip_radius, in which it lies");
    }
  }
}

constexpr auto laws = std::make_index_sequence<std::variant_size_v<AnyContactLaw<>>>{};

}  // namespace

void ModelBuilder::read_contacts() {
  for_each("contact", [&](TableReader& table, std::size_t i) {
    Contact contact;
    contact.where = table.where();
    contact.name = table.string("name").value_or(fmt::format("contact {}", i + 1));
    const auto at = station(table);
    if (at) contact.at = *at;
    if (const auto against = table.string("against")) {
      if (const auto s = named_station(*against, table, "against")) contact.against = *s;
      if (at && at->kind == Station::Kind::body && at->body == *against) {
        table.problem("against", "the body would touch itself");
      }
    }
    table.read(contact);
    table.read(contact.friction);
    const auto law = table.choice("law", law_names(laws));
    if (!law && table.has("law")) {
      accept_all_laws(table, laws);
    } else {
      read_law(law.value_or("radial"), table, contact.law, laws);
    }
    contact.offset = center(table);
    check_geometry(contact, table);
    if (const auto* face = std::get_if<Face<>>(&contact.law)) {
      contact.friction.radius = face->radius;
    } else if (const auto* tips = std::get_if<BladeTip<>>(&contact.law)) {
      contact.friction.radius = tips->tip_radius;
    }
    if (at && at->kind == Station::Kind::body && geometry_of(contact.law) == Geometry::face) {
      const auto& bodies = model_.structure.bodies;
      const auto body = std::find_if(bodies.begin(), bodies.end(),
                                     [&](const Body& b) { return b.name == at->body; });
      if (body != bodies.end() && !body->tilts) {
        table.problem("body", fmt::format("a face touches as it tilts, but {} does not: give it "
                                          "tilts = true",
                                          in_quotes(at->body)));
      }
    }
    if (!table.has("radius") && geometry_of(contact.law) == Geometry::ring) {
      missing_radii_.push_back({model_.contacts.size(), table.where(), table.path("radius")});
    }
    if (at) model_.structure.stations.push_back(*at);
    model_.contacts.push_back(contact);
  });
}

}  // namespace whirl

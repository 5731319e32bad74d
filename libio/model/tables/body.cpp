#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

namespace {

/// A mass, or [along x, along y].
void read_mass(TableReader& table, const auto& field, PlanarMass& to) {
  const ConfigNode* node = table.node(field.name);
  if (node && node->kind == ConfigNode::Kind::array) {
    const auto both =
        table.pair(field.name, field.unit, field.range, "one mass, or [along x, along y]");
    if (both) to = {both->front(), both->back()};
  } else if (const auto mass = table.quantity(field.name, field.unit, field.range, true)) {
    to = *mass;
  }
}

void read_bodies(ModelReading& reading) {
  reading.for_each("body", [&](TableReader& table, std::size_t) {
    Body body;
    body.where = table.where();
    if (const auto name = table.string("name", true)) body.name = *name;
    if (table.has("name") && body.name.empty())
      table.problem("name", "a body needs a name that is not empty");
    if (body.name == "ground")
      table.problem("name", "\"ground\" is what does not move; choose another name");
    table.read(body, [&](const auto& field, PlanarMass& to) { read_mass(table, field, to); });
    body.rotor = reading.rotor_at(table, "rotor");
    if (!body.rotor.empty() && !body.spins) {
      table.problem("rotor", "only a body with spins = true turns with a rotor");
    }
    if (body.spins && body.m.x != body.m.y) {
      table.problem("mass",
                    "a body that spins has the same mass along x and y, expected one value");
    }
    if (!body.tilts) {
      for (const char* key : {"diametral_inertia", "polar_inertia"}) {
        if (table.has(key))
          table.problem(key, "only a body with tilts = true has moments of inertia");
      }
    }
    reading.model.structure.bodies.push_back(body);
  });
}

}  // namespace

ModelTable body_table() {
  return {.name = "body",
          .meaning = "lumped masses: stators, pedestals, the mass of a Jeffcott rotor",
          .read = read_bodies,
          .turn = ModelTable::Turn::early,
          .example =
              "name = \"c\"\n"
              "mass = 1\n",
          .as_tables = "mass = [1, 1]\n"};
}

}  // namespace whirl::inline io

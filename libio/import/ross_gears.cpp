#include "libio/import/ross_gears.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace whirl::inline io {

namespace {

using std::numbers::pi;

/// Density and Young's modulus of a gear, 0 where they are not told [kg/m^3], [Pa].
std::pair<double, double> gear_material(const RossSection& s, UnreadKeys& unread) {
  const ConfigNode* table = s.find("material");
  if (!table || table->kind != ConfigNode::Kind::table) return {};
  const RossSection material(s, "material", *table);
  const std::pair found(material.number_or("rho", 0.0), material.number_or("E", 0.0));
  for (const char* key : {"name", "G_s"}) material.find(key);
  material.add_unread(unread);
  return found;
}

double pitch_diameter(const RossSection& s, double teeth, double pressure_angle) {
  const double pitch = s.number_or("pitch_diameter", 0.0), base = s.number_or("base_diameter", 0.0),
               module = s.number_or("module", 0.0);
  if (pitch > 0.0) return pitch;
  return base > 0.0 ? base / std::cos(pressure_angle) : module * teeth;
}

}  // namespace

void read_ross_gear(const RossSection& s, RossRotor& rotor, UnreadKeys& unread) {
  RossGear gear{.name = s.tag(), .node = s.node("n"), .teeth = s.number_or("n_teeth", 0.0)};
  const double before_2_1 = s.number_or("pressure_angle", pi / 9.0);
  gear.pressure_angle = s.number_or("pr_angle", before_2_1);
  gear.helix_angle = s.number_or("helix_angle", 0.0);
  gear.width = s.number_or("width", 0.0);
  const double d = pitch_diameter(s, gear.teeth, gear.pressure_angle);
  const double bore = s.number_or("bore_diameter", 0.0);
  const auto [rho, E] = gear_material(s, unread);
  gear.pitch_radius = d > 0.0 && std::isfinite(d) ? 0.5 * d : 0.0;
  gear.E = E;
  const double area = 0.25 * pi * (d * d - bore * bore);
  RossDisk disk{.where = s.where(), .name = gear.name, .node = gear.node};
  if (s.has("m") || gear.width <= 0.0 || area <= 0.0) {
    disk.m = s.number("m");
    disk.Id = s.number("Id");
    disk.Ip = s.number("Ip");
    if (gear.width <= 0.0 && bore > 0.0 && rho * area > 0.0) gear.width = disk.m / (rho * area);
  } else {  // a hollow cylinder
    disk.m = rho * area * gear.width;
    disk.Ip = disk.m * (d * d + bore * bore) / 8.0;
    disk.Id = 0.5 * disk.Ip + disk.m * gear.width * gear.width / 12.0;
  }
  rotor.disks.push_back(std::move(disk));
  rotor.gears.push_back(std::move(gear));
}

void read_ross_shafts(const RossSection& parameters, RossRotor& rotor) {
  if (parameters.find("speed_ratio")) rotor.speed_ratio = parameters.number("speed_ratio");
  rotor.mesh.nodes = parameters.numbers("coupled_nodes");
  rotor.mesh.stiffness = parameters.number_or("gear_mesh_stiffness", 0.0);
  if (parameters.find("orientation_angle")) {
    rotor.mesh.centers = parameters.number("orientation_angle");
  }
}

std::optional<double> mesh_stiffness(const RossGear& driving, const RossGear& driven) {
  for (const RossGear* gear : {&driving, &driven}) {
    if (gear->teeth <= 0.0 || gear->pitch_radius <= 0.0 || gear->E <= 0.0) return std::nullopt;
  }
  if (driving.width <= 0.0) return std::nullopt;
  const double alpha = driving.pressure_angle;
  const double module = 2.0 * driving.pitch_radius / driving.teeth;
  double contact_length = -(driving.pitch_radius + driven.pitch_radius) * std::sin(alpha);
  for (const RossGear* gear : {&driving, &driven}) {
    const double tip = gear->pitch_radius * (1.0 + 2.0 / gear->teeth);
    contact_length +=
        std::sqrt(tip * tip - std::pow(gear->pitch_radius * std::cos(gear->pressure_angle), 2));
  }
  const double contact_ratio = contact_length / (pi * module * std::cos(alpha));
  const double k =
      contact_ratio * driving.width * driving.E * driven.E / (9.0 * (driving.E + driven.E));
  return k > 0.0 && std::isfinite(k) ? std::optional(k) : std::nullopt;
}

}  // namespace whirl::inline io

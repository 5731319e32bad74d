#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/page/part_sheets.hpp"
#include "libio/text/format.hpp"

namespace whirl::inline io {

namespace {

/// What a law or geometry is told, "stiffness 4 MN/m, damping 0 N.s/m".
template <class Part>
std::string told(const Part& part) {
  std::string text;
  std::apply(
      [&](const auto&... field) {
        [[maybe_unused]] const auto add = [&](const auto& f) {
          using Member = std::remove_cvref_t<decltype(part.*(f.member))>;
          std::string value;
          if constexpr (std::is_same_v<Member, double>) {
            value = format_engineering(part.*(f.member), f.unit);
          } else if constexpr (std::is_enum_v<Member>) {
            value = name_of(part.*(f.member));
          } else if constexpr (std::is_arithmetic_v<Member>) {
            value = fmt::format("{}", part.*(f.member));
          } else {
            return;
          }
          std::string name(f.name);
          std::replace(name.begin(), name.end(), '_', ' ');
          text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
        };
        (add(field), ...);
      },
      Part::fields());
  return text;
}

template <class Any>
std::string told_any(const Any& any) {
  return std::visit(
      [](const auto& part) {
        std::string more;
        if constexpr (requires { part.fields(); }) more = told(part);
        return std::string(part.name) + (more.empty() ? "" : ": " + more);
      },
      any);
}

Sheet disks_sheet(const ModelParts& parts) {
  double mass = 0.0;
  for (const Disk& disk : parts.structure.disks) mass += disk.m;
  return {"Disks",
          sheet_table(
              parts.structure.disks,
              {{"disk", [](const Disk& d) { return d.name; }},
               {shown_heading("at z", "mm"), [&](const Disk& d) { return z_text(d.at, parts); }},
               {shown_heading("mass", "kg"), [](const Disk& d) { return shown_digits(d.m, "kg"); }},
               {shown_heading("polar inertia", "kg.m^2"),
                [](const Disk& d) { return shown_digits(d.Ip, "kg.m^2"); }},
               {shown_heading("diametral inertia", "kg.m^2"),
                [](const Disk& d) { return shown_digits(d.Id, "kg.m^2"); }}}),
          {fmt::format("Mass of all disks: {}.", format_engineering(mass, "kg"))}};
}

Sheet bodies_sheet(const ModelParts& parts) {
  return {"Bodies", sheet_table(parts.structure.bodies,
                                {{"body", [](const Body& b) { return b.name; }},
                                 {shown_heading("mass along x", "kg"),
                                  [](const Body& b) { return shown_digits(b.m.x, "kg"); }},
                                 {shown_heading("along y", "kg"),
                                  [](const Body& b) { return shown_digits(b.m.y, "kg"); }},
                                 {"spins", [](const Body& b) { return b.spins ? "yes" : "no"; }},
                                 {"tilts", [](const Body& b) { return b.tilts ? "yes" : "no"; }},
                                 {shown_heading("polar inertia", "kg.m^2"),
                                  [](const Body& b) { return shown_digits(b.Ip, "kg.m^2"); }},
                                 {shown_heading("diametral inertia", "kg.m^2"),
                                  [](const Body& b) { return shown_digits(b.Id, "kg.m^2"); }}})};
}

std::string begins(const Unbalance& u) {
  if (!u.begins.is_late()) return "-";
  return u.begins.time > 0.0 ? fmt::format("{:g} s", u.begins.time)
                             : fmt::format("{:g} rev", u.begins.revolutions);
}

Sheet unbalances_sheet(const ModelParts& parts) {
  const std::vector<Unbalance>& all = parts.structure.unbalances;
  TableColumns<Unbalance> columns{
      row_number("number"),
      {shown_heading("at z", "mm"), [&](const Unbalance& u) { return z_text(u.at, parts); }},
      {shown_heading("moment", "g.mm"),
       [](const Unbalance& u) { return shown_digits(u.moment, "g.mm"); }},
      {"phase [deg]", [](const Unbalance& u) { return five_digits(u.phase / degree); }}};
  if (std::ranges::any_of(all, [](const Unbalance& u) { return u.begins.is_late(); })) {
    columns.push_back({"begins", [](const Unbalance& u) { return begins(u); }});
  }
  return {"Unbalances of the model", sheet_table(all, columns)};
}

std::string acts(const Force& f) {
  if (f.is_constant()) return "constant";
  return f.order != 0.0 ? fmt::format("{:g} times the speed", f.order)
                        : fmt::format("{:g} Hz", f.frequency / hertz);
}

Sheet forces_sheet(const ModelParts& parts) {
  const auto unit = [](const Force& f) {
    return f.kind == ForceKind::force ? "N" : f.kind == ForceKind::moment ? "N.m" : "m/s^2";
  };
  return {
      "Forces",
      sheet_table(parts.structure.forces,
                  {{"force", [](const Force& f) { return f.name; }},
                   {shown_heading("at z", "mm"),
                    [&](const Force& f) { return f.has_station() ? z_text(f.at, parts) : "base"; }},
                   {"size", [=](const Force& f) { return format_engineering(f.size, unit(f)); }},
                   {"direction",
                    [](const Force& f) {
                      if (f.turning == Turning::no)
                        return fmt::format("{:g}° from +x", f.angle / degree);
                      return "turns " + std::string(name_of(f.turning));
                    }},
                   {"frequency", acts},
                   {"phase [deg]", [](const Force& f) { return five_digits(f.phase / degree); }}})};
}

Sheet probes_sheet(const ModelParts& parts) {
  return {
      "Probes",
      sheet_table(
          parts.structure.probes,
          {{"probe", [](const Probe& p) { return p.name; }},
           {shown_heading("at z", "mm"), [&](const Probe& p) { return z_text(p.at, parts); }},
           {"angle from +x [deg]", [](const Probe& p) { return five_digits(p.angle / degree); }},
           {"looks", [](const Probe& p) {
              return p.is_axial()
                         ? fmt::format("along the shaft, radius {}", format_length(p.face_radius))
                         : std::string("across the shaft");
            }}})};
}

Sheet contacts_sheet(const ModelParts& parts) {
  return {"Contacts",
          sheet_table(
              stator_contacts(parts.model.contacts),
              {{"contact", [](const Contact& c) { return c.name; }},
               {shown_heading("at z", "mm"), [&](const Contact& c) { return z_text(c.at, parts); }},
               {"against", [&](const Contact& c) { return z_text(c.against, parts); }},
               {"geometry", [](const Contact& c) { return told_any(geometry_of(c)); }},
               {shown_heading("clearance", "mm"),
                [](const Contact& c) { return shown_digits(c.clearance, "mm"); }},
               {"law of the normal force", [](const Contact& c) { return told_any(c.law); }},
               {"friction", [](const Contact& c) { return five_digits(c.friction.mu); }}})};
}

}  // namespace

std::vector<Sheet> attached_sheets(const ModelParts& parts) {
  const Structure& s = parts.structure;
  std::vector<Sheet> sheets;
  const auto add = [&](bool is_there, Sheet (*make)(const ModelParts&)) {
    if (is_there) sheets.push_back(make(parts));
  };
  add(!s.disks.empty(), disks_sheet);
  add(!s.bodies.empty(), bodies_sheet);
  add(!s.unbalances.empty(), unbalances_sheet);
  add(!s.forces.empty(), forces_sheet);
  add(!s.probes.empty(), probes_sheet);
  add(!stator_contacts(parts.model.contacts).empty(), contacts_sheet);
  return sheets;
}

std::vector<Sheet> model_sheets(const ModelParts& parts) {
  std::vector<Sheet> all;
  for (const auto& make : {shaft_sheets, attached_sheets, connection_sheets}) {
    for (Sheet& sheet : make(parts)) all.push_back(std::move(sheet));
  }
  return all;
}

std::string z_text(const Station& station, const ModelParts& parts) {
  if (station.kind == Station::Kind::ground) return "ground";
  const Point point = resolve(station, parts.structure, parts.mesh);
  const auto index = static_cast<std::size_t>(point.index);
  if (point.kind == Point::Kind::ground) return "ground";
  if (point.kind == Point::Kind::body) return "body " + parts.structure.bodies[index].name;
  return shown_digits(parts.mesh.z[index], "mm", 6);
}

}  // namespace whirl::inline io

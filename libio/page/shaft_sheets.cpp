#include <fmt/format.h>

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/stations.hpp"
#include "libio/page/part_sheets.hpp"

namespace whirl::inline io {

namespace {

std::string length_text(double length) {
  return shown_digits(length, "mm", 6);
}

/// "300" of a cylinder, "300 to 280" of a cone, in the shown unit of mm.
std::string diameters(double left, double right) {
  if (left == right) return length_text(left);
  return fmt::format("{} to {}", length_text(left), length_text(right));
}

std::string formula_text(const ShearCoefficient& shear) {
  switch (shear.formula) {
    case ShearFormula::cowper:
      return "Cowper";
    case ShearFormula::hutchinson:
      return "Hutchinson";
    case ShearFormula::given:
      break;
  }
  return fmt::format("{:.4g}", shear.value);
}

Sheet materials_sheet(const Structure& s) {
  std::vector<Material> materials;
  const auto add = [&](const Material& material) {
    if (std::find(materials.begin(), materials.end(), material) == materials.end()) {
      materials.push_back(material);
    }
  };
  for (const Structure::Shaft& shaft : s.shafts()) {
    for (const Segment& segment : shaft.segments) add(segment.material);
  }
  for (const Layer& layer : s.layers) add(layer.material);
  return {"Materials",
          sheet_table(materials, {{"material", [](const Material& m) { return m.name; }},
                                  {shown_heading("density", "kg/m^3"),
                                   [](const Material& m) { return shown_digits(m.rho, "kg/m^3"); }},
                                  {shown_heading("Young's modulus", "GPa"),
                                   [](const Material& m) { return shown_digits(m.E, "GPa"); }},
                                  {shown_heading("shear modulus", "GPa"),
                                   [](const Material& m) { return shown_digits(m.G, "GPa"); }},
                                  {shown_heading("internal damping", "s"),
                                   [](const Material& m) { return shown_digits(m.eta, "s"); }}})};
}

/// @param number  of the shaft, from 0
Sheet sections_sheet(const ModelParts& parts, const Structure::Shaft& shaft, int number) {
  FigureTable table{.header = {"section", shown_heading("from", "mm"), shown_heading("to", "mm"),
                               shown_heading("outer diameter", "mm"),
                               shown_heading("inner diameter", "mm"), "material", "elements",
                               "beam theory", "shear coefficient"}};
  double z = shaft.start;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const Segment& part = shaft.segments[i];
    const auto elements = std::ranges::count_if(parts.mesh.elements, [&](const MeshElement& e) {
      return e.shaft == number && e.segment == static_cast<int>(i);
    });
    table.rows.push_back({std::to_string(i + 1), length_text(z), length_text(z + part.length),
                          diameters(part.left.outer, part.right.outer),
                          diameters(part.left.inner, part.right.inner), part.material.name,
                          std::to_string(elements), std::string(name_of(part.theory)),
                          part.theory == Theory::timoshenko ? formula_text(part.shear) : "-"});
    z += part.length;
  }
  Sheet sheet{
      shaft.name.empty() ? "Sections of the shaft"
      : shaft.has_own_speed()
          ? fmt::format("Sections of rotor {}, at a speed of its own", shaft.name)
          : fmt::format("Sections of rotor {}, {:.6g} times the speed", shaft.name, shaft.ratio),
      table};
  tell_common(sheet, 3);
  const auto tells = [&](const auto& has, const char* text) {
    if (std::ranges::any_of(shaft.segments, has)) sheet.notes.emplace_back(text);
  };
  tells([](const Segment& p) { return p.axial_force != 0.0; }, "Some sections carry axial force.");
  tells([](const Segment& p) { return p.torque != 0.0; }, "Some sections carry torque.");
  return sheet;
}

Sheet layers_sheet(const ModelParts& parts) {
  const Structure& s = parts.structure;
  Sheet sheet{
      "Layers on the shaft (sleeves, hubs)",
      sheet_table(
          s.layers,
          {{"layer", [](const Layer& l,
                        int number) { return l.name.empty() ? std::to_string(number) : l.name; }},
           {shown_heading("from", "mm"),
            [&](const Layer& l) { return length_text(span_of(l, s, parts.mesh).from); }},
           {shown_heading("to", "mm"),
            [&](const Layer& l) { return length_text(span_of(l, s, parts.mesh).to); }},
           {shown_heading("outer diameter", "mm"),
            [](const Layer& l) { return diameters(l.left.outer, l.right.outer); }},
           {shown_heading("inner diameter", "mm"),
            [](const Layer& l) { return diameters(l.left.inner, l.right.inner); }},
           {"material", [](const Layer& l) { return l.material.name; }},
           {"counts with", [](const Layer& l) {
              return l.carries == Carries::both ? "mass and stiffness"
                                                : std::string(name_of(l.carries));
            }}})};
  tell_common(sheet, 3);
  return sheet;
}

/// Every node and body, with what is there.
Sheet stations_sheet(const ModelParts& parts) {
  const std::vector<NamedPoint> points = named_points(parts.model, parts.assembler);
  return {"Stations", sheet_table(points, {{"node",
                                            [](const NamedPoint& p) {
                                              return p.node() > 0 ? std::to_string(p.node())
                                                                  : std::string("body");
                                            }},
                                           {shown_heading("z", "mm"),
                                            [&](const NamedPoint& p) {
                                              const auto z = parts.mesh.position_of(p.point);
                                              return z ? length_text(*z) : std::string("-");
                                            }},
                                           {"what is there", [](const NamedPoint& p) {
                                              return p.name.empty() ? "" : p.name;
                                            }}})};
}

}  // namespace

std::vector<Sheet> shaft_sheets(const ModelParts& parts) {
  const Structure& s = parts.structure;
  std::vector<Sheet> sheets;
  if (parts.mesh.nodes() > 0) sheets.push_back(materials_sheet(s));
  int number = 0;
  for (const Structure::Shaft& shaft : s.shafts()) {
    if (!shaft.segments.empty()) sheets.push_back(sections_sheet(parts, shaft, number));
    ++number;
  }
  if (!s.layers.empty()) sheets.push_back(layers_sheet(parts));
  sheets.push_back(stations_sheet(parts));
  return sheets;
}

}  // namespace whirl::inline io

#include <fmt/format.h>

#include <algorithm>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "libfe/properties.hpp"
#include "libio/drawing/terminal_layout.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"
#include "libio/text/terminal.hpp"

namespace whirl::inline cli {

namespace {

Report run_check(const Invocation& call) {
  const Model model = call.model();
  const Structure& s = model.structure;
  const Assembler assembler(s);
  const System system = assembler.at(model.speed);
  const RotorProperties rotor = rotor_properties(s, assembler.mesh());
  const int dofs = assembler.uncondensed(model.speed).size();

  Report report{.record = begin_record(call, model)};
  Record& r = report.record;
  r.set("mass_kg", rotor.mass).set("length_m", s.length()).set("nodes", assembler.mesh().nodes());
  r.set("dofs", dofs).set("condensed_dofs", system.dofs.condensed);
  r.set("contacts", static_cast<long>(model.contacts.size()));
  if (!model.films.empty()) r.set("oil_films", static_cast<long>(model.films.size()));
  r.set("center_of_mass_m", s.shaft.empty() ? Record(nullptr) : Record(rotor.center_of_mass));
  r.set("polar_inertia_kg_m2", rotor.Ip);

  std::string& text = report.text;
  text = (model.title.empty() ? call.file : model.title) + "\n\n";
  if (!s.shaft.empty()) {
    constexpr std::size_t most = 72, margin = 4;
    const std::size_t columns = terminal_columns();
    const std::size_t width = columns == 0 ? most : std::min(most, columns - margin);
    text += draw_layout(model, assembler, static_cast<int>(width)) + "\n";
  }
  Table table({"what", "value"});
  table.row({"mass of the rotor", format_engineering(rotor.mass, "kg")});
  if (!s.shaft.empty()) {
    table.row({"length", format_length(s.length())});
    table.row({"center of mass at", format_length(rotor.center_of_mass)});
  }
  table.row({"polar moment of inertia", format_engineering(rotor.Ip, "kg.m^2")});
  table.row({"nodes, bodies", fmt::format("{}, {}", assembler.mesh().nodes(), s.bodies.size())});
  table.row({"freedoms", system.dofs.condensed > 0
                             ? fmt::format("{}, of which {} without inertia are condensed", dofs,
                                           system.dofs.condensed)
                             : fmt::format("{}", dofs)});
  table.row({"disks, bearings, links",
             fmt::format("{}, {}, {}", s.disks.size(), s.bearings.size(), s.links.size())});
  if (!model.films.empty()) table.row({"oil films", fmt::format("{}", model.films.size())});
  table.row({"contacts", fmt::format("{}", model.contacts.size())});
  table.row({"operating speed", model.has_speed ? format_speed(model.speed) : "not given"});
  text += table.text() + "\n  The model is in order.\n";
  if (const auto file = call.result_file(model)) {
    write_points(*file, model, assembler);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace

Verb check_verb() {
  return {
      .name = "check",
      .group = "The model",
      .summary = "reads and checks a model, draws its layout",
      .example = "whirl check models/two_disk_mac.toml",
      .run = run_check,
  };
}

}  // namespace whirl::inline cli

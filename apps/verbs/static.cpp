#include "libfe/static.hpp"

#include <fmt/format.h>

#include <optional>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "libfe/bending.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

/// The bending line as JSON, and a sentence about its largest moment.
std::string add_bending(const BendingLine& line, Record& record) {
  record.set("shaft", record_of(line));
  if (line.moment.isZero(0.0)) return "";  // no weight, or no shaft
  Eigen::Index largest = 0, lowest = 0;
  line.moment.rowwise().norm().maxCoeff(&largest);
  line.deflection.rowwise().norm().maxCoeff(&lowest);
  return fmt::format(
      "  The shaft bends most at z = {:.1f} mm, by {:.4g} N.m, and sags most at z = {:.1f} mm, by "
      "{} um.\n",
      1e3 * line.z(largest), line.moment.row(largest).norm(), 1e3 * line.z(lowest),
      fixed(1e6 * line.deflection.row(lowest).norm(), 3));
}

/// A place of the rotor at rest.
struct RestingStation {
  std::optional<int> node;  ///< from 1; nothing: a body
  std::string name;
  double x = 0.0, y = 0.0;  ///< [m]

  static constexpr auto columns() {
    return std::tuple{column("node", &RestingStation::node, "", "number of the node"),
                      column("name", &RestingStation::name, "", "what is there"),
                      column("x", &RestingStation::x, "m", "displacement"),
                      column("y", &RestingStation::y, "m", "displacement")};
  }
};

/// Displacements of all named places: their records, and a table for people.
std::string add_stations(const Model& model, const Assembler& assembler, const Vec& displacement,
                         Record& record) {
  const DofMap dofs = assembler.uncondensed(model.speed).dofs;
  Record list = Record::array();
  Table table({"station", "z [mm]", "x [um]", "y [um]"});
  for (const NamedPoint& p : named_points(model, assembler)) {
    RestingStation at{.name = p.name};
    if (p.node() > 0) at.node = p.node();
    at.x = displacement(dofs.full_index(p.point, X));
    at.y = displacement(dofs.full_index(p.point, Y));
    list.add(record_of(at));
    std::string z;
    if (at.node) z = fmt::format("{:.1f}", 1e3 * assembler.mesh().z.at(*at.node - 1));
    table.row({p.label(), z, fixed(1e6 * at.x, 3), fixed(1e6 * at.y, 3)});
  }
  record.set("stations", list);
  return table.text();
}

std::string loads_text(const std::vector<BearingLoad>& bearings) {
  Table loads({"bearing", "load x [N]", "load y [N]"});
  for (const BearingLoad& load : bearings) {
    loads.row({load.name, fixed(load.fx(), 4), fixed(load.fy(), 4)});
  }
  return loads.text();
}

Report run_static(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const StaticEquilibrium at_rest = static_equilibrium(assembler, model.speed);
  const BendingLine line = bending_line(assembler, model.speed, at_rest.displacement);

  Report report{.record = begin_record(call, model)};
  report.text = "Static equilibrium under gravity\n";
  if (model.structure.gravity == 0.0)
    report.text += "(the model has no gravity: add gravity = \"9.81 m/s^2\")\n";
  report.text += "\n" + add_stations(model, assembler, at_rest.displacement, report.record) + "\n";
  report.record.merge(record_of(at_rest));
  report.text += loads_text(at_rest.bearings) +
                 "\n  A load is the force of the rotor on its bearing; y points up.\n";
  report.text += add_bending(line, report.record);
  note_left_out(model, report);
  note_tables(model, model.speed, model.speed, report);
  if (const auto file = call.result_file(model)) {
    write_points(*file, model, assembler);
    write_result(*file, at_rest);
    if (line.z.size() > 0) write_result(*file, line);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace

Verb static_verb() {
  return {
      .name = "static",
      .group = "The model",
      .summary = "sag under gravity and bearing loads",
      .example = "whirl static models/two_disk_double_rub.toml",
      .run = run_static,
  };
}

}  // namespace whirl::inline cli

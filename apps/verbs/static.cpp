#include "libfe/static.hpp"

#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "libfe/bending.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

/// The bending line as JSON, and a sentence about its largest moment.
std::string add_bending(const BendingLine& line, Record& record) {
  Record shaft;
  const auto column = [](const Mat& of, Eigen::Index plane) { return Vec(of.col(plane)); };
  shaft.set("z_m", line.z);
  shaft.set("x_m", column(line.deflection, 0)).set("y_m", column(line.deflection, 1));
  shaft.set("moment_x_n_m", column(line.moment, 0)).set("moment_y_n_m", column(line.moment, 1));
  shaft.set("shear_x_n", column(line.shear, 0)).set("shear_y_n", column(line.shear, 1));
  record.set("shaft", shaft);
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

void write_bending(ResultWriter& file, const BendingLine& line) {
  if (line.z.size() == 0) return;
  const std::vector<std::string> axes{"/static/z", ""};
  file.dataset("/static/z", line.z,
               {"m", "position along the shaft, both ends of every beam", {""}});
  file.dataset("/static/deflection", line.deflection, {"m", "static deflection (x, y)", axes});
  file.dataset("/static/moment", line.moment,
               {"N.m", "bending moment (of the planes x-z, y-z)", axes});
  file.dataset("/static/shear", line.shear,
               {"N", "shear force of the right part on the left one (x, y)", axes});
}

Report run_static(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const StaticEquilibrium at_rest = static_equilibrium(assembler, model.speed);
  const BendingLine line = bending_line(assembler, model.speed, at_rest.displacement);
  const DofMap dofs = assembler.uncondensed(model.speed).dofs;

  Report report{.record = begin_record(call, model)};
  Record stations = Record::array(), bearings = Record::array();
  Table table({"station", "z [mm]", "x [um]", "y [um]"});
  for (const NamedPoint& p : named_points(model, assembler)) {
    const double x = at_rest.displacement(dofs.full_index(p.point, X));
    const double y = at_rest.displacement(dofs.full_index(p.point, Y));
    Record station;
    station.set("node", p.node() > 0 ? Record(p.node()) : Record(nullptr)).set("name", p.name);
    station.set("x_m", x).set("y_m", y);
    stations.add(station);
    const std::string z =
        p.node() > 0
            ? fmt::format("{:.1f}",
                          1e3 * assembler.mesh().z[static_cast<std::size_t>(p.point.index)])
            : "";
    table.row({point_label(p), z, fixed(1e6 * x, 3), fixed(1e6 * y, 3)});
  }
  Table loads({"bearing", "load x [N]", "load y [N]"});
  for (const BearingLoad& load : at_rest.bearings) {
    Record bearing;
    bearing.set("name", load.name).set("fx_n", load.force(0)).set("fy_n", load.force(1));
    bearings.add(bearing);
    loads.row({load.name, fixed(load.force(0), 4), fixed(load.force(1), 4)});
  }
  report.record.set("stations", stations).set("bearings", bearings);
  report.text = "Static equilibrium under gravity\n";
  if (model.structure.gravity == 0.0)
    report.text += "(the model has no gravity: add gravity = \"9.81 m/s^2\")\n";
  report.text += "\n" + table.text() + "\n" + loads.text() +
                 "\n  A load is the force of the rotor on its bearing; y points up.\n";
  report.text += add_bending(line, report.record);
  note_left_out(model, report);
  note_tables(model, model.speed, model.speed, report);
  if (const auto file = call.result_file(model)) {
    write_points(*file, model, assembler);
    file->dataset("/static/displacement", at_rest.displacement,
                  {"m, rad",
                   "static displacement: x, y, theta_x, theta_y of every node, then of every body",
                   {""}});
    std::vector<std::string> names;
    Mat forces(static_cast<Eigen::Index>(at_rest.bearings.size()), 2);
    for (std::size_t i = 0; i < at_rest.bearings.size(); ++i) {
      names.push_back(at_rest.bearings[i].name);
      forces.row(static_cast<Eigen::Index>(i)) = at_rest.bearings[i].force.transpose();
    }
    if (!names.empty()) {
      file->dataset("/static/bearing", names, {"", "bearing", {""}});
      file->dataset("/static/bearing_load", forces,
                    {"N", "force of the rotor on the bearing (x, y)", {"/static/bearing", ""}});
    }
    write_bending(*file, line);
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

}  // namespace whirl

#include "libfe/static.hpp"

#include <fmt/format.h>

#include "apps/verbs/all.hpp"
#include "apps/verbs/common.hpp"
#include "libio/format.hpp"
#include "libio/hdf5.hpp"
#include "libio/table.hpp"

namespace whirl {

Report run_static(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const StaticEquilibrium at_rest = static_equilibrium(assembler, model.speed);
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
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace whirl

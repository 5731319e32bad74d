#include "libfe/mesh/elements/disk.hpp"

#include <fmt/format.h>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

void read_disks(ModelReading& reading) {
  reading.for_each("disk", [&](TableReader& table, std::size_t i) {
    Disk disk{.name = table.string("name").value_or(fmt::format("disk {}", i + 1))};
    const auto at = reading.station(table);
    if (at && at->kind == Station::Kind::body)
      table.problem("body", "a disk sits on the shaft; give the body its mass");
    if (at) disk.at = *at;
    table.read(disk);
    const bool has_mass = table.has("mass"), has_material = table.has("material");
    if (disk.outer_diameter > 0.0 && disk.inner_diameter >= disk.outer_diameter) {
      table.problem("inner_diameter",
                    fmt::format("found {:g} mm, expected less than the outer diameter of "
                                "{:g} mm",
                                1e3 * disk.inner_diameter, 1e3 * disk.outer_diameter));
    }
    table.node("material");
    const char* expected =
        "a disk by its shape (material, outer_diameter, inner_diameter, width) or "
        "by its mass (mass, diametral_inertia, polar_inertia), one of the two";
    if (!has_mass && !has_material) {
      table.missing("material", expected, {"mass"});
    } else if (has_mass && has_material) {
      table.problem("mass", fmt::format("found both, expected {}", expected));
    } else if (has_material) {
      for (const char* key : {"outer_diameter", "width"}) {
        if (!table.has(key))
          table.missing(key, "a length (m), since the disk is given by its shape");
      }
      for (const char* key : {"diametral_inertia", "polar_inertia"}) {
        if (table.has(key))
          table.problem(key, "follows from the shape; give mass instead of material to set it");
      }
      if (const auto m = reading.material(table)) set_inertia_from_shape(disk, m->rho);
    }
    if (table.node("unbalance")) {
      TableReader reader = reading.inner(table, "unbalance");
      if (const auto u = read_unbalance(reader, disk.at, disk.m))
        reading.model.structure.unbalances.push_back(*u);
      reader.finish();
    }
    reading.model.structure.disks.push_back(disk);
  });
}

}  // namespace

ModelTable disk_table() {
  return {.name = "disk",
          .meaning = "rigid disks on the shaft, by their shape or by their mass",
          .read = read_disks,
          .example =
              "node = 1\n"
              "material = \"steel\"\n"
              "outer_diameter = 1\n"
              "width = 1\n",
          .as_tables = "unbalance = {}\n",
          .switches = {{"material"}},
          .notes = {{"material", "name of a [material.NAME], of a disk that is given by its shape"},
                    {"unbalance", "offset or moment, and phase"}}};
}

}  // namespace whirl::inline io

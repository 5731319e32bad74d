#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/system/clearance.hpp"
#include "libfe/analyses/static.hpp"

namespace whirl::inline dyn {

struct Model;

/// What a model has and weighs.
struct ModelFacts {
  double mass = 0.0;    ///< of the rotor [kg]
  double length = 0.0;  ///< of the shaft [m]
  int nodes = 0;
  int dofs = 0, condensed_dofs = 0;
  long contacts = 0;
  std::optional<double> center_of_mass{};  ///< along the shaft [m]; nothing: there is no shaft
  double polar_inertia = 0.0;              ///< [kg.m^2]
  /// Of shaft and disks about a diameter through their center of mass [kg.m^2]; nothing: there is
  /// no shaft.
  std::optional<double> transverse_inertia{};
  std::vector<BearingLoad> bearing_loads{};    ///< of bearings and oil films at rest
  std::vector<RunningClearance> clearances{};  ///< at rest, the closest first
  std::string no_rest{};                       ///< why there is no equilibrium; empty: there is one

  static constexpr auto columns() {
    using F = ModelFacts;
    return ColumnList{
        column("mass", &F::mass, "kg", "mass of the rotor"),
        column("length", &F::length, "m", "length of the shaft"),
        column("nodes", &F::nodes, "", "nodes"),
        column("dofs", &F::dofs, "", "degrees of freedom"),
        column("condensed_dofs", &F::condensed_dofs, "", "of them without inertia"),
        column("contacts", &F::contacts, "", "contacts"),
        column("center_of_mass", &F::center_of_mass, "m", "along the shaft"),
        column("polar_inertia", &F::polar_inertia, "kg.m^2", "polar moment of inertia")
            .as("polar_inertia_kg_m2"),
        column("transverse_inertia", &F::transverse_inertia, "kg.m^2",
               "transverse moment of inertia about the center of mass")
            .as("transverse_inertia_kg_m2"),
        rows(&F::bearing_loads, "bearing_loads"),
        rows(&F::clearances, "clearances")};
  }
};

/// Facts of a model at its speed.
ModelFacts model_facts(const Model& model, const Assembler& assembler);

}  // namespace whirl::inline dyn

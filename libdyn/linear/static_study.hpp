#pragma once
/// A rotor at rest under gravity and constant forces as a result: its sag, what its bearings carry,
/// where its journals run on their oil films, how its shaft bends.

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/system/probes.hpp"
#include "libdyn/system/running_bearing.hpp"
#include "libdyn/system/running_film.hpp"
#include "libfe/analyses/bending.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline dyn {

struct Model;

/// A place of the rotor at rest.
struct RestingStation {
  std::optional<int> node;  ///< from 1; nothing: a body
  std::string name, label;
  double x = 0.0, y = 0.0;  ///< [m]
  double z = 0.0;           ///< of a node, along the shaft [m]

  static constexpr auto columns() {
    return ColumnList{column("node", &RestingStation::node, "", "number of the node"),
                      column("name", &RestingStation::name, "", "what is there"),
                      column("x", &RestingStation::x, "m", "displacement"),
                      column("y", &RestingStation::y, "m", "displacement")};
  }
};

/// What a probe reads of the rotor at rest.
struct RestingProbe : ProbeLabel {
  double mean = 0.0;  ///< [m]

  static constexpr auto columns() {
    return joined(ProbeLabel::columns(),
                  ColumnList{column("mean", &RestingProbe::mean, "m", "what it reads at rest")});
  }
};

/// A static study; its parts are groups of a file by themselves.
struct StaticStudy {
  std::vector<RestingStation> stations;  ///< all named places
  StaticEquilibrium at_rest;
  RunningFilms on_films;
  RunningBearings on_elements;
  BendingLine line;
  double speed = 0.0;  ///< [rad/s]
  bool has_gravity = true;
  bool has_forces = false;  ///< constant ones
  std::vector<RestingProbe> probes{};

  static constexpr auto columns() {
    using S = StaticStudy;
    return ColumnList{
        rows(&S::stations, "stations"),
        rows(
            [](const S& s) -> const auto& { return s.at_rest.bearings; }, "bearings"),
        rows(
            [](const S& s) -> const auto& { return s.at_rest.links; }, "links")
            .maybe()
            .only(Written::in_json),
        rows(
            [](const S& s) -> const auto& { return s.on_films.films; }, "films")
            .maybe()
            .only(Written::in_json),
        rows(
            [](const S& s) -> const auto& { return s.on_elements.bearings; }, "rolling_bearings")
            .maybe()
            .only(Written::in_json),
        column("shaft", &S::line, "", "how the shaft bends"),
        rows(&S::probes, "probes").maybe().only(Written::in_json)};
  }
};

/// The equilibrium of a model at its speed; films carry as at that speed, contacts with stators
/// are left out.
/// @throws ModelError      as static_equilibrium
/// @throws NumericalError  as FilmEquilibrium::at
StaticStudy static_study(const Model& model, const Assembler& assembler);

}  // namespace whirl::inline dyn

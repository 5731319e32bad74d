#pragma once
/// Unbalance as a lateral analysis places it: at the antinodes of each mode, as much as the
/// journals carry.

#include <vector>

#include "libdyn/system/model.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/lateral/antinodes.hpp"
#include "libfe/lateral/lateral_rules.hpp"

namespace whirl::inline dyn {

/// A place that carries the rotor.
struct Journal {
  std::string name;
  int node = 0;       ///< from 0
  double z = 0.0;     ///< [m]
  double mass = 0.0;  ///< of its static load [kg]
};

/// Bearings and oil films on the shaft, left to right, with what they carry at a speed [rad/s]. A
/// model without gravity is given that of the earth.
/// @throws ModelError      as static_equilibrium
/// @throws NumericalError  as FilmEquilibrium::at
std::vector<Journal> journals_of(const Model& model, const Assembler& assembler, double Omega);

/// Unbalance at an antinode.
struct UnbalancePlane {
  int node = 0;         ///< from 0
  double moment = 0.0;  ///< [kg.m]
  double phase = 0.0;   ///< 0, or pi where the mode moves against the first antinode [rad]
};

/// Unbalance that excites a mode.
struct UnbalanceCase {
  Critical mode;
  std::vector<UnbalancePlane> planes;
};

/// Unbalance at the antinodes of one mode.
///
/// A single antinode between the journals has twice the residual unbalance that is allowed for what
/// all of them carry; of several, and beyond the journals, each has that for what the nearest
/// journal carries. Neighbors that move against each other have opposite phases.
///
/// @source [API617], [API684]
std::vector<UnbalancePlane> unbalance_planes(const std::vector<Antinode>& antinodes,
                                             const std::vector<Journal>& journals, const Mesh& mesh,
                                             double maximum);

/// Unbalances for every undamped critical speed up to a limit, and for the lowest one at least.
/// Those that would repeat the places of one before are left out, as of a mode that is critical
/// once along x and once along y: as many antinodes within a tenth of the shaft.
std::vector<UnbalanceCase> unbalance_cases(const Assembler& assembler,
                                           const std::vector<Critical>& criticals,
                                           const std::vector<Journal>& journals, double maximum,
                                           double limit);

}  // namespace whirl::inline dyn

#pragma once
/// Unbalance as a lateral analysis places it: at the antinodes of each mode, by the mass that the
/// journals carry, and at overhung disks and couplings, by the mass that hangs over.

#include <array>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/lateral/antinodes.hpp"
#include "libfe/lateral/lateral_rules.hpp"
#include "libfe/lateral/turning_shaft.hpp"

namespace whirl::inline dyn {

struct Model;

/// A place that carries the rotor.
struct Journal {
  std::string name;
  int node = 0;       ///< from 0
  double z = 0.0;     ///< [m]
  double mass = 0.0;  ///< of its static load [kg]
  int shaft = 0;      ///< number of the shaft that it carries, from 0
};

/// Bearings and oil films on the shafts, shaft by shaft and left to right, with the mass that each
/// of them carries at a speed [rad/s]. One between two shafts is a journal of that which it
/// carries. In a model without gravity the gravity of the earth acts.
/// @throws ModelError      as static_equilibrium
/// @throws NumericalError  as FilmEquilibrium::at
std::vector<Journal> journals_of(const Model& model, const Assembler& assembler, double Omega);

/// Where a case of unbalance has its unbalance.
enum class UnbalancePlaces { antinodes, overhung_end };
constexpr auto choices(UnbalancePlaces) {
  using enum UnbalancePlaces;
  return std::array{Choice<UnbalancePlaces>{"antinodes", antinodes},
                    Choice<UnbalancePlaces>{"overhung end", overhung_end}};
}

/// Unbalance at a node.
struct UnbalancePlane {
  int node = 0;         ///< from 0
  double moment = 0.0;  ///< [kg.m]
  double phase = 0.0;   ///< 0, or pi where the mode moves against the first antinode [rad]
};

/// What hangs over beside the outermost journal of a side: an impeller, a coupling.
struct OverhungEnd {
  int node = 0;       ///< of its outermost disk, from 0
  double mass = 0.0;  ///< of shaft and disks beyond the journal [kg]
};

/// Ends of a shaft with a disk beyond the outermost journal, left to right.
/// @param journals  of this shaft, left to right
/// @param shaft     its number, from 0
std::vector<OverhungEnd> overhung_ends(const Structure& structure, const Mesh& mesh,
                                       const std::vector<Journal>& journals, int shaft = 0);

/// Unbalance that excites a mode.
struct UnbalanceCase {
  Critical mode;  ///< of an overhung end the mode that moves it most
  UnbalancePlaces places = UnbalancePlaces::antinodes;
  std::vector<UnbalancePlane> planes;
};

/// Unbalance at the antinodes of one mode.
///
/// A single antinode between the journals has twice the residual unbalance that is allowed for the
/// mass that all journals carry. Each of several antinodes, and one beyond the journals, has twice
/// that for the mass that the nearest journal carries. Neighbors that move against each other have
/// opposite phases.
///
/// @source [API617], [API684]
std::vector<UnbalancePlane> unbalance_planes(const std::vector<Antinode>& antinodes,
                                             const std::vector<Journal>& journals, const Mesh& mesh,
                                             double maximum);

/// Unbalances for every undamped critical speed up to a limit, and for the lowest one at least.
/// An unbalance at the places of an earlier one is left out, as of a mode that is critical once
/// along x and once along y: with as many antinodes, each within a tenth of the shaft. Behind them
/// those of overhung ends, each with twice the residual unbalance that is allowed for the mass that
/// hangs over; one that a case has within a tenth of the shaft, alone and not smaller, is left out.
///
/// @param criticals       by the order of the shaft
/// @param journals        of the shaft, left to right
/// @param maximum, limit  speeds of the first shaft [rad/s]
/// @param of              whose unbalance it is, by its own maximum speed; modes count that move it
///                        at least half as far as any other
std::vector<UnbalanceCase> unbalance_cases(const Assembler& assembler,
                                           const std::vector<Critical>& criticals,
                                           const std::vector<Journal>& journals, double maximum,
                                           double limit, const TurningShaft& of = {});

}  // namespace whirl::inline dyn

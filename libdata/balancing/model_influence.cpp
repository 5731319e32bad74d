#include "libdata/balancing/model_influence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdyn/system/clearance.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/analyses/unbalance.hpp"

namespace whirl::inline data {

namespace {

/// Where the rotor rests, a full vector.
Vec rest_of(const Model& model, const Assembler& assembler, double Omega) {
  if (!has_working_point(model)) return static_equilibrium(assembler, Omega).displacement;
  const auto on_films = FilmEquilibrium(model).at(Omega);
  return on_films->system.dofs.T * on_films->q;
}

/// Readings at all places.
CVec vibration_of(const Structure& structure, const std::vector<Probe>& probes,
                  const std::vector<ReadingPlace>& places) {
  const Assembler assembler(structure);
  UnbalanceSolver solver(assembler);
  CVec readings(std::ssize(places));
  for (std::size_t j = 0; j < places.size(); ++j) {
    const auto full = solver.at(places[j].speed);
    if (!full) {
      throw NumericalError(
          fmt::format("the rotor has an undamped resonance at {:.6g} rpm: it "
                      "cannot be balanced there",
                      places[j].speed / rpm));
    }
    const Probe& probe = probes[places[j].probe];
    const Point point = assembler.point(probe.at);
    readings(static_cast<Eigen::Index>(j)) = probe.reading([&](int component) {
      const int k = solver.dofs().full_index(point, component);
      return k >= 0 ? (*full)(k) : Complex();
    });
  }
  return readings;
}

}  // namespace

std::vector<std::string> touched_contacts(const Model& model, const std::vector<double>& speeds) {
  constexpr Eigen::Index moments = 720;  // of a revolution
  const Assembler assembler(linear_structure(model));
  UnbalanceSolver solver(assembler);
  std::vector<std::string> touched;
  if (model.contacts.empty()) return touched;
  for (const double Omega : speeds) {
    const auto full = solver.at(Omega);
    if (!full) continue;
    Mat basis(full->size(), 3), turning(3, moments);
    basis << rest_of(model, assembler, Omega), full->real(), -full->imag();
    for (Eigen::Index i = 0; i < moments; ++i) {
      const double angle = turn * static_cast<double>(i) / static_cast<double>(moments);
      turning.col(i) << 1.0, std::cos(angle), std::sin(angle);
    }
    const auto distances = largest_distances(model, assembler, basis, turning);
    const std::size_t contacts = stator_contacts(model.contacts).size();
    for (std::size_t c = 0; c < contacts; ++c) {  // the first of all clearances
      if (distances[c].left() > 0.0) continue;
      touched.push_back(fmt::format("{} at {:.6g} rpm", distances[c].name, Omega / rpm));
    }
  }
  return touched;
}

ModelInfluence model_influence(const Model& model, const std::vector<std::size_t>& planes,
                               const std::vector<Probe>& probes,
                               const std::vector<ReadingPlace>& places) {
  const auto readings = std::ssize(places), count = std::ssize(planes);
  ModelInfluence found{CMat(readings, count), CVec(readings), {}};
  Model bare = model;
  for (const std::size_t plane : planes) bare.structure.unbalances[plane].moment = 0.0;
  found.vibration = vibration_of(linear_structure(bare), probes, places);
  std::vector<double> speeds;
  for (const ReadingPlace& place : places) {
    if (std::find(speeds.begin(), speeds.end(), place.speed) == speeds.end()) {
      speeds.push_back(place.speed);
    }
  }
  found.touched = touched_contacts(bare, speeds);
  Structure unit = linear_structure(bare);
  for (Unbalance& own : unit.unbalances) own.moment = 0.0;
  unit.straighten();
  unit.forces.clear();
  for (std::size_t k = 0; k < planes.size(); ++k) {
    unit.unbalances[planes[k]].moment = 1.0;
    unit.unbalances[planes[k]].phase = 0.0;
    found.coefficients.col(static_cast<Eigen::Index>(k)) = vibration_of(unit, probes, places);
    unit.unbalances[planes[k]].moment = 0.0;
  }
  return found;
}

}  // namespace whirl::inline data

#include "libdyn/system/resting_rotor.hpp"

#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline dyn {

std::vector<BearingLoad> RestingRotor::journal_loads(const Model& model) const {
  const auto bearings = static_cast<std::ptrdiff_t>(model.structure.bearings.size());
  std::vector<BearingLoad> loads(at_rest.bearings.begin(), at_rest.bearings.begin() + bearings);
  for (const RunningFilm& film : films) loads.push_back({film.name, film.load});
  for (const RunningBearing& bearing : rolling) loads.push_back({bearing.name, bearing.load});
  return loads;
}

RestingRotor resting_rotor(const Model& model, const Assembler& assembler, double Omega) {
  if (!has_working_point(model)) return {static_equilibrium(assembler, Omega), {}, {}};
  const auto rotor = FilmEquilibrium(model).at(Omega);
  return {with_bearing_loads(assembler, rotor->system, rotor->q, rotor->load), rotor->films,
          rotor->rolling};
}

}  // namespace whirl::inline dyn

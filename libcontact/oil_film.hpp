#pragma once

#include <string>

#include "libbase/numerics/linalg.hpp"
#include "libcontact/films.hpp"
#include "libfe/parts/station.hpp"

namespace whirl::inline contact {

/// A journal bearing with its nonlinear oil film, as the model file says it.
struct OilFilm {
  std::string name;
  Station at;       ///< the journal, which spins
  Station against;  ///< the bearing: the ground or a body that does not spin
  JournalBearing bearing;
  Vec2 offset = Vec2::Zero();  ///< center of the bearing [m]
  AnyFilmLaw law;
  bool is_linearized = true;  ///< in linear analyses; else they leave it out
  Where where{};
};

}  // namespace whirl::inline contact

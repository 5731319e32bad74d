#pragma once
/// The list of laws of oil films.

#include <variant>

#include "libcontact/films/short.hpp"

namespace whirl::inline contact {

using AnyFilmLaw = std::variant<  //
    Short>;

}  // namespace whirl::inline contact

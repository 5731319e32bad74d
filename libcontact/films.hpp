#pragma once
/// The list of laws of oil films.

#include <variant>

#include "libcontact/films/short.hpp"
#include "libcontact/films/squeeze.hpp"

namespace whirl::inline contact {

using AnyFilmLaw = std::variant<  //
    Short,                        //
    Squeeze>;

/// Number of the formula of a law: films of one number are computed together.
inline std::size_t formula_of(const AnyFilmLaw& law) {
  constexpr std::size_t most = 16;  // formulas of a law
  return most * law.index() +
         std::visit([](const auto& l) { return static_cast<std::size_t>(l.formula()); }, law);
}

/// Stiffness of the spring that belongs to a film [N/m]; 0: none does.
inline double spring_of(const AnyFilmLaw& law) {
  return std::visit(
      [](const auto& l) {
        if constexpr (requires { l.spring; }) return l.spring;
        return 0.0;
      },
      law);
}

/// Whether the journal's spin drags the oil along.
inline bool is_dragged(const AnyFilmLaw& law) {
  return std::visit([](const auto& l) { return l.is_dragged; }, law);
}

}  // namespace whirl::inline contact

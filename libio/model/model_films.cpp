#include <fmt/format.h>

#include "libio/model/model_builder.hpp"
#include "libio/model/read_member.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline io {

/// The key `offset`, [x, y] of a circle's center [m].
Vec2 ModelBuilder::center(TableReader& table) {
  const auto offset = table.pair("offset", "m", Range::any, "[x, y]");
  return offset ? Vec2(offset->front(), offset->back()) : Vec2(Vec2::Zero());
}

void ModelBuilder::read_films() {
  for_each("oil_film", [&](TableReader& table, std::size_t i) {
    OilFilm film;
    film.where = table.where();
    film.name = table.string("name").value_or(fmt::format("oil film {}", i + 1));
    const auto spins = [&](const Station& s) {
      for (const Body& body : model_.structure.bodies) {
        if (s.kind == Station::Kind::body && body.name == s.body) return body.spins;
      }
      return s.kind == Station::Kind::position || s.kind == Station::Kind::node;
    };
    const auto at = station(table);
    read_member(table, "law", film.law);
    if (at) {
      film.at = *at;
      if (is_dragged(film.law) && !spins(*at)) {
        table.problem("body", "the journal of an oil film spins: give the body spins = true");
      }
    }
    if (const auto against = table.string("against")) {
      if (const auto s = named_station(*against, table, "against")) {
        film.against = *s;
        if (at && at->kind == Station::Kind::body && at->body == *against) {
          table.problem("against", "the body would be its own bearing");
        } else if (spins(*s)) {
          table.problem("against", "the bearing of an oil film does not spin, but this body does");
        }
      }
    }
    table.read(film.bearing);
    film.offset = center(table);
    film.is_linearized = table.boolean("linearize").value_or(true);
    if (const double k = spring_of(film.law); at && k > 0.0) {
      model_.structure.bearings.push_back(
          {.name = film.name + " spring",
           .from = film.at,
           .to = film.against,
           .coefficients = constant_bearing({.K = k * Mat2::Identity()}),
           .where = film.where});
    }
    if (at) model_.structure.stations.push_back(*at);
    model_.films.push_back(film);
  });
}

}  // namespace whirl::inline io

#include <fmt/format.h>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_member.hpp"
#include "libio/model/read_parts.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline io {

namespace {

void read_films(ModelReading& reading) {
  reading.for_each("oil_film", [&](TableReader& table, std::size_t i) {
    OilFilm film;
    film.where = table.where();
    film.name = table.string("name").value_or(fmt::format("oil film {}", i + 1));
    const auto spins = [&](const Station& s) {
      if (const Body* body = reading.body_at(s)) return body->spins;
      return s.kind == Station::Kind::position || s.kind == Station::Kind::node;
    };
    const auto at = reading.station(table);
    read_member(table, "law", film.law);
    if (at) {
      film.at = *at;
      if (is_dragged(film.law) && !spins(*at)) {
        table.problem("body", "the journal of an oil film spins: give the body spins = true");
      }
    }
    if (const auto against = table.string("against")) {
      if (const auto s = reading.named_station(*against, table, "against", true, at)) {
        film.against = *s;
        if (at && at->kind == Station::Kind::body && at->body == *against) {
          table.problem("against", "the body would be its own bearing");
        }
      }
    }
    table.read(film.bearing);
    film.offset = read_center(table);
    film.is_linearized = table.boolean("linearize").value_or(true);
    if (const double k = spring_of(film.law); at && k > 0.0) {
      reading.model.structure.bearings.push_back(
          {.name = film.name + " spring",
           .from = film.at,
           .to = film.against,
           .coefficients = constant_bearing({.K = k * Mat2::Identity()}),
           .where = film.where});
    }
    if (at) reading.model.structure.stations.push_back(*at);
    if (film.against.kind == Station::Kind::position) {
      reading.model.structure.stations.push_back(film.against);
    }
    reading.model.films.push_back(film);
  });
}

}  // namespace

ModelTable oil_film_table() {
  return {.name = "oil_film",
          .meaning = "plain journal bearings with nonlinear oil films",
          .read = read_films,
          .turn = ModelTable::Turn::late,
          .is_of_rotor = false,
          .example =
              "body = \"b\"\n"
              "radius = 1\n"
              "length = 1\n"
              "clearance = 1\n"
              "viscosity = 1\n"
              "law = \"squeeze\"\n",
          .switches = {{"law", "short"}},
          .notes = {{"law", "theory of the film", "\"short\""},
                    {"offset", "[x, y] of the bearing's center", "[0, 0]"},
                    {"linearize", "linear verbs take its coefficients; false: they leave it out",
                     "true"}}};
}

}  // namespace whirl::inline io

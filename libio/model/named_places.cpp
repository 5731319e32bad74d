#include "libio/model/named_places.hpp"

#include <fmt/format.h>

#include "libio/text/units.hpp"

namespace whirl::inline io {

const NamedPlace* take_place(std::vector<NamedPlace>& places, const std::string& path) {
  for (NamedPlace& place : places) {
    if (path != fmt::format("{}.{}.at", place.kind, place.name)) continue;
    place.is_taken = true;
    return &place;
  }
  return nullptr;
}

std::vector<Problem> doubts_of(const std::vector<NamedPlace>& places) {
  std::vector<Problem> doubts;
  for (const NamedPlace& place : places) {
    if (place.is_taken) continue;
    doubts.push_back({place.where, place.kind,
                      fmt::format("the model has no [[{}]] with name = {} and without a station of "
                                  "its own; nothing is at this station",
                                  place.kind, in_quotes(place.name))});
  }
  return doubts;
}

}  // namespace whirl::inline io

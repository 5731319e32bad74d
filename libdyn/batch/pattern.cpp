#include "libdyn/batch/pattern.hpp"

#include <algorithm>

#include "libfe/base/error.hpp"

namespace whirl {

namespace {

void insert(std::vector<int>& sorted, int value) {
  const auto place = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (place == sorted.end() || *place != value) sorted.insert(place, value);
}

}  // namespace

Pattern Pattern::of(std::span<const ContactSystem* const> systems) {
  Pattern p;
  if (systems.empty()) return p;
  p.n = systems.front()->coordinates();
  std::vector<std::vector<int>> off(static_cast<std::size_t>(p.n));
  p.contacts.resize(systems.front()->contacts().size());
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    p.contacts[c].law = systems.front()->contacts()[c].law.index();
  }
  for (const ContactSystem* s : systems) {
    if (s->coordinates() != p.n || s->contacts().size() != p.contacts.size()) {
      throw NumericalError(
          "the systems of a batch must have equal numbers of coordinates and contacts");
    }
    for (int i = 0; i < p.n; ++i) {
      for (int j = 0; j < p.n; ++j) {
        if (j == i) continue;
        if (s->K()(i, j) != 0.0) insert(off[static_cast<std::size_t>(i)], j);
        if (s->D()(i, j) != 0.0) insert(off[static_cast<std::size_t>(i)], p.n + j);
      }
    }
    for (std::size_t c = 0; c < p.contacts.size(); ++c) {
      const ReducedContact& contact = s->contacts()[c];
      ContactRows& rows = p.contacts[c];
      if (contact.law.index() != rows.law) {
        throw NumericalError("the systems of a batch must have the same laws at their contacts");
      }
      for (int j = 0; j < p.n; ++j) {
        if (contact.U(0, j) != 0.0) insert(rows.of_x, j);
        if (contact.U(1, j) != 0.0) insert(rows.of_y, j);
        if (contact.B(j, 0) != 0.0) insert(rows.pushed_by_x, j);
        if (contact.B(j, 1) != 0.0) insert(rows.pushed_by_y, j);
      }
      const Friction& f = contact.friction;
      rows.has_rate = rows.has_rate || !is_continuous(contact.law);
      rows.has_friction = rows.has_friction || f.mu > 0.0;
      rows.has_smooth_friction =
          rows.has_smooth_friction || (f.mu > 0.0 && f.slip == Slip::actual && f.tolerance > 0.0);
    }
  }
  for (ContactRows& rows :
       p.contacts) {  // a direction that is held still has one coefficient, of zero
    if (rows.of_x.empty()) rows.of_x.push_back(0);
    if (rows.of_y.empty()) rows.of_y.push_back(0);
  }
  for (int i = 0; i < p.n; ++i) {
    std::vector<int>& sources = off[static_cast<std::size_t>(i)];
    if (sources.empty()) continue;
    const int begin = p.off_diagonals;
    p.off_diagonals += static_cast<int>(sources.size());
    p.off_diagonal.push_back({i, begin, std::move(sources)});
  }
  return p;
}

Pattern pattern_of(std::span<const Trajectory> trajectories) {
  std::vector<const ContactSystem*> systems;
  for (const Trajectory& t : trajectories) systems.push_back(t.system);
  return Pattern::of(systems);
}

}  // namespace whirl

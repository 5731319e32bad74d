#include "libdyn/taylor/pattern.hpp"

#include <algorithm>
#include <concepts>
#include <type_traits>

#include "libbase/error.hpp"

namespace whirl::inline dyn {

namespace {

void insert(std::vector<int>& sorted, int value) {
  const auto place = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (place == sorted.end() || *place != value) sorted.insert(place, value);
}

int bodies_in(const Pattern& p) {
  if (!p.films.empty() || p.contacts.size() != 1 || p.contacts[0].has_rate ||
      p.contacts[0].rubs_apart || p.contacts[0].has_normal() || !p.turning.empty() ||
      p.off_diagonals > 0)
    return 0;
  const int bodies = p.n / 2;
  std::vector<int> of_x, of_y;
  for (int i = 0; i < bodies; ++i) {
    of_x.push_back(2 * i);
    of_y.push_back(2 * i + 1);
  }
  const Pattern::ContactRows& c = p.contacts[0];
  const bool fits = p.n == 2 * bodies && c.of_x == of_x && c.pushed_by_x == of_x &&
                    c.of_y == of_y && c.pushed_by_y == of_y;
  return fits ? bodies : 0;
}

/// Whether bodies have the same coefficients in x and in y in all systems.
bool are_isotropic(std::span<const ContactSystem* const> systems) {
  for (const ContactSystem* s : systems) {
    const ReducedContact& c = s->contacts()[0];
    for (int x = 0, y = 1; y < s->coordinates(); x += 2, y += 2) {
      if (s->K()(x, x) != s->K()(y, y) || s->D()(x, x) != s->D()(y, y) || c.U(0, x) != c.U(1, y) ||
          c.B(x, 0) != c.B(y, 1))
        return false;
    }
  }
  return true;
}

/// Adds the rows of a system's films.
void add_films(Pattern& p, const ContactSystem& s) {
  const std::size_t films = s.films().size();
  bool is_alike = p.films.size() == films;
  for (std::size_t f = 0; is_alike && f < films; ++f) {
    const ReducedFilm& film = s.films()[f];
    Pattern::FilmRows& rows = p.films[f];
    is_alike = formula_of(film.law) == formula_of(rows.law);
    for (int j = 0; j < p.n; ++j) {
      if (film.U(0, j) != 0.0) insert(rows.of_x, j);
      if (film.U(1, j) != 0.0) insert(rows.of_y, j);
      if (film.B(j, 0) != 0.0) insert(rows.pushed_by_x, j);
      if (film.B(j, 1) != 0.0) insert(rows.pushed_by_y, j);
    }
  }
  if (!is_alike) {
    throw NumericalError("the systems of a batch must have the same kinds of oil films");
  }
}

/// Pairs of contacts that slip alike in any of the systems.
std::vector<Pattern::Alike> alike_in(std::span<const ContactSystem* const> systems) {
  std::vector<Pattern::Alike> pairs;
  for (const ContactSystem* s : systems) {
    for (std::size_t j = 0; j < s->contacts().size(); ++j) {
      const auto first = static_cast<std::size_t>(s->contacts()[j].slip_group);
      for (std::size_t i = first; i < j; ++i) {
        const Pattern::Alike pair{i, j};
        if (s->slip_alike(i, j) && std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) {
          pairs.push_back(pair);
        }
      }
    }
  }
  return pairs;
}

/// Adds the rows by which the friction of a contact acts.
void insert_friction(Pattern::ContactRows& rows, const ReducedContact& c, int n) {
  const PlaneRows& V = c.rubs_apart() ? c.V : c.U;
  const PlaneColumns& B_t = c.rubs_apart() ? c.B_t : c.B;
  for (int j = 0; j < n; ++j) {
    if (V(0, j) != 0.0) insert(rows.slips_by_x, j);
    if (V(1, j) != 0.0) insert(rows.slips_by_y, j);
    if (B_t(j, 0) != 0.0) insert(rows.rubbed_x, j);
    if (B_t(j, 1) != 0.0) insert(rows.rubbed_y, j);
  }
}

template <class Geometry>
constexpr bool lanes_turn =
    std::same_as<Geometry, geometry::BladeRow> || std::same_as<Geometry, geometry::RollingElements>;
template <class... Geometry>
constexpr bool lanes_turn_all(std::type_identity<std::variant<Geometry...>>) {
  return ((Geometry::turns == lanes_turn<Geometry>)&&...);
}

/// What all systems of a batch must have in common, of the first one.
Pattern begin_pattern(const ContactSystem& first) {
  Pattern p;
  p.n = first.coordinates();
  for (int i = 0; i < p.n; ++i) p.coupled.push_back({.rows = {i}, .of_x = {}, .of_rate = {}});
  p.contacts.resize(first.contacts().size());
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    const ReducedContact& contact = first.contacts()[c];
    p.contacts[c].coordinates = p.n;
    p.contacts[c].law = contact.law.index();
    p.contacts[c].is_analytic = is_analytic(contact.law);
    p.contacts[c].geometry = contact.geometry;
    p.contacts[c].rubs_apart = contact.rubs_apart();
    p.contacts[c].is_plane = direction_of(contact.geometry).has_value();
    p.contacts[c].is_wall = is_wall(contact.geometry);
    p.contacts[c].is_limit = contact.is_limit();
    p.contacts[c].is_rolling = rolling_elements(contact.geometry) != nullptr;
    if (!contact.turns()) continue;
    static_assert(
        lanes_turn_all(std::type_identity<AnyGeometry>()),
        "lanes keep what turns as blades or elements: blade_lanes-inl.h and contact_lanes-inl.h "
        "of libdyn/taylor and sloped_contact.cpp have to know of another geometry first");
    if (contact.place == 0) p.turning.push_back({c, 0});
    ++p.turning.back().count;
    p.contacts[c].group = static_cast<int>(p.turning.size()) - 1;
  }
  for (const ReducedFilm& film : first.films()) p.films.push_back({.law = film.law});
  return p;
}

/// @throws NumericalError  where a contact differs from that of the first system in what a batch
///                         cannot have for each lane
void require_alike(const Pattern::ContactRows& rows, const ReducedContact& contact,
                   const ReducedContact& first) {
  if (contact.owner != first.owner) {
    throw NumericalError(
        "the systems of a batch must have as many blades or elements at their contacts");
  }
  if (contact.law.index() != rows.law) {
    throw NumericalError("the systems of a batch must have the same laws at their contacts");
  }
  if (contact.geometry.index() != rows.geometry.index()) {
    throw NumericalError("the systems of a batch must have the same contact geometries");
  }
}

void add_contact(Pattern::ContactRows& rows, const ReducedContact& contact, int n) {
  for (int j = 0; j < n; ++j) {
    if (contact.U(0, j) != 0.0) insert(rows.of_x, j);
    if (contact.U(1, j) != 0.0) insert(rows.of_y, j);
    if (contact.B(j, 0) != 0.0) insert(rows.pushed_by_x, j);
    if (contact.B(j, 1) != 0.0) insert(rows.pushed_by_y, j);
  }
  if (rows.slips_apart()) insert_friction(rows, contact, n);
  const Friction& f = contact.friction;
  rows.has_rate = rows.has_rate || is_damped(contact.law);
  rows.has_friction = rows.has_friction || f.mu > 0.0;
  rows.has_smooth_friction =
      rows.has_smooth_friction || (f.mu > 0.0 && f.slip == Slip::actual && f.tolerance > 0.0);
}

/// Adds the coefficients of a system that are not zero.
void add_coordinates(Pattern& p, const ContactSystem& s) {
  p.other_loads = std::max(p.other_loads, s.other_loads().size());
  for (const ReducedExcitation& o : s.excitations()) {
    if (o.ratio == 0.0) continue;
    for (int i = 0; i < p.n; ++i) {
      if (o.cosine(i) != 0.0 || o.sine(i) != 0.0) insert(p.forced, i);
    }
  }
  for (Pattern::CoupledRows& row : p.coupled) {
    const int i = row.rows[0];
    for (int j = 0; j < p.n; ++j) {
      if (j == i) continue;
      if (s.K()(i, j) != 0.0) insert(row.of_x, j);
      if (s.D()(i, j) != 0.0) insert(row.of_rate, j);
    }
  }
}

/// Gives a direction that is held still one coefficient, of zero.
template <class Rows>
void fill_directions(std::vector<Rows>& list) {
  for (Rows& rows : list) {
    if (rows.of_x.empty()) rows.of_x.push_back(0);
    if (rows.of_y.empty()) rows.of_y.push_back(0);
  }
}

}  // namespace

std::vector<Pattern::CoupledRows> side_by_side(const std::vector<Pattern::CoupledRows>& rows) {
  constexpr std::size_t most = Pattern::CoupledRows::side_by_side;
  constexpr double enough = 0.7;  // of the coefficients, that are there
  std::vector<Pattern::CoupledRows> found;
  for (std::size_t first = 0; first < rows.size();) {
    Pattern::CoupledRows joined;
    int own = 0;
    for (std::size_t r = first; r < std::min(first + most, rows.size()); ++r) {
      joined.rows.push_back(rows[r].rows[0]);
      for (const int j : rows[r].of_x) insert(joined.of_x, j);
      for (const int j : rows[r].of_rate) insert(joined.of_rate, j);
      own += rows[r].coefficients();
    }
    const bool fits = joined.rows.size() == most && own >= enough * joined.coefficients();
    const Pattern::CoupledRows& next = fits ? joined : rows[first];
    if (next.coefficients() > 0) found.push_back(next);
    first += next.rows.size();
  }
  return found;
}

Pattern Pattern::of(std::span<const ContactSystem* const> systems) {
  if (systems.empty()) return {};
  const ContactSystem& first = *systems.front();
  Pattern p = begin_pattern(first);
  for (const ContactSystem* s : systems) {
    if (s->coordinates() != p.n || s->contacts().size() != p.contacts.size()) {
      throw NumericalError(
          "the systems of a batch must have equal numbers of coordinates and contacts");
    }
    add_films(p, *s);
    add_coordinates(p, *s);
    for (std::size_t c = 0; c < p.contacts.size(); ++c) {
      require_alike(p.contacts[c], s->contacts()[c], first.contacts()[c]);
      add_contact(p.contacts[c], s->contacts()[c], p.n);
    }
  }
  fill_directions(p.contacts);
  fill_directions(p.films);
  p.coupled = side_by_side(p.coupled);
  for (CoupledRows& rows : p.coupled) {
    rows.begin = p.off_diagonals;
    p.off_diagonals += rows.coefficients();
  }
  p.alike = alike_in(systems);
  p.bodies = bodies_in(p);
  p.is_isotropic = p.bodies > 0 && are_isotropic(systems);
  return p;
}

Pattern pattern_of(std::span<const Trajectory> trajectories) {
  std::vector<const ContactSystem*> systems;
  for (const Trajectory& t : trajectories) systems.push_back(t.system);
  return Pattern::of(systems);
}

}  // namespace whirl::inline dyn

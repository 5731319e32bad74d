#include "libdyn/system/system_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace whirl::inline dyn {

namespace {

Vec numbers(std::initializer_list<double> values) {
  Vec all(std::ssize(values));
  std::copy(values.begin(), values.end(), all.begin());
  return all;
}

template <class Matrix>
Vec flat(const Matrix& A) {
  return Mat(A).reshaped();
}

/// A block for every number of a law.
template <class Law>
void add_law(const Law& law, std::vector<Vec>& blocks) {
  const auto add = [&](const auto& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
      blocks.push_back(numbers({value}));
    }
  };
  std::apply([&](const auto&... field) { (add(law.*field.member), ...); }, Law::fields());
  if constexpr (requires { Law::derived(); }) {
    std::apply([&](const auto&... member) { (add(law.*member), ...); }, Law::derived());
  }
}

void add_elements(const geometry::RollingElements& row, double phase_rate,
                  std::vector<Vec>& blocks) {
  blocks.push_back(numbers({row.play}));
  blocks.push_back(numbers({std::cos(row.angle), std::sin(row.angle)}));
  for (const geometry::RaceShape& s : row.shapes) {
    for (const double value : {s.height, s.start, s.ratio * phase_rate, s.sharpness}) {
      blocks.push_back(numbers({value}));
    }
  }
}

void add_contact(const ReducedContact& c, double phase_rate, std::vector<Vec>& blocks) {
  for (const Vec& block : {flat(c.U), flat(c.B), flat(c.V), flat(c.B_t)}) blocks.push_back(block);
  blocks.push_back(numbers({c.clearance, tip_radius_of(c.geometry), c.offset(0), c.offset(1)}));
  for (const double value : {c.rim_speed, c.friction.mu}) blocks.push_back(numbers({value}));
  if (c.turns()) {
    blocks.push_back(numbers({turning_ratio_of(c.geometry) * phase_rate}));
    if (const auto* row = rolling_elements(c.geometry)) add_elements(*row, phase_rate, blocks);
  }
  if (c.friction.tolerance > 0.0) blocks.push_back(numbers({1.0 / c.friction.tolerance}));
  if (const auto n = direction_of(c.geometry)) blocks.push_back(*n);
  if (is_wall(c.geometry)) {
    for (const double value : wall_numbers_of(c.geometry, c.clearance)) {
      blocks.push_back(numbers({value}));
    }
  }
  std::visit([&](const auto& law) { add_law(law, blocks); }, c.law);
}

void add_film(const ReducedFilm& film, std::vector<Vec>& blocks) {
  for (const Vec& block : {flat(film.U), flat(film.B)}) blocks.push_back(block);
  const double inverse = 1.0 / film.clearance;
  blocks.push_back(film.offset);
  for (const double value : {inverse, inverse / film.rate, film.factor * film.rate, film.spin}) {
    blocks.push_back(numbers({value}));
  }
}

}  // namespace

std::vector<Vec> numbers_of(const ContactSystem& system) {
  std::vector<Vec> blocks{flat(system.K()), flat(system.D()), numbers({system.phase_rate()}),
                          numbers({system.period()})};
  for (const ReducedExcitation& o : system.excitations()) {
    for (const Vec& block : {o.cosine, o.sine, numbers({o.ratio * system.phase_rate()})}) {
      blocks.push_back(block);
    }
  }
  for (const ReducedContact& c : system.contacts()) {
    add_contact(c, system.phase_rate(), blocks);
  }
  for (const ReducedFilm& film : system.films()) add_film(film, blocks);
  return blocks;
}

}  // namespace whirl::inline dyn

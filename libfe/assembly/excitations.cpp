#include "libfe/assembly/excitations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

/// Along (x, y), of size one.
std::array<Complex, 2> direction_of(const Force& f) {
  const Complex i(0.0, 1.0), ahead = std::polar(1.0, f.phase);
  switch (f.turning) {
    case Turning::forward:
      return {ahead, -i * ahead};
    case Turning::backward:
      return {std::conj(ahead), i * std::conj(ahead)};
    case Turning::no:
      break;
  }
  return {ahead * std::cos(f.angle), ahead * std::sin(f.angle)};
}

/// A force as one of the loads.
Excitation excitation_of(const Force& f, const Assembler& assembler) {
  return {f.order, f.frequency, Growth::none, amplitude_of(f, assembler), f.name};
}

/// The load of a shaft with a ratio of speeds, as one of the angle of the first shaft: against its
/// sense Re(u e^(-i alpha)) is Re(conj(u) e^(i alpha)).
CVec turned_by(double speed, CVec amplitude) {
  return speed < 0.0 ? CVec(amplitude.conjugate()) : amplitude;
}

/// Those of further shafts whose bow loads them; of their angles or, where they stand, constant.
std::vector<Excitation> other_bows(const Assembler& assembler) {
  std::vector<Excitation> all;
  const std::vector<Rotor>& rotors = assembler.structure().rotors;
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    const Rotor& rotor = rotors[i];
    if (rotor.bow.z.empty()) continue;
    Excitation bow{.amplitude = assembler.bow(static_cast<int>(i) + 1),
                   .names = "bow of " + rotor.name};
    if (rotor.has_own_speed()) {
      bow.amplitude = turned_by(std::ranges::min(rotor.own), std::move(bow.amplitude));
      bow.frequency = rotor.own.size() == 1 ? std::abs(rotor.own.front()) : 0.0;
      bow.rotor = &rotor;
    } else {
      bow.amplitude = turned_by(rotor.ratio, std::move(bow.amplitude));
      bow.order = std::abs(rotor.ratio);
    }
    all.push_back(std::move(bow));
  }
  return all;
}

/// Whether some further shafts are bent.
template <class Is>
bool any_bow(const Structure& structure, const Is& is) {
  return std::ranges::any_of(structure.rotors,
                             [&](const Rotor& rotor) { return !rotor.bow.z.empty() && is(rotor); });
}

/// Ratios of the speeds of shafts with unbalance to that of the first one, each once; of those that
/// turn at its own speed and of those that stand there is nothing to be said.
std::vector<double> other_unbalanced_ratios(const Structure& structure) {
  std::vector<double> ratios;
  if (structure.rotors.empty() || structure.unbalances.empty()) return ratios;
  const Mesh mesh = make_mesh(structure);
  for (const Unbalance& u : structure.unbalances) {
    const double ratio = shaft_ratio(resolve(u.at, structure, mesh), structure, mesh);
    if (ratio == 1.0 || ratio == 0.0 || std::isnan(ratio)) continue;
    if (std::ranges::find(ratios, ratio) == ratios.end()) ratios.push_back(ratio);
  }
  std::ranges::sort(ratios);
  return ratios;
}

/// The unbalance of shafts that turn at another speed than the first one.
std::vector<Excitation> other_unbalances(const Assembler& assembler) {
  std::vector<Excitation> all;
  for (const double ratio : other_unbalanced_ratios(assembler.structure())) {
    CVec amplitude = turned_by(ratio, ratio * ratio * assembler.unbalance(ratio));
    std::string names;
    for (const Rotor& rotor : assembler.structure().rotors) {
      if (rotor.ratio != ratio) continue;
      names += fmt::format("{}unbalance of {}", names.empty() ? "" : ", ", rotor.name);
    }
    all.push_back({.order = std::abs(ratio),
                   .growth = Growth::unbalance,
                   .amplitude = std::move(amplitude),
                   .names = names});
  }
  for (const Rotor& rotor : assembler.structure().rotors) {
    if (!rotor.has_own_speed()) continue;
    CVec amplitude = assembler.unbalance_of(rotor);
    if (amplitude.isZero(0.0)) continue;
    all.push_back({.frequency = rotor.own.size() == 1 ? std::abs(rotor.own.front()) : 0.0,
                   .growth = Growth::unbalance,
                   .amplitude = turned_by(std::ranges::min(rotor.own), std::move(amplitude)),
                   .names = "unbalance of " + rotor.name,
                   .rotor = &rotor});
  }
  return all;
}

bool any_of(const Structure& s, bool (Force::*is)() const) {
  return std::any_of(s.forces.begin(), s.forces.end(), [&](const Force& f) { return (f.*is)(); });
}

}  // namespace

double Excitation::growth_at(double Omega) const {
  if (growth == Growth::none) return 1.0;
  const double speed = rotor ? frequency_at(Omega) : Omega;
  return speed * speed;
}

double Excitation::frequency_at(double Omega) const {
  if (rotor) return std::abs(rotor->speed_at(Omega));
  return order > 0.0 ? order * Omega : frequency;
}

std::string Excitation::label() const {
  if (rotor) return "speed of " + rotor->name;
  if (order > 0.0) return fmt::format("{:.6g}x", order);
  return fmt::format("{:.6g} Hz", frequency / (2.0 * std::numbers::pi));
}

CVec amplitude_of(const Force& force, const Assembler& assembler) {
  const auto [x, y] = direction_of(force);
  if (force.kind == ForceKind::base_acceleration) {
    const Vec along_x = assembler.inertia_load({-force.size, 0.0}),
              along_y = assembler.inertia_load({0.0, -force.size});
    return x * along_x.cast<Complex>() + y * along_y.cast<Complex>();
  }
  const DofMap& dofs = assembler.dofs();
  CVec load = CVec::Zero(dofs.full_size);
  const Point p = assembler.point(force.at);
  const int first = force.kind == ForceKind::moment ? THETA_X : X;
  load(dofs.full_index(p, first)) = force.size * x;
  load(dofs.full_index(p, first + 1)) = force.size * y;
  return load;
}

std::vector<Excitation> constant_excitations(const Assembler& assembler) {
  std::vector<Excitation> all{{.amplitude = assembler.gravity_load().cast<Complex>()}};
  for (const Force& f : assembler.structure().forces) {
    if (f.is_constant()) all.push_back(excitation_of(f, assembler));
  }
  for (Excitation& e : other_bows(assembler)) {
    if (e.is_constant()) all.push_back(std::move(e));
  }
  return all;
}

std::vector<Excitation> synchronous_excitations(const Assembler& assembler) {
  const Structure& s = assembler.structure();
  std::vector<Excitation> all;
  if (!s.unbalances.empty()) {
    all.push_back({.order = 1.0, .growth = Growth::unbalance, .amplitude = assembler.unbalance()});
  }
  if (!s.bow.z.empty()) all.push_back({.order = 1.0, .amplitude = assembler.bow()});
  for (const auto& of : {other_unbalances(assembler), other_bows(assembler)}) {
    std::ranges::copy_if(of, std::back_inserter(all), &Excitation::is_synchronous);
  }
  for (const Force& f : s.forces) {
    if (f.is_synchronous()) all.push_back(excitation_of(f, assembler));
  }
  return all;
}

std::vector<Excitation> other_excitations(const Assembler& assembler) {
  // orders come before frequencies
  std::map<std::tuple<bool, double, Growth, std::string>, Excitation> all;
  const auto add = [&](const Excitation& own) {
    const bool has_order = own.order > 0.0;
    const auto [at, is_new] = all.try_emplace({!has_order, has_order ? own.order : own.frequency,
                                               own.growth, own.rotor ? own.rotor->name : ""},
                                              own);
    if (is_new) return;
    at->second.amplitude += own.amplitude;
    at->second.names += ", " + own.names;
  };
  for (const Force& f : assembler.structure().forces) {
    if (!f.is_constant() && !f.is_synchronous()) add(excitation_of(f, assembler));
  }
  for (const auto& of : {other_unbalances(assembler), other_bows(assembler)}) {
    for (const Excitation& e : of) {
      if (!e.is_constant() && !e.is_synchronous()) add(e);
    }
  }
  std::vector<Excitation> excitations;
  for (auto& [key, excitation] : all) excitations.push_back(std::move(excitation));
  return excitations;
}

bool acts_at(const std::vector<Excitation>& excitations, double Omega) {
  return std::any_of(excitations.begin(), excitations.end(),
                     [&](const Excitation& e) { return e.growth_at(Omega) != 0.0; });
}

CVec sum_at(const std::vector<Excitation>& excitations, const Assembler& assembler, double Omega) {
  if (excitations.empty()) return CVec::Zero(assembler.dofs().full_size);
  CVec sum = excitations[0].growth_at(Omega) * excitations[0].amplitude;
  for (std::size_t i = 1; i < excitations.size(); ++i) {
    sum += excitations[i].growth_at(Omega) * excitations[i].amplitude;
  }
  return sum;
}

std::vector<Excitation> excitations_at(const Assembler& assembler, double Omega) {
  std::vector<Excitation> all{
      {.amplitude = sum_at(constant_excitations(assembler), assembler, Omega)},
      {.order = 1.0, .amplitude = sum_at(synchronous_excitations(assembler), assembler, Omega)}};
  for (Excitation& e : other_excitations(assembler)) {
    e.amplitude *= e.growth_at(Omega);
    e.frequency = e.order > 0.0 ? 0.0 : e.frequency_at(Omega);
    e.growth = Growth::none;
    e.rotor = nullptr;
    all.push_back(std::move(e));
  }
  return all;
}

Vec static_load(const Assembler& assembler, double Omega) {
  return sum_at(constant_excitations(assembler), assembler, Omega).real();
}

bool is_static_load_steady(const Assembler& assembler) {
  const std::vector<Excitation> loads = constant_excitations(assembler);
  return std::all_of(loads.begin(), loads.end(),
                     [](const Excitation& e) { return e.growth == Growth::none; });
}

Vec2 steady_acceleration(const Structure& structure) {
  Vec2 a(0.0, -structure.gravity);
  for (const Force& f : structure.forces) {
    if (f.kind != ForceKind::base_acceleration || !f.is_constant()) continue;
    const auto [x, y] = direction_of(f);
    a -= f.size * Vec2(x.real(), y.real());
  }
  return a;
}

double highest_frequency(const Structure& structure, double Omega) {
  double highest = 0.0;
  for (const Force& f : structure.forces) {
    highest = std::max({highest, f.order * std::abs(Omega), f.frequency});
  }
  for (const double ratio : other_unbalanced_ratios(structure)) {
    highest = std::max(highest, std::abs(ratio * Omega));
  }
  for (const Rotor& rotor : structure.rotors) {
    const bool counts = rotor.has_own_speed() || !rotor.bow.z.empty();
    if (counts) highest = std::max(highest, std::abs(rotor.speed_at(Omega)));
  }
  return highest;
}

bool has_oscillating_force(const Structure& structure) {
  const std::vector<Force>& forces = structure.forces;
  return std::any_of(forces.begin(), forces.end(),
                     [](const Force& f) { return !f.is_constant() && !f.is_synchronous(); }) ||
         std::ranges::any_of(other_unbalanced_ratios(structure),
                             [](double ratio) { return std::abs(ratio) != 1.0; }) ||
         (structure.rotor_of_own_speed() && !structure.unbalances.empty()) ||
         any_bow(structure, [](const Rotor& rotor) {
           const double ratio = std::abs(rotor.ratio);
           return rotor.has_own_speed() || (ratio != 1.0 && ratio != 0.0);
         });
}

bool has_constant_force(const Structure& structure) {
  return any_of(structure, &Force::is_constant) || any_bow(structure, [](const Rotor& rotor) {
           return !rotor.has_own_speed() && rotor.ratio == 0.0;
         });
}

bool has_synchronous_force(const Structure& structure) {
  return any_of(structure, &Force::is_synchronous);
}

bool has_synchronous_load(const Structure& structure) {
  return !structure.unbalances.empty() || !structure.bow.z.empty() ||
         has_synchronous_force(structure) || any_bow(structure, [](const Rotor& rotor) {
           return !rotor.has_own_speed() && std::abs(rotor.ratio) == 1.0;
         });
}

}  // namespace whirl::inline fe

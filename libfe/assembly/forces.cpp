#include "libfe/assembly/forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <utility>

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

/// Sum of some forces.
template <class Is>
CVec sum_of(const Assembler& assembler, const Is& is) {
  CVec sum = CVec::Zero(assembler.dofs().full_size);
  for (const Force& f : assembler.structure().forces) {
    if (is(f)) sum += amplitude_of(f, assembler);
  }
  return sum;
}

bool any_of(const Structure& s, bool (Force::*is)() const) {
  return std::any_of(s.forces.begin(), s.forces.end(), [&](const Force& f) { return (f.*is)(); });
}

}  // namespace

std::string OscillatingLoad::label() const {
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

Vec static_load(const Assembler& assembler) {
  const Vec weight = assembler.gravity_load();
  if (!has_constant_force(assembler.structure())) return weight;
  return weight + sum_of(assembler, [](const Force& f) { return f.is_constant(); }).real();
}

CVec synchronous_forces(const Assembler& assembler) {
  if (!any_of(assembler.structure(), &Force::is_synchronous)) return {};
  return sum_of(assembler, [](const Force& f) { return f.is_synchronous(); });
}

CVec synchronous_load(const Assembler& assembler, double Omega) {
  CVec load = assembler.turning_load(Omega);
  const CVec forces = synchronous_forces(assembler);
  if (forces.size() > 0) load += forces;
  return load;
}

std::vector<OscillatingLoad> oscillating_loads(const Assembler& assembler) {
  // orders come before frequencies
  std::map<std::pair<bool, double>, OscillatingLoad> all;
  for (const Force& f : assembler.structure().forces) {
    if (f.is_constant() || f.is_synchronous()) continue;
    const bool has_order = f.order > 0.0;
    const auto [at, is_new] = all.try_emplace({!has_order, has_order ? f.order : f.frequency});
    OscillatingLoad& load = at->second;
    if (is_new) load = {f.order, f.frequency, CVec::Zero(assembler.dofs().full_size)};
    load.amplitude += amplitude_of(f, assembler);
    load.forces += (load.forces.empty() ? "" : ", ") + f.name;
  }
  std::vector<OscillatingLoad> loads;
  for (auto& [key, load] : all) loads.push_back(std::move(load));
  return loads;
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
  return highest;
}

bool has_oscillating_force(const Structure& structure) {
  const std::vector<Force>& forces = structure.forces;
  return std::any_of(forces.begin(), forces.end(),
                     [](const Force& f) { return !f.is_constant() && !f.is_synchronous(); });
}

bool has_constant_force(const Structure& structure) {
  return any_of(structure, &Force::is_constant);
}

bool has_synchronous_load(const Structure& structure) {
  return !structure.unbalances.empty() || !structure.bow.z.empty() ||
         any_of(structure, &Force::is_synchronous);
}

}  // namespace whirl::inline fe

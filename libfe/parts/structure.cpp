#include "libfe/parts/structure.hpp"

#include <algorithm>

namespace whirl::inline fe {

std::vector<Structure::Shaft> Structure::shafts() const {
  static const std::string first;
  std::vector<Shaft> all{{shaft, first}};
  for (const Rotor& r : rotors) all.push_back({r.shaft, r.name, r.z, r.ratio});
  return all;
}

double Structure::extent() const {
  double furthest = 0.0;
  for (const Shaft& of : shafts()) {
    if (!of.segments.empty()) furthest = std::max(furthest, of.end());
  }
  return furthest;
}

std::optional<int> Structure::shaft_named(const std::string& rotor) const {
  if (rotor.empty()) return 0;
  const auto found = std::ranges::find(rotors, rotor, &Rotor::name);
  if (found == rotors.end()) return std::nullopt;
  return 1 + static_cast<int>(found - rotors.begin());
}

}  // namespace whirl::inline fe

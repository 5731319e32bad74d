#include "libfe/parts/structure.hpp"

#include <algorithm>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline fe {

double Rotor::speed_at(double Omega) const {
  if (!has_own_speed()) return ratio * Omega;
  const auto above = std::upper_bound(lead.begin(), lead.end(), Omega);
  if (above == lead.begin() || own.size() == 1) return own.front();
  if (above == lead.end()) return own.back();
  const auto i = static_cast<std::size_t>(above - lead.begin());
  const double share = (Omega - lead[i - 1]) / (lead[i] - lead[i - 1]);
  return own[i - 1] + share * (own[i] - own[i - 1]);
}

bool Structure::is_bent() const {
  return !bow.z.empty() ||
         std::ranges::any_of(rotors, [](const Rotor& rotor) { return !rotor.bow.z.empty(); });
}

void Structure::straighten() {
  bow = {};
  for (Rotor& rotor : rotors) rotor.bow = {};
}

const Rotor* Structure::rotor_of_own_speed() const {
  const auto found = std::ranges::find_if(rotors, &Rotor::has_own_speed);
  return found == rotors.end() ? nullptr : &*found;
}

std::vector<Structure::Shaft> Structure::shafts() const {
  static const std::string first;
  std::vector<Shaft> all{{shaft, first}};
  for (const Rotor& r : rotors) {
    const double ratio = r.has_own_speed() ? nan : r.ratio;
    all.push_back({r.shaft, r.name, r.z, ratio, &r});
  }
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

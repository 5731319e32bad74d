#include "libdyn/system/probes.hpp"

namespace whirl::inline dyn {

ProbeLabels::ProbeLabels(const std::vector<Probe>& probes) {
  for (const Probe& probe : probes) {
    names.push_back(probe.name);
    units.push_back(probe.unit);
    angles.push_back(probe.angle);
  }
}

ProbeLabel ProbeLabels::operator[](std::size_t i) const {
  ProbeLabel label;
  label.name = names.at(i);
  label.unit = i < units.size() ? units[i] : "um";
  label.angle = i < angles.size() ? angles[i] : 0.0;
  return label;
}

std::vector<ProbeLabel> ProbeLabels::list() const {
  std::vector<ProbeLabel> all;
  for (std::size_t i = 0; i < size(); ++i) all.push_back((*this)[i]);
  return all;
}

double peak_to_peak(double angle, const Complex& forward, const Complex& backward) {
  const Complex turn = std::polar(1.0, angle);
  return 2.0 * std::abs(forward * std::conj(turn) + std::conj(backward) * turn);
}

}  // namespace whirl::inline dyn

#include "libdyn/system/probes.hpp"

#include "libdyn/system/scene.hpp"

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

const std::vector<Probe>& probes_of(const Scene& scene) {
  return scene.assembler.structure().probes;
}

Mat probe_rows(const Scene& scene, const Mat& map) {
  return probe_rows(probes_of(scene), scene, map);
}

Mat probe_rows(const std::vector<Probe>& probes, const Scene& scene, const Mat& map) {
  Mat rows(std::ssize(probes), map.cols());
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Point point = scene.assembler.point(probes[i].at);
    const auto row = [&](Component c) -> Vec {
      return map.row(scene.reduced.dofs.full_index(point, c)).transpose();
    };
    rows.row(static_cast<Eigen::Index>(i)) = probes[i].along(row(X), row(Y)).transpose();
  }
  return rows;
}

double peak_to_peak(double angle, const Complex& forward, const Complex& backward) {
  const Complex turn = std::polar(1.0, angle);
  return 2.0 * std::abs(forward * std::conj(turn) + std::conj(backward) * turn);
}

}  // namespace whirl::inline dyn

#include "libdyn/system/probes.hpp"

#include "libdyn/system/scene.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline dyn {

ProbeLabels::ProbeLabels(const std::vector<Probe>& probes) {
  for (const Probe& probe : probes) {
    names.push_back(probe.name);
    units.push_back(probe.unit);
    angles.push_back(probe.angle);
    face_radii.push_back(probe.face_radius);
  }
}

ProbeLabel ProbeLabels::operator[](std::size_t i) const {
  ProbeLabel label;
  label.name = names.at(i);
  label.unit = i < units.size() ? units[i] : "um";
  label.angle = i < angles.size() ? angles[i] : 0.0;
  label.face_radius = i < face_radii.size() ? face_radii[i] : 0.0;
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
    const auto row = [&](int c) -> Vec {
      return map.row(scene.reduced.dofs.full_index(point, c)).transpose();
    };
    rows.row(static_cast<Eigen::Index>(i)) = probes[i].reading(row).transpose();
  }
  return rows;
}

}  // namespace whirl::inline dyn

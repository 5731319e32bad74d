#pragma once
/// What displacement probes read, as rows of results.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/column.hpp"
#include "libfe/parts/probe.hpp"

namespace whirl::inline dyn {

struct Scene;

/// A probe as results name it; rows of results begin with its columns.
struct ProbeLabel {
  std::string name;
  double angle = 0.0;        ///< of its direction, from +x towards +y [rad]
  double face_radius = 0.0;  ///< of an axial probe [m]; 0: the probe looks across the shaft
  std::string unit;          ///< of length, in which people are told readings

  ProbeLabel() = default;
  ProbeLabel(const Probe& probe)
      : name(probe.name), angle(probe.angle), face_radius(probe.face_radius), unit(probe.unit) {}

  double angle_deg() const { return angle / degree; }
  bool is_axial() const { return face_radius > 0.0; }
  std::optional<double> radius_if_axial() const {
    return is_axial() ? std::optional(face_radius) : std::nullopt;
  }

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("name", &ProbeLabel::name, "", "probe").axis(),
        column("angle", &ProbeLabel::angle, "rad", "direction of a probe, from +x towards +y")
            .only(in_file),
        column("angle_deg", &ProbeLabel::angle_deg, "", "the same in degrees").only(in_json),
        column("face_radius", &ProbeLabel::face_radius, "m",
               "where a probe looks along the shaft at a face; 0: across the shaft")
            .only(in_file)
            .maybe(),
        column("face_radius", &ProbeLabel::radius_if_axial, "m", "the same").only(in_json).maybe(),
        column("unit", &ProbeLabel::unit, "", "in which people are told what it reads")};
  }
};

/// Labels of probes as columns of their own, for results whose rows are something else.
struct ProbeLabels {
  std::vector<std::string> names, units;
  std::vector<double> angles;      ///< [rad]
  std::vector<double> face_radii;  ///< [m]

  ProbeLabels() = default;
  explicit ProbeLabels(const std::vector<Probe>& probes);

  std::size_t size() const { return names.size(); }
  ProbeLabel operator[](std::size_t i) const;
  std::vector<ProbeLabel> list() const;
};

/// Columns of the labels of a result that has them as its member `probes`.
constexpr auto probe_label_columns() {
  using enum Written;
  return ColumnList{column(
                        "probe_name", [](auto& r) -> auto& { return r.probes.names; }, "", "probe")
                        .axis("probes")
                        .only(in_file)
                        .maybe(),
                    column(
                        "probe_angle", [](auto& r) -> auto& { return r.probes.angles; }, "rad",
                        "direction of a probe, from +x towards +y")
                        .along("probes")
                        .only(in_file)
                        .maybe(),
                    column(
                        "probe_face_radius", [](auto& r) -> auto& { return r.probes.face_radii; },
                        "m", "where a probe looks along the shaft at a face; 0: across the shaft")
                        .along("probes")
                        .only(in_file)
                        .maybe(),
                    column(
                        "probe_unit", [](auto& r) -> auto& { return r.probes.units; }, "",
                        "in which people are told what it reads")
                        .along("probes")
                        .only(in_file)
                        .maybe()};
}

/// The probes of a scene's model.
const std::vector<Probe>& probes_of(const Scene& scene);

/// What probes read of reduced coordinates, probes x coordinates.
/// @param map  the displacement_map() of the scene
/// @throws ModelError  for a probe at a station that does not exist
Mat probe_rows(const std::vector<Probe>& probes, const Scene& scene, const Mat& map);
/// The same of the probes of the scene's model.
Mat probe_rows(const Scene& scene, const Mat& map);

}  // namespace whirl::inline dyn

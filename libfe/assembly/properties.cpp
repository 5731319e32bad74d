#include "libfe/assembly/properties.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/quadrature.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

/// A thin slice of the shaft or of a layer beside it.
struct Slice {
  Section section;
  double rho = 0.0;  ///< [kg/m^3]
  double z = 0.0, length = 0.0;

  double mass() const { return rho * section.A() * length; }
};

/// Slices whose sums are exact integrals over what lies between two positions.
/// @param visit  takes a slice and the number of its shaft
template <class Visit>
void visit_slices(const Structure& structure, const Mesh& mesh, double from, double to,
                  const Visit& visit) {
  const Quadrature q = Quadrature::gauss(3);  // of polynomials of the fourth degree
  const auto visit_part = [&](const auto& part, double start, double whole, int shaft) {
    const double first = std::clamp((from - start) / whole, 0.0, 1.0);
    const double share = std::clamp((to - start) / whole, 0.0, 1.0) - first;
    if (!(share > 0.0)) return;
    for (int i = 0; i < 3; ++i) {
      const double x = first + share * q.x(i);
      visit(Slice{between(part.left, part.right, x), part.material.rho, start + x * whole,
                  q.w(i) * share * whole},
            shaft);
    }
  };
  int number = 0;
  for (const Structure::Shaft& shaft : structure.shafts()) {
    double start = shaft.start;
    for (const Segment& segment : shaft.segments) {
      visit_part(segment, start, segment.length, number);
      start += segment.length;
    }
    ++number;
  }
  for (const Layer& layer : structure.layers) {
    if (layer.carries == Carries::stiffness) continue;
    const LayerSpan span = span_of(layer, structure, mesh);
    visit_part(layer, span.from, span.to - span.from, span.shaft);
  }
}

}  // namespace

RotorProperties rotor_properties(const Structure& structure, const Mesh& mesh) {
  RotorProperties p;
  double on_shaft = 0.0, moment = 0.0, second = 0.0;
  visit_slices(structure, mesh, -INFINITY, INFINITY, [&](const Slice& s, int) {
    on_shaft += s.mass();
    moment += s.mass() * s.z;
    second += s.mass() * s.z * s.z;
    p.Ip += s.rho * 2.0 * s.section.I() * s.length;
    p.Id += s.rho * s.section.I() * s.length;
  });
  for (const Disk& disk : structure.disks) {
    on_shaft += disk.m;
    const double z = mesh.position_of(resolve(disk.at, structure, mesh)).value();
    moment += disk.m * z;
    second += disk.m * z * z;
    p.Ip += disk.Ip;
    p.Id += disk.Id;
  }
  p.mass = on_shaft;
  p.center_of_mass = on_shaft > 0.0 ? moment / on_shaft : 0.0;
  p.Id += second - moment * p.center_of_mass;
  for (const Body& body : structure.bodies) {
    if (!body.spins) continue;
    p.mass += body.m.x;
    p.Ip += body.Ip;
  }
  return p;
}

double mass_beyond(const Structure& structure, const Mesh& mesh, double z, bool to_the_right,
                   int shaft) {
  double mass = 0.0;
  visit_slices(structure, mesh, to_the_right ? z : -INFINITY, to_the_right ? INFINITY : z,
               [&](const Slice& s, int of) { mass += of == shaft ? s.mass() : 0.0; });
  for (const Disk& disk : structure.disks) {
    const Point point = resolve(disk.at, structure, mesh);
    if (shaft_of(point, structure, mesh) != shaft) continue;
    const double at = mesh.position_of(point).value();
    if (to_the_right ? at > z : at < z) mass += disk.m;
  }
  return mass;
}

}  // namespace whirl::inline fe

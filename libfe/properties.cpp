#include "libfe/properties.hpp"

#include "libbase/quadrature.hpp"

namespace whirl::inline fe {

RotorProperties rotor_properties(const Structure& structure, const Mesh& mesh) {
  RotorProperties p;
  double on_shaft = 0.0, moment = 0.0, start = 0.0;
  const Quadrature q = Quadrature::gauss(3);  // of polynomials of the fourth degree
  for (const Segment& segment : structure.shaft) {
    for (int i = 0; i < 3; ++i) {
      const Section section = segment.at(q.x(i));
      const double length = q.w(i) * segment.length;
      const double mass = segment.material.rho * section.A() * length;
      on_shaft += mass;
      moment += mass * (start + q.x(i) * segment.length);
      p.Ip += segment.material.rho * 2.0 * section.I() * length;
    }
    start += segment.length;
  }
  for (const Disk& disk : structure.disks) {
    const Point point = resolve(disk.at, structure, mesh);
    on_shaft += disk.m;
    moment += disk.m * mesh.z[static_cast<std::size_t>(point.index)];
    p.Ip += disk.Ip;
  }
  p.mass = on_shaft;
  p.center_of_mass = on_shaft > 0.0 ? moment / on_shaft : 0.0;
  for (const Body& body : structure.bodies) {
    if (!body.spins) continue;
    p.mass += body.m;
    p.Ip += body.Ip;
  }
  return p;
}

}  // namespace whirl::inline fe

#include "libfe/assembly/properties.hpp"

#include "libbase/numerics/quadrature.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

RotorProperties rotor_properties(const Structure& structure, const Mesh& mesh) {
  RotorProperties p;
  double on_shaft = 0.0, moment = 0.0, second = 0.0, start = 0.0;
  const Quadrature q = Quadrature::gauss(3);  // of polynomials of the fourth degree
  const auto add_part = [&](const auto& part, double from, double whole) {
    for (int i = 0; i < 3; ++i) {
      const Section section = between(part.left, part.right, q.x(i));
      const double length = q.w(i) * whole;
      const double mass = part.material.rho * section.A() * length;
      on_shaft += mass;
      const double z = from + q.x(i) * whole;
      moment += mass * z;
      second += mass * z * z;
      p.Ip += part.material.rho * 2.0 * section.I() * length;
      p.Id += part.material.rho * section.I() * length;
    }
  };
  for (const Segment& segment : structure.shaft) {
    add_part(segment, start, segment.length);
    start += segment.length;
  }
  for (const Layer& layer : structure.layers) {
    if (layer.carries == Carries::stiffness) continue;
    const LayerSpan span = span_of(layer, structure, mesh);
    add_part(layer, span.from, span.to - span.from);
  }
  for (const Disk& disk : structure.disks) {
    const Point point = resolve(disk.at, structure, mesh);
    on_shaft += disk.m;
    const double z = mesh.z[static_cast<std::size_t>(point.index)];
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

}  // namespace whirl::inline fe

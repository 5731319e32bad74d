// Loads of the assembled rotor: weight, unbalance, bow.

#include <complex>
#include <optional>
#include <vector>

#include "libfe/assembly/assemble.hpp"
#include "libfe/mesh/shaft_elements.hpp"
#include "libfe/parts/bow.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

Vec Assembler::gravity_load() const {
  return inertia_load({0.0, -structure_->gravity});
}

Vec Assembler::inertia_load(const Vec2& a) const {
  Vec acceleration = Vec::Zero(dofs().full_size);
  for (const Point& p : dofs().points()) {
    for (const int component : {X, Y}) acceleration(dofs().full_index(p, component)) = a(component);
  }
  return assembled_->weighing * acceleration;
}

CVec Assembler::unbalance(double ratio) const {
  std::vector<bool> counts;
  for (const Structure::Shaft& shaft : structure_->shafts()) counts.push_back(shaft.ratio == ratio);
  return unbalance_of_shafts(counts);
}

CVec Assembler::unbalance_of(const Rotor& rotor) const {
  std::vector<bool> counts;
  for (const Structure::Shaft& shaft : structure_->shafts()) {
    counts.push_back(shaft.rotor == &rotor);
  }
  return unbalance_of_shafts(counts);
}

CVec Assembler::unbalance_of_shafts(const std::vector<bool>& counts) const {
  CVec u = CVec::Zero(dofs().full_size);
  for (const Unbalance& unbalance : structure_->unbalances) {
    const Point p = point(unbalance.at);
    const std::optional<int> shaft = shaft_of(p, *structure_, mesh());
    if (!shaft || !counts[static_cast<std::size_t>(*shaft)]) continue;
    const Complex amplitude = std::polar(unbalance.moment, unbalance.phase);
    u(dofs().full_index(p, X)) += amplitude;
    u(dofs().full_index(p, Y)) += Complex(0.0, -1.0) * amplitude;
  }
  return u;
}

CVec Assembler::bow(int shaft) const {
  CVec force = CVec::Zero(dofs().full_size);
  const std::vector<BowState> states = bow_states(structure_->bow_of(shaft), mesh().z);
  if (states.empty()) return force;
  // x + i y = r turns with the shaft: u_x = r, u_y = -i r, and theta_y = x', theta_x = -y'
  CVec displacement = CVec::Zero(dofs().full_size);
  for (int i = 0; i < mesh().nodes(); ++i) {
    const auto& [r, slope] = states[static_cast<std::size_t>(i)];
    displacement.segment<4>(4 * i) << r, Complex(0.0, -1.0) * r, Complex(0.0, 1.0) * slope, slope;
  }
  for (std::size_t e = 0; e < mesh().elements.size(); ++e) {
    if (mesh().elements[e].shaft != shaft) continue;
    const std::vector<int> index = indices(dofs(), {Point::Kind::node, mesh().elements[e].left},
                                           {Point::Kind::node, mesh().elements[e].right});
    for (Beam beam : beams_along(e, *structure_, mesh())) {
      beam.axial_force = beam.torque = 0.0;  // these act along the true line, not the unbent one
      const Mat K = matrices(beam).K.topLeftCorner<8, 8>();
      force(index) += K * displacement(index);
    }
  }
  return force;
}

}  // namespace whirl::inline fe

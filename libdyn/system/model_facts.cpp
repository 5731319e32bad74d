#include "libdyn/system/model_facts.hpp"

#include "libfe/assemble.hpp"
#include "libfe/properties.hpp"

namespace whirl::inline dyn {

ModelFacts model_facts(const Model& model, const Assembler& assembler) {
  const Structure& s = model.structure;
  const RotorProperties rotor = rotor_properties(s, assembler.mesh());
  ModelFacts facts{.mass = rotor.mass,
                   .length = s.length(),
                   .nodes = static_cast<int>(assembler.mesh().nodes()),
                   .dofs = assembler.dofs().size(),
                   .condensed_dofs = assembler.at(model.speed).dofs.condensed,
                   .contacts = static_cast<long>(model.contacts.size()),
                   .polar_inertia = rotor.Ip};
  if (!s.shaft.empty()) facts.center_of_mass = rotor.center_of_mass;
  return facts;
}

}  // namespace whirl::inline dyn

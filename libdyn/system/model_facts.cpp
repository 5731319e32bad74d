#include "libdyn/system/model_facts.hpp"

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/resting_rotor.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libfe/assembly/properties.hpp"

namespace whirl::inline dyn {

namespace {

/// What the rotor rests on, and how near to its stators.
void find_rest(const Model& model, const Assembler& assembler, ModelFacts& facts) {
  try {
    const RestingRotor rotor = resting_rotor(model, assembler, model.speed);
    facts.bearing_loads = rotor.journal_loads(model);
    facts.clearances = running_clearances(model, assembler, rotor.at_rest.displacement);
  } catch (const ModelError& error) {
    facts.no_rest = error.problems().front().message;
  } catch (const NumericalError& error) {
    facts.no_rest = error.what();
  }
}

}  // namespace

ModelFacts model_facts(const Model& model, const Assembler& assembler) {
  const Structure& s = model.structure;
  const RotorProperties rotor = rotor_properties(s, assembler.mesh());
  ModelFacts facts{.mass = rotor.mass,
                   .length = s.length(),
                   .nodes = static_cast<int>(assembler.mesh().nodes()),
                   .dofs = assembler.dofs().size(),
                   .condensed_dofs = assembler.at(model.speed).dofs.condensed,
                   .contacts = std::ssize(stator_contacts(model.contacts)),
                   .polar_inertia = rotor.Ip};
  if (!s.shaft.empty()) {
    facts.center_of_mass = rotor.center_of_mass;
    facts.transverse_inertia = rotor.Id;
  }
  find_rest(model, assembler, facts);
  return facts;
}

}  // namespace whirl::inline dyn

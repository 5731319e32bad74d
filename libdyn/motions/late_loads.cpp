#include "libdyn/motions/late_loads.hpp"

#include <algorithm>

#include "libdyn/system/model.hpp"

namespace whirl::inline dyn {

namespace {

double revolutions_until(const Beginning& begins, const Clock& clock) {
  return begins.revolutions + begins.time / clock.period();
}

}  // namespace

LateLoads::LateLoads(const Model& model, const Scene& scene) {
  const Clock& clock = scene.contacts.clock();
  std::vector<double> instants;
  const auto note = [&](const auto& loads) {
    for (const auto& load : loads) {
      if (load.begins.is_late()) instants.push_back(revolutions_until(load.begins, clock));
    }
  };
  note(model.structure.unbalances);
  note(model.structure.forces);
  std::ranges::sort(instants);
  instants.erase(std::ranges::unique(instants).begin(), instants.end());
  for (const double until : instants) {
    Model there = model;
    // their stations stay: without these the mesh could be another one
    const auto is_ahead = [&](const Beginning& begins) {
      return begins.is_late() && revolutions_until(begins, clock) >= until;
    };
    for (Unbalance& u : there.structure.unbalances) {
      if (is_ahead(u.begins)) u.moment = 0.0;
    }
    for (Force& f : there.structure.forces) {
      if (is_ahead(f.begins)) f.size = 0.0;
    }
    const Assembler assembler = scene.assembler.with_loads_of(there.structure).value();
    Scene before{assembler, scene.system, scene.reduced, scene.error,
                 ContactSystem(assembler, scene.reduced, there.contacts, there.films)};
    before_.push_back(std::make_unique<Before>(std::move(before), there));
    stages_.push_back({&before_.back()->scene.contacts, &before_.back()->supports, until});
  }
}

}  // namespace whirl::inline dyn

// The engine in quadruple precision. Compiled once, for what every processor has: all its templates
// are those of QuadPack, which nothing else knows, so that they do not meet those of batch.cpp.

#include <memory>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/quad_pack.hpp"
// after the pack that they are for
#include "libdyn/taylor/engine_events-inl.h"
#include "libdyn/taylor/engine_step-inl.h"
#include "libdyn/taylor/motion_bodies-inl.h"
#include "libdyn/taylor/variation_films-inl.h"

namespace whirl::inline dyn {

void integrate_quad(Trajectory& trajectory, const BatchOptions& options) {
  const Pattern pattern = pattern_of({&trajectory, 1});
  using Engine = HWY_NAMESPACE::Engine<HWY_NAMESPACE::QuadPack>;
  std::make_unique<Engine>(pattern, options)->run({&trajectory, 1}, nullptr);
}

}  // namespace whirl::inline dyn

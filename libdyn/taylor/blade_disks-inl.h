// Disks of contacts with blades: their places, from which those of the blades follow.

#if defined(WHIRL_BLADE_DISKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_BLADE_DISKS_INL_H
#undef WHIRL_BLADE_DISKS_INL_H
#else
#define WHIRL_BLADE_DISKS_INL_H
#endif

#include <memory>
#include <vector>

#include "libdyn/taylor/contact_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// What the blades of each contact share, known to them.
template <class P>
std::vector<std::unique_ptr<BladeLanes<P>>> disks_of(const Pattern& pattern,
                                                     std::vector<ContactLanes<P>>& contacts) {
  std::vector<std::unique_ptr<BladeLanes<P>>> disks;
  for (const Pattern::TurningGroup& group : pattern.turning) {
    disks.push_back(std::make_unique<BladeLanes<P>>());
    disks.back()->first = group.first;
    disks.back()->count = group.count;
    for (size_t i = 0; i < group.count; ++i) contacts[group.first + i].disk = disks.back().get();
  }
  return disks;
}

/// Tells what turns at a speed of its own that a lane begins a revolution.
template <class P>
HWY_ATTR void begin_turning(const std::vector<std::unique_ptr<BladeLanes<P>>>& disks,
                            std::vector<ContactLanes<P>>& contacts, const ContactSystem& s,
                            long revolution, int l) {
  for (const auto& disk : disks) {
    disk->begin_revolution(s.contacts()[disk->first], revolution, l);
    for (size_t i = disk->first; i < disk->first + disk->count; ++i) {
      if (contacts[i].shapes) contacts[i].shapes->begin_revolution(s.contacts()[i], revolution, l);
    }
  }
}

/// Coefficient k of the displacement of a disk, and what follows from it for its blades.
template <class P>
HWY_ATTR inline void extend(BladeLanes<P>& disk, const std::vector<ContactLanes<P>>& contacts,
                            const P* x, int k) {
  const ContactLanes<P>& blade = contacts[disk.first];
  blade.displacement(x, disk.ux[k], disk.uy[k]);
  if (k == 0) {
    disk.ux[0] = disk.ux[0] - blade.offset_x;
    disk.uy[0] = disk.uy[0] - blade.offset_y;
  }
  disk.extend(k);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard

#include "libdyn/taylor/mixed.hpp"

#include <map>

namespace whirl::inline dyn {

namespace {

constexpr std::size_t few = 2;  ///< trajectories that are faster one by one than in lanes

}  // namespace

void integrate_mixed(std::vector<Trajectory>& all, const BatchOptions& options) {
  std::map<std::vector<std::size_t>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::size_t> shape{static_cast<std::size_t>(all[i].system->coordinates())};
    for (const ReducedContact& c : all[i].system->contacts()) {
      shape.push_back(c.law.index());
      shape.push_back(c.geometry.index());
    }
    for (const ReducedFilm& f : all[i].system->films()) shape.push_back(100 + formula_of(f.law));
    groups[shape].push_back(i);
  }
  for (const auto& [shape, members] : groups) {
    if (members.size() <= few) {
      for (const std::size_t i : members) integrate_single(all[i], options);
      continue;
    }
    std::vector<Trajectory> batch;
    for (const std::size_t i : members) batch.push_back(std::move(all[i]));
    integrate_batch(batch, options);
    for (std::size_t i = 0; i < members.size(); ++i) all[members[i]] = std::move(batch[i]);
  }
}

}  // namespace whirl::inline dyn

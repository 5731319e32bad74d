#pragma once
/// Critical speeds in the plane of the speeds of two shafts: what the further one excites.

#include <cstddef>
#include <optional>
#include <string>

#include "libdyn/linear/critical_over.hpp"

namespace whirl::inline dyn {

/// Number among the rotors of the one whose speed a path names, "rotor.hp.speed" or
/// "rotor.1.speed"; nothing for another path.
std::optional<std::size_t> rotor_of_speed(const Structure& structure, const std::string& path);

/// Adds the lines along which a further shaft excites natural frequencies, where the values are its
/// speed; nothing where they are not.
///
/// At each speed of the first shaft, from rest to the highest critical speed of the branches, all
/// speeds of the further one within the values are found at which it is a natural frequency.
void add_own_branches(const ModelAt& model_at, const ShapeSampler& sampler,
                      const CriticalOptions& options, CriticalOver& to);

}  // namespace whirl::inline dyn

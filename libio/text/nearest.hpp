#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace whirl::inline io {

/// The known word that someone who wrote `word` most likely meant, if one is close enough.
///
/// Distance: a letter missing, too many or wrong costs 2, two neighbors swapped 2, a wrong case 1.
/// Close enough is a distance up to the length of `word`, but no more than 6; of several words the
/// first. If none is close enough, the first known word that `word` is a part of, as "diameter" of
/// "outer_diameter".
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> known);

/// What to say of the first word that looks like an option ("--name", "--name=value") and is no
/// known option, with the option that was meant; nothing: there is no such word.
std::optional<std::string> unknown_option(std::span<const std::string> words,
                                          std::span<const std::string> known);

}  // namespace whirl::inline io

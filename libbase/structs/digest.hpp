#pragma once

#include <cstdint>
#include <string_view>

namespace whirl::inline base {

/// A digest of bytes, to tell whether bytes are the same: Fowler, Noll and Vo's hash, variant 1a.
/// @param before  digest of the bytes before these
constexpr std::uint64_t digest_of(std::string_view bytes,
                                  std::uint64_t before = 14695981039346656037u) {
  for (const char byte : bytes) {
    before = (before ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  }
  return before;
}

}  // namespace whirl::inline base

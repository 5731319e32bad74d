#pragma once
/// Whether the tests are built with sanitizers: these make programs slow and take addresses.

namespace whirl::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace whirl::test

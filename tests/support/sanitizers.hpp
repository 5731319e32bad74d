#pragma once
/// Whether the tests are built with sanitizers: these make programs slow and take addresses.

namespace whirl::test {

#if defined(__has_feature)  // clang says it so, g++ by macros
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define WHIRL_IS_SANITIZED
#endif
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(WHIRL_IS_SANITIZED)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace whirl::test

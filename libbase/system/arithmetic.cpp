#include "libbase/system/arithmetic.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <string_view>
#include <system_error>
#include <vector>

#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

#include "libbase/structs/digest.hpp"

namespace whirl::inline base {

namespace {

/// Of the bits of numbers, the least byte first.
struct Digest {
  std::uint64_t value = digest_of("");

  void add(double number) {
    auto bits = std::bit_cast<std::uint64_t>(number);
    for (int i = 0; i < 8; ++i, bits >>= 8) {
      const char byte = static_cast<char>(bits & 0xff);
      value = digest_of({&byte, 1}, value);
    }
  }
  std::uint32_t folded() const { return static_cast<std::uint32_t>(value ^ (value >> 32)); }
};

using OfOne = double (*)(double);
using OfTwo = double (*)(double, double);

constexpr int arguments = 20'000;  ///< of each function; one in two thousand rounds otherwise

/// Adds values at multiples of a step, which are exact.
void add_values(Digest& digest, OfOne function, double step) {
  const volatile OfOne f = function;  // as it is loaded: no compiler computes it
  for (int i = 1; i <= arguments; ++i) digest.add(f(step * i));
}

void add_values(Digest& digest, OfTwo function) {
  const volatile OfTwo f = function;
  for (int i = 1; i <= arguments; ++i) digest.add(f(i % 211 / 64.0, (1 + i % 419) / 128.0));
}

std::string digest_of_functions() {
  Digest digest;
  constexpr double wide = 0x1p-11, narrow = 0x1p-15;  // to 9.8, to 0.61
  for (const OfOne f : std::initializer_list<OfOne>{std::sin, std::cos, std::tan, std::exp,
                                                    std::log, std::sinh, std::tanh, std::asinh}) {
    add_values(digest, f, wide);
  }
  add_values(digest, OfOne(std::acos), narrow);
  for (const OfTwo f : std::initializer_list<OfTwo>{std::atan2, std::pow, std::hypot}) {
    add_values(digest, f);
  }
  return fmt::format("{:08x}", digest.folded());
}

std::string library_name() {
#ifdef __GLIBC__
  return std::string("glibc ") + gnu_get_libc_version();
#else
  return "libm";
#endif
}

#if defined(__GLIBC__) && defined(__x86_64__)
/// The words of the command line of this process.
std::vector<std::string> own_words() {
  std::ifstream file("/proc/self/cmdline");
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

[[noreturn]] void start_again() {
  std::vector<std::string> words = own_words();
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (!words.empty()) ::execv("/proc/self/exe", argv.data());
  throw std::system_error(errno, std::generic_category(), "cannot start again");
}
#endif

}  // namespace

std::string mathematics() {
  static const std::string name = library_name() + ' ' + digest_of_functions();
  return name;
}

void use_portable_mathematics() {
#if defined(__GLIBC__) && defined(__x86_64__)
  // glibc reads its tunables when a program is loaded; the names with _Usable are those before 2.33
  constexpr const char* variable = "GLIBC_TUNABLES";
  constexpr std::string_view without =
      "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable,-FMA4_Usable";
  const char* const set = std::getenv(variable);
  const std::string tunables = set ? set : "";
  if (tunables.ends_with(without)) return;
  ::setenv(variable, (tunables + (tunables.empty() ? "" : ":") + std::string(without)).c_str(), 1);
  start_again();
#endif
}

}  // namespace whirl::inline base

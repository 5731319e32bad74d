#pragma once
/// Numbers and texts in the bytes of TDMS files, in either order of bytes.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace whirl::inline io {

/// Types of values.
enum TdmsType : std::uint32_t {
  tdms_int8 = 1,
  tdms_int16,
  tdms_int32,
  tdms_int64,
  tdms_uint8,
  tdms_uint16,
  tdms_uint32,
  tdms_uint64,
  tdms_float,
  tdms_double,
  tdms_float_with_unit = 0x19,
  tdms_double_with_unit = 0x1A,
  tdms_text = 0x20,
  tdms_boolean = 0x21,
  tdms_time = 0x44,
  tdms_complex_float = 0x08000C,
  tdms_complex_double = 0x10000D
};

/// Thrown where bytes end too early: who asks for them says what that means.
struct TdmsCutOff : std::runtime_error {
  TdmsCutOff() : std::runtime_error("cut off") {}
};

/// Bytes that are taken off one after the other.
class TdmsBytes {
 public:
  TdmsBytes(std::string_view bytes, bool is_big) : bytes_(bytes), is_big_(is_big) {}

  std::size_t left() const { return bytes_.size(); }

  /// @throws TdmsCutOff  where there are fewer bytes
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw TdmsCutOff();
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  template <class Number>
  Number number() {
    const std::string_view taken = take(sizeof(Number));
    std::array<char, sizeof(Number)> bytes{};
    std::copy(taken.begin(), taken.end(), bytes.begin());
    if (is_big_) std::reverse(bytes.begin(), bytes.end());
    Number value{};
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  std::string text() {
    const auto size = number<std::uint32_t>();
    return std::string(take(size));
  }

  /// Seconds since 1904, and the part of a second behind.
  std::pair<std::int64_t, double> time() {
    constexpr double parts = 18446744073709551616.0;  // of a second: 2^64
    std::uint64_t fraction = 0;
    std::int64_t seconds = 0;
    if (is_big_) seconds = number<std::int64_t>();
    fraction = number<std::uint64_t>();
    if (!is_big_) seconds = number<std::int64_t>();
    return {seconds, static_cast<double>(fraction) / parts};
  }

 private:
  std::string_view bytes_;
  bool is_big_;
};

/// Bytes of a value; 0: of no known or of no fixed size.
inline std::size_t tdms_size(std::uint32_t type) {
  switch (type) {
    case tdms_int8:
    case tdms_uint8:
    case tdms_boolean:
      return 1;
    case tdms_int16:
    case tdms_uint16:
      return 2;
    case tdms_int32:
    case tdms_uint32:
    case tdms_float:
    case tdms_float_with_unit:
      return 4;
    case tdms_int64:
    case tdms_uint64:
    case tdms_double:
    case tdms_double_with_unit:
    case tdms_complex_float:
      return 8;
    case tdms_time:
    case tdms_complex_double:
      return 16;
    default:
      return 0;
  }
}

/// Whether values of a type are real numbers.
inline bool is_tdms_number(std::uint32_t type) {
  return tdms_size(type) > 0 && type != tdms_time && type != tdms_complex_float &&
         type != tdms_complex_double;
}

/// A real number of a type.
inline double tdms_number(TdmsBytes& bytes, std::uint32_t type) {
  switch (type) {
    case tdms_int8:
      return bytes.number<std::int8_t>();
    case tdms_int16:
      return bytes.number<std::int16_t>();
    case tdms_int32:
      return bytes.number<std::int32_t>();
    case tdms_int64:
      return static_cast<double>(bytes.number<std::int64_t>());
    case tdms_uint16:
      return bytes.number<std::uint16_t>();
    case tdms_uint32:
      return bytes.number<std::uint32_t>();
    case tdms_uint64:
      return static_cast<double>(bytes.number<std::uint64_t>());
    case tdms_float:
    case tdms_float_with_unit:
      return bytes.number<float>();
    case tdms_double:
    case tdms_double_with_unit:
      return bytes.number<double>();
    default:
      return bytes.number<std::uint8_t>();
  }
}

}  // namespace whirl::inline io

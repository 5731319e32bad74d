#pragma once
/// Values as bytes, for another process of the same program, and back: every bit of a number
/// survives.
///
/// A function beside a struct says once for both directions which members travel. It names all
/// members, so that a new member does not compile before it is named there:
///
///   template <class Bytes>
///   void travel(Bytes& bytes, Is<Drift> auto& drift) {
///     auto& [change, rate, left, spread] = drift;
///     bytes(change, rate, left, spread);
///   }

#include <Eigen/Core>
#include <array>
#include <complex>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/failure.hpp"

namespace whirl::inline base {

/// T or const T, as a struct that is unpacked or packed.
template <class Given, class T>
concept Is = std::same_as<std::remove_const_t<Given>, T>;

/// Types whose values travel as the bytes that they have in memory.
template <class T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
constexpr bool is_plain<std::complex<T>> = true;

template <class T>
concept DenseMatrix = std::derived_from<T, Eigen::PlainObjectBase<T>>;

/// Writes values one after the other.
class Packed {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  /// Hands over all that was written.
  std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (is_plain<T>) {
      put_all(&value, 1);
    } else if constexpr (DenseMatrix<T>) {
      put(value.rows());
      put(value.cols());
      put_all(value.data(), static_cast<std::size_t>(value.size()));
    } else {
      travel(*this, value);
    }
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(values.size());
    if constexpr (is_plain<T>) {
      put_all(values.data(), values.size());
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <class T, std::size_t N>
  void put(const std::array<T, N>& values) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  void put(const std::string& text) {
    put(text.size());
    put_all(text.data(), text.size());
  }
  void put(const Failure& failure) { put(failure.text()); }

  template <class T>
  void put_all(const T* values, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }

  std::string bytes_;
};

/// Reads values again, in the order in which Packed wrote them.
class Unpacked {
 public:
  /// @param bytes  must outlive this object
  explicit Unpacked(std::string_view bytes) : left_(bytes) {}

  /// @throws NumericalError  if the bytes are fewer than the values ask for
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  bool is_at_end() const { return left_.empty(); }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (is_plain<T>) {
      get_all(&value, 1);
    } else if constexpr (DenseMatrix<T>) {
      const auto rows = get_size<Eigen::Index>(), columns = get_size<Eigen::Index>();
      const auto most = static_cast<Eigen::Index>(left_.size() / sizeof(typename T::Scalar));
      require(rows >= 0 && columns >= 0 && (rows == 0 || columns <= most / rows));
      value.resize(rows, columns);
      get_all(value.data(), static_cast<std::size_t>(value.size()));
    } else {
      travel(*this, value);
    }
  }
  template <class T>
  void get(std::vector<T>& values) {
    const auto count = get_size<std::size_t>();
    require(count <= left_.size());  // no value takes less than a byte
    if constexpr (is_plain<T>) require(count <= left_.size() / sizeof(T));
    values.assign(count, T{});
    if constexpr (is_plain<T>) {
      get_all(values.data(), count);
    } else {
      for (T& value : values) get(value);
    }
  }
  template <class T, std::size_t N>
  void get(std::array<T, N>& values) {
    for (T& value : values) get(value);
  }
  template <class T>
  void get(std::optional<T>& value) {
    if (get_size<bool>()) {
      get(value.emplace());
    } else {
      value.reset();
    }
  }
  void get(std::string& text) {
    const auto count = get_size<std::size_t>();
    require(count <= left_.size());
    text.resize(count);
    get_all(text.data(), count);
  }
  void get(Failure& failure) {
    std::string text;
    get(text);
    failure = Failure(std::move(text));
  }

  template <class T>
  T get_size() {
    T size{};
    get_all(&size, 1);
    return size;
  }
  template <class T>
  void get_all(T* values, std::size_t count) {
    const std::size_t size = count * sizeof(T);
    require(size <= left_.size());
    if (size > 0) std::memcpy(static_cast<void*>(values), left_.data(), size);
    left_.remove_prefix(size);
  }
  static void require(bool is_so) {
    if (!is_so) throw NumericalError("what came from another process is not what was sent");
  }

  std::string_view left_;
};

/// Values as bytes.
template <class... T>
std::string packed(const T&... values) {
  Packed bytes;
  bytes(values...);
  return bytes.take();
}

/// Values from bytes that hold nothing else.
/// @throws NumericalError  as Unpacked
template <class... T>
void unpack(std::string_view bytes, T&... values) {
  Unpacked from(bytes);
  from(values...);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Where> auto& where) {
  auto& [file, line, column, set] = where;
  bytes(file, line, column, set);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Problem> auto& problem) {
  auto& [where, key, message] = problem;
  bytes(where, key, message);
}

}  // namespace whirl::inline base

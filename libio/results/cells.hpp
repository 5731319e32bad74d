#pragma once
/// Values of results as files hold them: numbers or texts one after the other, with their shape.

#include <span>
#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline io::columns {

template <class T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::same_as<T, Complex>;
template <class T>
concept Text = std::convertible_to<T, std::string_view>;
/// Whether a text or list is empty; of other values: no.
template <class T>
bool is_empty(const T& value) {
  if constexpr (Text<T>) {
    return std::string_view(value).empty();
  } else if constexpr (requires { value.empty(); }) {
    return value.empty();
  } else {
    return false;
  }
}
/// A std::optional; nothing is null in JSON. In files it can be an attribute that may be missing.
template <class T>
concept Maybe = requires(T t) {
  t.has_value();
};
template <class T>
concept EigenArray = requires {
  typename T::Scalar;
  T::RowsAtCompileTime;
};

/// Numbers or texts as files hold them, the last index running fastest.
struct Cells {
  ObjectKind kind = ObjectKind::real;
  std::vector<Eigen::Index> shape{};
  std::vector<double> reals{};
  std::vector<int> integers{};
  std::vector<Complex> complexes{};
  std::vector<std::string> texts{};

  std::size_t size() const {
    return reals.size() + integers.size() + complexes.size() + texts.size();
  }
  bool is_empty() const {
    return reals.empty() && integers.empty() && complexes.empty() &&
           (texts.empty() || (shape.empty() && texts.front().empty()));
  }
};

/// What a file holds of a type: of its elements, if it has several.
template <class T>
constexpr ObjectKind kind_of() {
  if constexpr (std::is_enum_v<T> || Text<T>) {
    return ObjectKind::text;
  } else if constexpr (std::same_as<T, Complex>) {
    return ObjectKind::complex;
  } else if constexpr (std::is_integral_v<T>) {
    return ObjectKind::integer;
  } else if constexpr (std::is_floating_point_v<T>) {
    return ObjectKind::real;
  } else if constexpr (EigenArray<T>) {
    return kind_of<typename T::Scalar>();
  } else if constexpr (HasColumns<T>) {
    return ObjectKind::other;  // in JSON only
  } else {
    return kind_of<typename T::value_type>();
  }
}

/// How many dimensions a value has.
template <class T>
constexpr int rank_of() {
  if constexpr (Scalar<T> || Text<T> || HasColumns<T>) {
    return 0;
  } else if constexpr (EigenArray<T>) {
    return T::ColsAtCompileTime == 1 ? 1 : 2;
  } else if constexpr (Maybe<T>) {
    return rank_of<typename T::value_type>();
  } else {
    return 1 + rank_of<typename T::value_type>();
  }
}

/// Whether a file can hold values of a type; other values are for JSON only.
template <class T>
constexpr bool fits_files = !Maybe<T> && kind_of<T>() != ObjectKind::other;
/// Whether values of a type can be an attribute that may be missing.
template <class T>
constexpr bool fits_attributes = Maybe<T>&& rank_of<T>() == 0 && kind_of<T>() != ObjectKind::other;

template <class T>
std::vector<Eigen::Index> extents_of(const T& value) {
  if constexpr (rank_of<T>() == 0) {
    return {};
  } else if constexpr (EigenArray<T>) {
    if constexpr (rank_of<T>() == 1) return {value.size()};
    return {value.rows(), value.cols()};
  } else {
    return {static_cast<Eigen::Index>(std::ssize(value))};
  }
}

/// Appends a value, all its elements one after the other.
template <class T>
void put(Cells& cells, const T& value, int offset = 0) {
  if constexpr (std::is_enum_v<T>) {
    cells.texts.emplace_back(name_of(value));
  } else if constexpr (Text<T>) {
    cells.texts.emplace_back(value);
  } else if constexpr (std::same_as<T, Complex>) {
    cells.complexes.push_back(value);
  } else if constexpr (std::is_integral_v<T>) {
    cells.integers.push_back(static_cast<int>(value) + offset);
  } else if constexpr (std::is_floating_point_v<T>) {
    cells.reals.push_back(value);
  } else if constexpr (EigenArray<T>) {
    for (Eigen::Index i = 0; i < value.rows(); ++i) {
      for (Eigen::Index j = 0; j < value.cols(); ++j) put(cells, value(i, j), offset);
    }
  } else {
    for (const auto& element : value) put(cells, element, offset);
  }
}

/// Takes the values of cells one after the other.
class Taking {
 public:
  explicit Taking(const Cells& cells) : cells_(cells) {}

  /// @param shape  of the value; empty: one number or text
  template <class T>
  void take(T& value, std::span<const Eigen::Index> shape, int offset = 0) {
    if constexpr (std::is_enum_v<T>) {
      value = value_named<T>(cells_.texts.at(at_++)).value_or(value);
    } else if constexpr (Text<T>) {
      value = cells_.texts.at(at_++);
    } else if constexpr (std::same_as<T, Complex>) {
      value = cells_.complexes.at(at_++);
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = cells_.kind == ObjectKind::integer
                  ? static_cast<T>(cells_.integers.at(at_++) - offset)
                  : static_cast<T>(cells_.reals.at(at_++));
    } else if constexpr (EigenArray<T>) {
      value.resize(shape[0], shape.size() > 1 ? shape[1] : 1);
      for (Eigen::Index i = 0; i < value.rows(); ++i) {
        for (Eigen::Index j = 0; j < value.cols(); ++j) take(value(i, j), {}, offset);
      }
    } else {
      value.resize(static_cast<std::size_t>(shape[0]));
      for (auto& element : value) take(element, shape.subspan(1), offset);
    }
  }

 private:
  const Cells& cells_;
  std::size_t at_ = 0;
};

}  // namespace whirl::inline io::columns

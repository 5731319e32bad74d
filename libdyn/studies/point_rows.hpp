#pragma once
/// Rows of a study of many points, of which no more are in memory than fit.

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "libbase/processes/row_store.hpp"
#include "libbase/structs/travel.hpp"
#include "libdyn/studies/stripe.hpp"

namespace whirl::inline dyn {

/// Rows of a study, one per point; none where a point is not computed. Rows are kept as the bytes
/// of their `travel`, and made again where asked for: a row is a value, and references to its parts
/// end with it.
template <class Row>
class PointRows {
 public:
  using value_type = Row;

  explicit PointRows(std::size_t points = 0) : rows_(points) {}
  explicit PointRows(RowStore rows) : rows_(std::move(rows)) {}

  /// From now on, rows that are too many for the memory go into a file of this folder.
  void overflow_into(std::filesystem::path folder) { rows_.overflow_into(std::move(folder)); }

  std::size_t size() const { return rows_.size(); }
  void resize(std::size_t points) { rows_.resize(points); }
  bool has(std::size_t point) const { return rows_.has(point); }
  void set(std::size_t point, const Row& row) { rows_.set(point, packed(row)); }

  std::optional<Row> operator[](std::size_t point) const {
    if (!has(point)) return std::nullopt;
    std::string buffer;
    std::optional<Row> row(std::in_place);
    unpack(rows_.get(point, buffer), *row);
    return row;
  }
  /// The bytes of a row that is there, as `packed` makes them.
  std::string bytes(std::size_t point) const {
    std::string buffer;
    return std::string(rows_.get(point, buffer));
  }

  /// Goes from point to point.
  struct Iterator {
    const PointRows* rows;
    std::size_t point;
    std::optional<Row> operator*() const { return (*rows)[point]; }
    Iterator& operator++() {
      ++point;
      return *this;
    }
    bool operator==(const Iterator&) const = default;
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }

 private:
  RowStore rows_;
};

template <class Row>
std::size_t done_points(const PointRows<Row>& points) {
  std::size_t done = 0;
  for (std::size_t i = 0; i < points.size(); ++i) done += points.has(i) ? 1 : 0;
  return done;
}

/// How many points of a stripe are not done.
template <class Row>
std::size_t open_points(const PointRows<Row>& points, const Stripe& stripe) {
  std::size_t open = 0;
  for (std::size_t i = stripe.number - 1; i < points.size(); i += stripe.of) open += !points.has(i);
  return open;
}

}  // namespace whirl::inline dyn

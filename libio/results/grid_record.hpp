#pragma once

#include <functional>
#include <vector>

#include "libdyn/studies/parameter_grid.hpp"
#include "libio/results/columns.hpp"

namespace whirl::inline io {

/// Rows of the points of a grid as JSON: of every column an array as deep as the grid has axes.
template <HasColumns Row>
Record grid_record(const std::vector<Row>& rows, const ParameterGrid& grid) {
  Record record;
  for_each_column<Row>([&](const auto& c) {
    std::vector<Record> level;
    for (const Row& row : rows) {
      level.push_back(columns::record_value(std::invoke(c.member, row), 1.0));
    }
    for (std::size_t axis = grid.axes.size(); axis-- > 0;) {  // the last one runs fastest
      std::vector<Record> above;
      const auto size = static_cast<std::ptrdiff_t>(grid.axes[axis].size());
      for (auto at = level.begin(); at != level.end(); at += size) {
        above.emplace_back(Record::Array(at, at + size));
      }
      level = std::move(above);
    }
    record.set(columns::json_key(c), std::move(level.front()));
  });
  return record;
}

}  // namespace whirl::inline io

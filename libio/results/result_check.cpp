// Checks results against the table of result_schema.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <span>
#include <string>

#include "libio/results/result_schema.hpp"

namespace whirl::inline io {

namespace {

using Index = Eigen::Index;
using enum ObjectKind;

constexpr double largest = std::numeric_limits<double>::max();

/// Names of object and attribute: "/trajectory" and "period".
std::pair<std::string, std::string> attribute_of(std::string_view path) {
  const std::size_t at = path.find('@');
  return {std::string(path.substr(0, at)), std::string(path.substr(at + 1))};
}

/// Checks entry after entry of one file, and remembers the sizes of dimensions.
class ResultCheck {
 public:
  explicit ResultCheck(const ResultReader& file) : file_(file) {}

  bool has(std::string_view path) const {
    if (path.find('@') == std::string_view::npos) return file_.has(std::string(path));
    const auto [object, name] = attribute_of(path);
    return file_.has_attribute(object, name);
  }

  void check(const ResultSet& set) {
    const bool is_there = has(set.entries.front().path);
    for (const std::string& other : is_there ? set.needs : std::vector<std::string>{}) {
      if (!has(other)) fail(set.entries.front().path, fmt::format("{} is missing", other));
    }
    for (const ResultEntry& entry : set.entries) {
      const bool is_here = has(entry.path);
      if (is_here && !is_there) {
        fail(entry.path, fmt::format("{} is missing", set.entries.front().path));
      }
      if (!is_here && is_there && !entry.is_optional) fail(entry.path, "it is missing");
      if (!is_here) continue;
      entry.path.find('@') == std::string_view::npos ? check(entry) : check_attribute(entry);
    }
  }

  /// Full vectors begin with four numbers per node.
  void check_full_vectors() const {
    const auto full = sizes_.find("full"), nodes = sizes_.find("nodes");
    if (full == sizes_.end() || nodes == sizes_.end()) return;
    if (full->second.size < 4 * nodes->second.size) {
      fail(full->second.of,
           fmt::format("its vectors have {} numbers, expected 4 for each of {} nodes",
                       full->second.size, nodes->second.size));
    }
  }

 private:
  struct Size {
    Index size = 0;
    std::string of;  ///< the dataset that it was first seen at
  };

  [[noreturn]] void fail(std::string_view path, const std::string& why) const {
    throw FileError(fmt::format("{}: {} is damaged or of another program: {}",
                                file_.path().string(), path, why));
  }

  void check_attribute(const ResultEntry& entry) const {
    const auto [object, name] = attribute_of(entry.path);
    if (entry.kind == text) {
      file_.string_attribute(object, name);
    } else {
      const double value = file_.number_attribute(object, name);
      check_values(entry, {&value, 1});
    }
  }

  void check(const ResultEntry& entry) {
    const std::string path(entry.path);
    const ObjectKind found = file_.kind(path);
    const bool is_whole_real = entry.kind == real && found == integer;
    if (found != entry.kind && !is_whole_real) {
      fail(path, entry.kind == text      ? "expected texts"
                 : entry.kind == integer ? "expected whole numbers"
                 : entry.kind == complex ? "expected complex numbers"
                                         : "expected numbers");
    }
    const std::vector<Index> shape = file_.shape(path);
    check_shape(path, shape, wanted_of(entry));
    const ValidValues& v = entry.values;
    const bool is_free =
        v.has_gaps && std::isinf(v.least) && std::isinf(v.most) && v.counts.empty();
    if (is_free) return;
    file_.each_block(path, [&](std::span<const double> values) { check_values(entry, values); });
  }

  /// Dimensions of an entry, those of the study's points one by one.
  std::vector<DimensionName> wanted_of(const ResultEntry& entry) const {
    std::vector<DimensionName> wanted;
    for (const DimensionName& d : dimensions_of(entry.sizes)) {
      if (d.name != "point") {
        wanted.push_back(d);
        continue;
      }
      for (const std::string& axis : axes_of_points(entry.path)) wanted.push_back({axis});
    }
    return wanted;
  }

  /// Datasets along the points of a study, their paths being the names of these dimensions.
  std::vector<std::string> axes_of_points(std::string_view path) const {
    const std::string group(path.substr(0, path.find('/', 1)));
    std::vector<std::string> axes;
    for (const char* name : {"/direction", "/start", "/axis_1", "/axis_2", "/axis_3"}) {
      if (file_.has(group + name)) axes.push_back(group + name);
    }
    if (axes.empty()) fail(path, "its axes are missing");
    return axes;
  }

  void check_shape(const std::string& path, const std::vector<Index>& shape,
                   const std::vector<DimensionName>& wanted) {
    if (shape.size() != wanted.size()) {
      fail(path, fmt::format("it has {} dimensions, expected {}", shape.size(), wanted.size()));
    }
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const std::string& name = wanted[i].name;
      Index expected = 0;
      const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), expected);
      Size size{expected, "a result"};
      if (error != std::errc{}) {
        if (name.starts_with('/')) {
          size = {length_of(name), name};
        } else {
          size = sizes_.try_emplace(name, Size{shape[i], path}).first->second;
        }
      }
      if (shape[i] != size.size) {
        fail(path, fmt::format("dimension {} has {} elements, {} has {} of them", i + 1, shape[i],
                               size.of, size.size));
      }
      if (wanted[i].has_elements && shape[i] == 0) fail(path, "it is empty");
    }
  }

  /// Of a dataset of one dimension.
  Index length_of(const std::string& path) const {
    const std::vector<Index> shape = file_.shape(path);
    if (shape.size() == 1) return shape[0];
    fail(path, fmt::format("it has {} dimensions, expected 1", shape.size()));
  }

  Index count_of(const ResultEntry& entry) const {
    if (entry.values.counts == "point") {
      Index count = 1;
      for (const std::string& axis : axes_of_points(entry.path)) count *= length_of(axis);
      return count;
    }
    const auto known = sizes_.find(std::string(entry.values.counts));
    return known == sizes_.end() ? 0 : known->second.size;
  }

  void check_values(const ResultEntry& entry, std::span<const double> values) const {
    const ValidValues& v = entry.values;
    const double most = v.counts.empty() ? v.most : static_cast<double>(count_of(entry));
    for (const double x : values) {
      if (std::isnan(x) ? v.has_gaps : x >= v.least && x <= most) continue;
      std::string expected = "a finite number";
      if (std::isfinite(v.least) && v.least > -largest) {
        expected = most < largest  ? fmt::format("{:g} to {:g}", v.least, most)
                   : v.least > 0.0 ? "a number above 0"
                                   : "0 or more";
      }
      fail(entry.path, fmt::format("found {}, expected {}", x, expected));
    }
  }

  const ResultReader& file_;
  std::map<std::string, Size> sizes_;
};

}  // namespace

std::vector<DimensionName> dimensions_of(std::string_view sizes) {
  std::vector<DimensionName> all;
  for (std::size_t from = 0; from < sizes.size();) {
    const std::size_t to = std::min(sizes.find(' ', from), sizes.size());
    DimensionName d{std::string(sizes.substr(from, to - from))};
    d.has_elements = d.name.ends_with('+');
    if (d.has_elements) d.name.pop_back();
    all.push_back(std::move(d));
    from = to + 1;
  }
  return all;
}

void check_result(const ResultReader& file) {
  if (!file.has("/model")) {
    throw FileError(
        fmt::format("{} is no result of whirl: it holds no model", file.path().string()));
  }
  const double format =
      file.has_attribute("/", "format") ? file.number_attribute("/", "format") : 1;
  if (!(format <= result_format)) {
    throw FileError(
        fmt::format("{} has format {}, this whirl reads formats up to {}: take a newer one",
                    file.path().string(), format, result_format));
  }
  ResultCheck check(file);
  for (const ResultSet& set : result_schema()) check.check(set);
  check.check_full_vectors();
}

std::unique_ptr<ResultReader> open_result(const std::filesystem::path& path) {
  auto file = std::make_unique<ResultReader>(path);
  check_result(*file);
  return file;
}

}  // namespace whirl::inline io

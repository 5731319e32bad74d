#include "libio/result_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>

namespace whirl {

namespace {

using Index = Eigen::Index;
using enum ObjectKind;

constexpr double largest = std::numeric_limits<double>::max();
constexpr ValidValues any{};
constexpr ValidValues finite{-largest, largest, false};
constexpr ValidValues nonnegative{0.0, largest, false};
constexpr ValidValues positive{std::numeric_limits<double>::denorm_min(), largest, false};

constexpr ValidValues from_to(double least, double most) {
  return {least, most, false};
}
/// Numbers of the elements of a dimension, from 1.
constexpr ValidValues numbers_of(std::string_view dimension) {
  return {1.0, largest, false, dimension};
}

constexpr double most_samples = 1e9;      ///< of a revolution
constexpr double most_revolutions = 1e9;  ///< of a period
constexpr double most_order = 1e6;        ///< of a critical speed, of a resonance

/// Columns that every study of many points has; a point is -1 or NaN where it failed.
ResultSet classified(std::string_view group, std::vector<ResultEntry> more) {
  static std::vector<std::unique_ptr<std::string>> texts;  // paths outlive the views of them
  const auto path = [&](std::string_view name) -> std::string_view {
    return *texts.emplace_back(std::make_unique<std::string>(fmt::format("{}/{}", group, name)));
  };
  ResultSet set{{{path("motion"), integer, "point", from_to(-1.0, 4.0)},
                 {path("period"), integer, "point"},
                 {path("is_proven"), integer, "point", from_to(-1.0, 1.0)},
                 {path("transient"), integer, "point"},
                 {path("revolutions"), integer, "point"},
                 {path("resolution"), real, "point"},
                 {path("section_dimension"), real, "point"},
                 {path("exponent"), real, "point exponents+"},
                 {path("regime"), integer, "point contacts", from_to(-1.0, 2.0)},
                 {path("duty"), real, "point contacts"},
                 {path("impacts_per_rev"), real, "point contacts"},
                 {path("sticking"), real, "point contacts"},
                 {path("max_normal"), real, "point contacts"},
                 {path("max_tangential"), real, "point contacts"},
                 {path("contact"), text, "contacts", any, true},
                 {path("done"), integer, "point", from_to(0.0, 1.0), true}}};
  set.entries.insert(set.entries.end(), more.begin(), more.end());
  return set;
}

std::vector<ResultSet> make_schema() {
  return {
      {{{"/model", text, "1"}}},
      {{{"/arguments", text, "words+"}}},
      {{{"/points/z", real, "nodes+", finite}, {"/points/node_name", text, "nodes"}}},
      {{{"/points/body_name", text, "bodies+"}}},
      // motions
      {{{"/trajectory/end_displacement", real, "full"},
        {"/trajectory/end_velocity", real, "full"},
        {"/trajectory@end_phase", real, "", finite}}},
      {{{"/trajectory@samples_per_revolution", real, "", from_to(1.0, most_samples)},
        {"/trajectory@revolutions", real, "", nonnegative},
        {"/trajectory@period", real, "", nonnegative},
        {"/trajectory@steps", real, ""},
        {"/trajectory@evaluations", real, ""},
        {"/trajectory@events", real, ""}}},
      {{{"/trajectory/time", real, "samples+", finite},
        {"/trajectory/coordinates", real, "reduced samples"},
        {"/trajectory/basis", real, "full reduced"}},
       {"/trajectory/end_displacement", "/trajectory@samples_per_revolution"}},
      {{{"/trajectory/station", text, "stations+"},
        {"/trajectory/x", real, "stations samples"},
        {"/trajectory/y", real, "stations samples"}},
       {"/trajectory/time"}},
      {{{"/trajectory/normal_force", real, "contacts samples"},
        {"/trajectory/friction_force", real, "contacts samples"}},
       {"/trajectory/time", "/contacts/name"}},
      {{{"/contacts/name", text, "contacts+"},
        {"/contacts/regime", text, "contacts"},
        {"/contacts/duty", real, "contacts"},
        {"/contacts/impacts_per_rev", real, "contacts"},
        {"/contacts/max_normal", real, "contacts"},
        {"/contacts/max_tangential", real, "contacts"},
        {"/contacts/sticking", real, "contacts"},
        {"/contacts/mean_slip", real, "contacts"}}},
      {{{"/spectra/frequency", real, "lines+", finite},
        {"/spectra/amplitude", real, "stations lines"}},
       {"/trajectory/station"}},
      {{{"/classify/exponent", real, "exponents"},
        {"/classify@motion", text, ""},
        {"/classify@period_revolutions", real, ""}}},
      // linear
      {{{"/modes/number", integer, "modes", numbers_of("modes")},
        {"/modes/eigenvalue", complex, "modes"},
        {"/modes/frequency", real, "modes"},
        {"/modes/damping_ratio", real, "modes"},
        {"/modes/log_decrement", real, "modes"},
        {"/modes/kappa", real, "modes"},
        {"/modes/whirl", text, "modes"},
        {"/modes/shape", complex, "full modes"}}},
      {{{"/mac/frequency", real, "peaks+"},
        {"/mac/amplitude", real, "peaks"},
        {"/mac/mac", real, "peaks modes"}},
       {"/modes/number"}},
      {{{"/campbell/speed", real, "speeds+", finite},
        {"/campbell/branch", integer, "branches", numbers_of("branches")},
        {"/campbell/frequency", real, "branches speeds"},
        {"/campbell/log_decrement", real, "branches speeds"},
        {"/campbell/whirl", text, "branches"}}},
      {{{"/campbell/critical_speed", real, "crossings"},
        {"/campbell/critical_branch", integer, "crossings", numbers_of("branches")}},
       {"/campbell/speed"}},
      {{{"/resonances/speed", real, "resonances"},
        {"/resonances/p", integer, "resonances", from_to(1.0, most_order)},
        {"/resonances/q", integer, "resonances", from_to(1.0, most_order)},
        {"/resonances/fast", integer, "resonances", numbers_of("branches")},
        {"/resonances/slow", integer, "resonances", numbers_of("branches")},
        {"/resonances/frequency", real, "resonances"},
        {"/resonances/bouncing_speed", real, "resonances"},
        {"/resonances/bouncing_period", real, "resonances"},
        {"/resonances/bouncing_stable", integer, "resonances", from_to(-1.0, 1.0)}},
       {"/campbell/speed"}},
      {{{"/critical/speed", real, "speeds"},
        {"/critical/damped_speed", real, "speeds"},
        {"/critical/whirl", text, "speeds"},
        {"/critical@order", real, "", from_to(positive.least, most_order)}}},
      {{{"/unbalance/speed", real, "speeds+", finite},
        {"/unbalance/station", text, "stations+"},
        {"/unbalance/x", complex, "stations speeds"},
        {"/unbalance/y", complex, "stations speeds"},
        {"/unbalance/major", real, "stations speeds"},
        {"/unbalance/minor", real, "stations speeds"}}},
      {{{"/static/displacement", real, "full"}}},
      {{{"/static/bearing", text, "bearings+"}, {"/static/bearing_load", real, "bearings 2"}}},
      // periodic motions
      {{{"/orbit/multiplier", complex, "multipliers"},
        {"/orbit@period_revolutions", real, "", any, true}}},
      {{{"/orbit/order", real, "orders"}, {"/orbit/amplitude", complex, "full orders"}}},
      {{{"/orbit/displacement", real, "full starts"}, {"/orbit/velocity", real, "full starts"}}},
      {{{"/branch/number", integer, "branches", numbers_of("branches")},
        {"/branch/period", integer, "branches", from_to(0.0, most_revolutions)},
        {"/branch/parent", integer, "branches", from_to(0.0, largest)},
        {"/branch/end", text, "branches"},
        {"/branch/value", real, "points", finite},
        {"/branch/branch", integer, "points", numbers_of("branches")},
        {"/branch/stable", integer, "points", from_to(-1.0, 1.0)},
        {"/branch/revolutions", real, "points", nonnegative},
        {"/branch/work", real, "points"},
        {"/branch/residual", real, "points"},
        {"/branch/state", real, "points states+"},
        {"/branch/multiplier", complex, "points states+"},
        {"/branch/walk", real, "packed"}}},
      {{{"/branch/station", text, "stations+"}, {"/branch/max_radius", real, "points stations"}},
       {"/branch/number"}},
      {{{"/branch/poincare_x", real, "points stations sections"},
        {"/branch/poincare_y", real, "points stations sections"}},
       {"/branch/station"}},
      {{{"/branch/contact", text, "contacts+"},
        {"/branch/duty", real, "points contacts"},
        {"/branch/impacts_per_rev", real, "points contacts"},
        {"/branch/max_normal", real, "points contacts"},
        {"/branch/max_tangential", real, "points contacts"}},
       {"/branch/number"}},
      {{{"/branch/bifurcation", real, "bifurcations", finite},
        {"/branch/bifurcation_kind", text, "bifurcations"},
        {"/branch/bifurcation_branch", integer, "bifurcations", numbers_of("branches")},
        {"/branch/bifurcation_after", integer, "bifurcations", numbers_of("points")},
        {"/branch/bifurcation_contact", text, "bifurcations"},
        {"/branch/bifurcation_change", real, "bifurcations"},
        {"/branch/bifurcation_multiplier", complex, "bifurcations"}},
       {"/branch/number"}},
      {{{"/border/number", integer, "curves", numbers_of("curves")},
        {"/border/kind", text, "curves"},
        {"/border/contact", text, "curves"},
        {"/border/period", integer, "curves"},
        {"/border/end", text, "curves"},
        {"/border/first", real, "places+", finite},
        {"/border/second", real, "places", finite},
        {"/border/curve", integer, "places", numbers_of("curves")},
        {"/border/stable", integer, "places", from_to(0.0, 1.0)},
        {"/border/walk", real, "packed_borders"}}},
      {{{"/torus/angle", real, "angles"}, {"/torus/displacement", real, "angles full"}}},
      {{{"/torus/value", real, "circles+", finite},
        {"/torus/rotation", real, "circles", finite},
        {"/torus/largest_exponent", real, "circles"},
        {"/torus/tail", real, "circles"},
        {"/torus@period_revolutions", real, "", from_to(1.0, most_revolutions)}}},
      // studies of many points
      classified("/sweep", {{"/sweep/axis_1", real, "values+", finite},
                            {"/sweep/direction", text, "ways+"},
                            {"/sweep/station", text, "stations+"},
                            {"/sweep/poincare_x", real, "point stations sections"},
                            {"/sweep/poincare_y", real, "point stations sections"},
                            {"/sweep/end_displacement", real, "point full"},
                            {"/sweep/end_velocity", real, "point full"},
                            {"/sweep/max_radius", real, "point stations", any, true},
                            {"/sweep/contact_angle", real, "point contacts sectors", any, true}}),
      {{{"/sweep/spectrum", real, "point stations orders"},
        {"/sweep/order", real, "orders+", finite},
        {"/sweep/sector", real, "sectors"}},
       {"/sweep/motion"}},
      classified("/map", {{"/map/axis_1", real, "first+", finite},
                          {"/map/axis_2", real, "second+", finite},
                          {"/map/axis_3", real, "third+", finite, true}}),
      classified("/basins", {{"/basins/start_displacement", real, "point full"},
                             {"/basins/start_velocity", real, "point full"},
                             {"/basins/section", real, "point sections states"},
                             {"/basins/start", integer, "starts+", any, true},
                             {"/basins/axis_1", real, "first+", finite, true},
                             {"/basins/axis_2", real, "second+", finite, true},
                             {"/basins/axis_3", real, "third+", finite, true}}),
      {{{"/basins/attractor", integer, "point", {-1.0, largest, false, "point"}}},
       {"/basins/motion"}},
      {{{"/bench/method", text, "methods+"},
        {"/bench/tolerance", real, "tolerances+", positive},
        {"/bench/error", real, "methods tolerances"},
        {"/bench/time", real, "methods tolerances"},
        {"/bench/steps", real, "methods tolerances"},
        {"/bench/evaluations", real, "methods tolerances"},
        {"/bench@revolutions", real, "", any},
        {"/bench@reference_error", real, "", any}}},
  };
}

/// A dimension of an entry: its name and what it asks for.
struct DimensionName {
  std::string name;
  bool has_elements = false;  ///< at least one
};

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
    for (const std::string_view other : is_there ? set.needs : std::vector<std::string_view>{}) {
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
      check_values(entry, {file_.number_attribute(object, name)});
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
    if (!is_free) check_values(entry, file_.numbers(path));
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
          size = {file_.shape(name).at(0), name};
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

  Index count_of(const ResultEntry& entry) const {
    if (entry.values.counts == "point") {
      Index count = 1;
      for (const std::string& axis : axes_of_points(entry.path)) count *= file_.shape(axis).at(0);
      return count;
    }
    const auto known = sizes_.find(std::string(entry.values.counts));
    return known == sizes_.end() ? 0 : known->second.size;
  }

  void check_values(const ResultEntry& entry, const std::vector<double>& values) const {
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

const std::vector<ResultSet>& result_schema() {
  static const std::vector<ResultSet> schema = make_schema();
  return schema;
}

void check_result(const ResultReader& file) {
  ResultCheck check(file);
  for (const ResultSet& set : result_schema()) check.check(set);
  check.check_full_vectors();
}

std::unique_ptr<ResultReader> open_result(const std::filesystem::path& path) {
  auto file = std::make_unique<ResultReader>(path);
  if (!file->has("/model")) {
    throw FileError(fmt::format("{} is no result of whirl: it holds no model", path.string()));
  }
  check_result(*file);
  return file;
}

}  // namespace whirl

#include "libdyn/linear/model_at.hpp"

#include <algorithm>
#include <exception>
#include <optional>

#include "libbase/error.hpp"

namespace whirl::inline dyn {

namespace {

/// Places of the nodes shaft by shaft from left to right, 0 to 1 on the first shaft, 2 to 3 on the
/// second one, and so on.
std::vector<double> places_of(const Mesh& mesh) {
  std::vector<double> places;
  double first = 0.0;
  for (const std::vector<int>& line : mesh.lines()) {
    const auto z = [&](int node) { return mesh.z[static_cast<std::size_t>(node)]; };
    const double from = z(line.front()), length = z(line.back()) - from;
    for (const int node : line) places.push_back(first + (z(node) - from) / length);
    first += 2.0;
  }
  return places;
}

}  // namespace

double shape_limit(const std::vector<double>& values, const SolveShapes& solve, int count) {
  constexpr double headroom = 1.05;
  std::exception_ptr first;
  const auto limit_at = [&](double value) -> std::optional<double> {
    try {
      const std::vector<ShapedValue> found = solve(value);
      const auto last = std::min(found.size(), static_cast<std::size_t>(count));
      return last > 0 ? headroom * found[last - 1].value : 0.0;
    } catch (const NumericalError&) {
      if (!first) first = std::current_exception();
    } catch (const ModelError&) {
      if (!first) first = std::current_exception();
    }
    return {};
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto low = limit_at(values[i]);
    if (!low) continue;
    for (std::size_t k = values.size() - 1; k > i; --k) {
      if (const auto high = limit_at(values[k])) return std::max(*low, *high);
    }
    return *low;
  }
  std::rethrow_exception(first);
}

std::vector<ValueGap> gaps_of(const ShapeBranches& followed) {
  std::vector<ValueGap> gaps;
  for (const ShapeGap& gap : followed.gaps) gaps.push_back({gap.at, gap.reason});
  return gaps;
}

std::vector<ToldAt> told_places(const ShapeBranch& branch, const std::vector<double>& values) {
  std::vector<ToldAt> places;
  for (std::size_t i = 0; i < branch.at.size(); ++i) {
    const auto value = std::lower_bound(values.begin(), values.end(), branch.at[i]);
    if (value == values.end() || *value != branch.at[i]) continue;
    places.push_back({value - values.begin(), branch.found[i]});
  }
  return places;
}

bool is_among_lowest(const std::vector<ToldAt>& places, int count) {
  return std::any_of(places.begin(), places.end(),
                     [&](const ToldAt& at) { return at.found.number < count; });
}

ShapeSampler::ShapeSampler(const Assembler& first)
    : places_(places_of(first.mesh())), bodies_(first.dofs().bodies()) {
  const double length = first.structure().length();
  if (!places_.empty()) length_ = length / static_cast<double>(places_.size());
}

Sparse ShapeSampler::weight() const {
  const auto size = static_cast<Eigen::Index>(4 * (places_.size() + std::size_t(bodies_)));
  Sparse unit(size, size);
  unit.setIdentity();
  return unit;
}

CVec ShapeSampler::at_points(const Assembler& assembler, const DofMap& dofs,
                             const CVec& shape) const {
  const Mesh& mesh = assembler.mesh();
  const std::vector<double> places = places_of(mesh);
  if (dofs.bodies() != bodies_ || places.empty() != places_.empty()) {
    throw ModelError({}, "", "the value changes what the model is made of");
  }
  const CVec full = dofs.T * shape;
  CVec told = CVec::Zero(static_cast<Eigen::Index>(4 * (places_.size() + std::size_t(bodies_))));
  Eigen::Index row = 0;
  const auto tell = [&](const Point& point, double share) {
    for (int c = X; c <= THETA_Y; ++c) {
      const int k = dofs.full_index(point, c);
      if (k >= 0) told(row + c) += share * (c >= THETA_X ? length_ : 1.0) * full(k);
    }
  };
  for (const double place : places_) {
    const auto right = std::clamp<std::ptrdiff_t>(
        std::lower_bound(places.begin(), places.end(), place) - places.begin(), 1,
        std::ssize(places) - 1);
    const auto r = static_cast<std::size_t>(right);
    const double share = (place - places[r - 1]) / (places[r] - places[r - 1]);
    tell({Point::Kind::node, mesh.left_to_right[r - 1]}, 1.0 - share);
    tell({Point::Kind::node, mesh.left_to_right[r]}, share);
    row += 4;
  }
  for (int body = 0; body < bodies_; ++body, row += 4) tell({Point::Kind::body, body}, 1.0);
  return told;
}

}  // namespace whirl::inline dyn

#include "libdata/measured/stabilization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "libbase/numerics/statistics.hpp"

namespace whirl::inline data {

namespace {

using Group = std::vector<std::size_t>;

/// Joins the two nearest groups until all are farther apart than a limit.
///
/// Mean distances are kept up by sizes: d(a+b, c) = (|a| d(a, c) + |b| d(b, c)) / (|a| + |b|).
std::vector<Group> joined_groups(const std::vector<OrderPole>& poles, const Group& members,
                                 double limit) {
  const auto n = static_cast<Eigen::Index>(members.size());
  constexpr double far = std::numeric_limits<double>::infinity();
  Mat distance = Mat::Constant(n, n, far);
  std::vector<Group> groups;
  for (Eigen::Index a = 0; a < n; ++a) {
    groups.push_back({members[static_cast<std::size_t>(a)]});
    for (Eigen::Index b = 0; b < a; ++b) {
      distance(a, b) = distance(b, a) = pole_distance(poles[members[static_cast<std::size_t>(a)]],
                                                      poles[members[static_cast<std::size_t>(b)]]);
    }
  }
  const auto group = [&](Eigen::Index i) -> Group& { return groups[static_cast<std::size_t>(i)]; };
  // the nearest neighbor of each group is kept, so that a step looks at one column
  std::vector<Eigen::Index> nearest(groups.size());
  const auto find_nearest = [&](Eigen::Index i) {
    distance.col(i).minCoeff(&nearest[static_cast<std::size_t>(i)]);
  };
  for (Eigen::Index i = 0; i < n; ++i) find_nearest(i);
  for (;;) {
    Eigen::Index a = -1;
    double least = limit;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double d = distance(nearest[static_cast<std::size_t>(i)], i);
      if (d <= least) least = d, a = i;
    }
    if (a < 0) break;
    const Eigen::Index b = nearest[static_cast<std::size_t>(a)];
    const double size_a = static_cast<double>(group(a).size()),
                 size_b = static_cast<double>(group(b).size());
    const Vec mean = (size_a * distance.col(a) + size_b * distance.col(b)) / (size_a + size_b);
    distance.col(a) = mean;
    distance.row(a) = mean.transpose();
    distance(a, a) = far;
    distance.col(b).setConstant(far);
    distance.row(b).setConstant(far);
    group(a).insert(group(a).end(), group(b).begin(), group(b).end());
    group(b).clear();
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index near = nearest[static_cast<std::size_t>(i)];
      if (i == a || near == a || near == b) find_nearest(i);
    }
  }
  std::erase_if(groups, [](const Group& g) { return g.empty(); });
  return groups;
}

double median_frequency(const std::vector<OrderPole>& poles, const Group& group) {
  std::vector<double> values;
  for (const std::size_t i : group) values.push_back(poles[i].frequency());
  return median_of(std::move(values));
}

/// One pole of each order: the nearest to the median.
Group one_of_each_order(const std::vector<OrderPole>& poles, const Group& group) {
  const double middle = median_frequency(poles, group);
  const auto away = [&](std::size_t i) { return std::abs(poles[i].frequency() - middle); };
  std::map<int, std::size_t> of_order;
  for (const std::size_t i : group) {
    const auto [place, is_first] = of_order.emplace(poles[i].order, i);
    if (!is_first && away(i) < away(place->second)) place->second = i;
  }
  Group kept;
  for (const auto& entry : of_order) kept.push_back(entry.second);
  return kept;
}

}  // namespace

void find_stable(std::vector<std::vector<OrderPole>>& orders, const StabilityLimits& limits) {
  for (std::size_t i = 1; i < orders.size(); ++i) {
    const std::vector<OrderPole>& before = orders[i - 1];
    if (before.empty()) continue;
    for (OrderPole& p : orders[i]) {
      const auto like = std::min_element(before.begin(), before.end(), [&](auto& a, auto& b) {
        return pole_distance(p, a) < pole_distance(p, b);
      });
      const auto is_near = [](double now, double then, double limit) {
        return std::abs(now - then) <= limit * std::abs(then);
      };
      p.is_stable_frequency = is_near(p.frequency(), like->frequency(), limits.frequency);
      p.is_stable_damping = p.damping_ratio() > 0.0 && p.damping_ratio() <= limits.most_damping &&
                            is_near(p.damping_ratio(), like->damping_ratio(), limits.damping);
      p.is_stable_shape = channel_mac(p.shape, like->shape) >= limits.mac;
    }
  }
}

std::vector<std::vector<std::size_t>> clustered_modes(const std::vector<OrderPole>& poles,
                                                      const StabilityLimits& limits, int orders,
                                                      double share) {
  Group members;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (poles[i].is_stable() && poles[i].harmonic == 0) members.push_back(i);
  }
  std::vector<Group> modes;
  for (const Group& group : joined_groups(poles, members, limits.frequency + 1.0 - limits.mac)) {
    Group kept = one_of_each_order(poles, group);
    if (static_cast<double>(kept.size()) >= share * orders) modes.push_back(std::move(kept));
  }
  std::sort(modes.begin(), modes.end(), [&](const Group& a, const Group& b) {
    return median_frequency(poles, a) < median_frequency(poles, b);
  });
  return modes;
}

}  // namespace whirl::inline data

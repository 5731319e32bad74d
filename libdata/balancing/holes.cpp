#include "libdata/balancing/holes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"

namespace whirl::inline data {

namespace {

constexpr double nearly = 1e-12;         ///< of a weight: sums that are the same
constexpr std::size_t most_sums = 1000;  ///< of pieces in one hole

Complex direction(double angle) {
  return std::polar(1.0, angle);
}

Complex sum_of(const Vec& angles, const Vec& masses) {
  Complex sum = 0.0;
  for (Eigen::Index i = 0; i < angles.size(); ++i) sum += masses(i) * direction(angles(i));
  return sum;
}

/// Any masses with the least total: holes in an arc are full, those at its ends carry what is left,
/// as dual prices of the linear programme are those of a half-plane. Nothing: the holes cannot
/// carry the weight.
std::optional<Vec> least_masses(const BalancingHoles& holes, Complex weight) {
  const Eigen::Index count = holes.angles.size();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  const auto turned = [&](Eigen::Index i) {
    return std::fmod(std::fmod(holes.angles(i), turn) + turn, turn);
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return turned(a) < turned(b); });
  std::optional<Vec> best;
  const double small = nearly * std::abs(weight);
  for (Eigen::Index first = 0; first < count; ++first) {
    Vec masses = Vec::Zero(count);
    Complex rest = weight;
    for (Eigen::Index span = 1; span < count; ++span) {
      const Eigen::Index i = order[static_cast<std::size_t>(first)],
                         j = order[static_cast<std::size_t>((first + span) % count)];
      const Complex a = direction(holes.angles(i)), b = direction(holes.angles(j));
      const double across = std::imag(std::conj(a) * b);
      if (std::abs(across) > nearly) {
        const double of_a = std::imag(std::conj(rest) * b) / across,
                     of_b = std::imag(std::conj(a) * rest) / across;
        const auto fits = [&](double m) { return m >= -small && m <= holes.most + small; };
        if (fits(of_a) && fits(of_b)) {
          Vec found = masses;
          found(i) = std::clamp(of_a, 0.0, holes.most);
          found(j) = std::clamp(of_b, 0.0, holes.most);
          if (!best || found.sum() < best->sum() - small) best = found;
        }
      }
      if (!std::isfinite(holes.most)) break;  // the neighbor carries all
      masses(j) = holes.most;
      rest -= holes.most * b;
    }
  }
  return best;
}

/// Any masses whose sum is nearest to a weight that the holes cannot carry: on an edge of what they
/// can, holes on one side of a line are full, and one on the line carries a part.
Vec nearest_masses(const BalancingHoles& holes, Complex weight) {
  const Eigen::Index count = holes.angles.size();
  Vec best = Vec::Zero(count);
  double least = std::abs(weight);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (const double side : {-1.0, 1.0}) {
      Vec masses = Vec::Zero(count);
      const Complex normal = Complex(0.0, side) * direction(holes.angles(i));
      for (Eigen::Index j = 0; j < count; ++j) {
        const double along = std::real(std::conj(normal) * direction(holes.angles(j)));
        if (j != i && along > nearly) masses(j) = holes.most;
      }
      if (!masses.allFinite()) masses.setZero();
      const Complex rest = weight - sum_of(holes.angles, masses);
      masses(i) =
          std::clamp(std::real(std::conj(direction(holes.angles(i))) * rest), 0.0, holes.most);
      const double left = std::abs(weight - sum_of(holes.angles, masses));
      if (left < least) {
        least = left;
        best = masses;
      }
    }
  }
  return best;
}

/// What a hole can be filled with, ascending.
std::vector<double> sums_of_pieces(const BalancingHoles& holes) {
  std::set<double> sums{0.0}, last{0.0};
  for (int i = 0; i < holes.pieces_per_hole; ++i) {
    std::set<double> next;
    for (const double sum : last) {
      for (const double piece : holes.pieces) {
        if (sum + piece <= holes.most * (1.0 + nearly)) next.insert(sum + piece);
      }
    }
    sums.insert(next.begin(), next.end());
    last = std::move(next);
    if (sums.size() > most_sums) {
      throw OptionError(
          fmt::format("more than {} sums of pieces in one hole: expected fewer pieces", most_sums));
    }
  }
  return {sums.begin(), sums.end()};
}

double nearest_in(const std::vector<double>& sums, double value) {
  const auto above = std::lower_bound(sums.begin(), sums.end(), value);
  if (above == sums.end()) return sums.back();
  if (above == sums.begin()) return *above;
  return value - *(above - 1) <= *above - value ? *(above - 1) : *above;
}

/// Changes what is in three holes at a time, as long as the sum comes nearer to the weight: of the
/// third one what is nearest to the rest. In two holes at a time, where three would take long.
class Improver {
 public:
  Improver(const Vec& angles, const std::vector<double>& sums, Complex weight)
      : angles_(angles), sums_(sums), weight_(weight), count_(angles.size()) {
    constexpr double most_tries = 2e7;
    const auto n = static_cast<double>(count_), s = static_cast<double>(sums.size());
    has_third_ = n * n * n / 6.0 * s * s <= most_tries;
  }

  /// @param masses  of the holes, and two more that stay empty
  void improve(Vec& masses) {
    left_ = std::abs(weight_ - sum_of(angles_, masses.head(count_)));
    for (is_better_ = true; is_better_;) {
      is_better_ = false;
      for (Eigen::Index i = 0; i < count_; ++i) {
        for (Eigen::Index j = i + 1; j < count_ + 1; ++j) {
          for (Eigen::Index k = has_third_ ? j + 1 : count_ + 1; k < count_ + 2; ++k) {
            try_holes(i, j, k, masses);
          }
        }
      }
    }
  }

 private:
  Complex hole(Eigen::Index i) const { return i < count_ ? direction(angles_(i)) : Complex(0.0); }

  void try_holes(Eigen::Index i, Eigen::Index j, Eigen::Index k, Vec& masses) {
    Vec others = masses;
    others(i) = others(j) = others(k) = 0.0;
    const Complex rest = weight_ - sum_of(angles_, others.head(count_));
    const auto count = std::ssize(sums_);
    for (Eigen::Index a = 0; a < count; ++a) {
      const double first = sums_[static_cast<std::size_t>(a)];
      for (Eigen::Index b = 0; b < (j < count_ ? count : 1); ++b) {
        const double second = sums_[static_cast<std::size_t>(b)];
        const Complex more = rest - first * hole(i) - second * hole(j);
        const double third =
            k < count_ ? nearest_in(sums_, std::real(std::conj(hole(k)) * more)) : 0.0;
        const double now = std::abs(more - third * hole(k));
        if (!(now < left_ - nearly * std::abs(weight_))) continue;
        left_ = now;
        masses = others;
        masses(i) = first;
        masses(j) = second;
        masses(k) = third;
        is_better_ = true;
      }
    }
  }

  const Vec& angles_;
  const std::vector<double>& sums_;
  Complex weight_;
  Eigen::Index count_;
  bool has_third_ = true, is_better_ = true;
  double left_ = 0.0;
};

/// The fewest holes, up to three, whose pieces come near enough to a weight, on the side of the
/// weight. Of the ways with so many holes the one that is near and light.
class FewestHoles {
 public:
  FewestHoles(const Vec& angles, const std::vector<double>& sums, Complex weight, double enough)
      : angles_(angles), sums_(sums), weight_(weight), enough_(enough) {
    constexpr double most_tries = 2e7;
    for (Eigen::Index i = 0; i < angles.size(); ++i) {
      if (along(i) > nearly) near_.push_back(i);
    }
    std::ranges::stable_sort(near_, [&](auto i, auto j) { return along(i) > along(j); });
    const auto s = static_cast<double>(sums.size());
    const auto tries = [&](std::size_t n) {
      return std::pow(static_cast<double>(n), 3) / 6.0 * s * s;
    };
    while (near_.size() > 3 && tries(near_.size()) > most_tries) near_.pop_back();
  }

  /// Nothing: three holes are too few.
  std::optional<Vec> found() {
    if (std::abs(weight_) <= enough_) return Vec(Vec::Zero(angles_.size()));
    for (const std::size_t count : {1U, 2U, 3U}) {
      go_on({}, 0, count, weight_);
      if (best_) return best_;
    }
    return std::nullopt;
  }

 private:
  using Filled = std::vector<std::pair<Eigen::Index, double>>;

  double along(Eigen::Index i) const {
    return std::real(std::conj(weight_) * direction(angles_(i))) / std::abs(weight_);
  }
  void go_on(Filled filled, std::size_t from, std::size_t count, Complex rest) {
    for (std::size_t k = from; k < near_.size(); ++k) {
      const Complex hole = direction(angles_(near_[k]));
      filled.emplace_back(near_[k], 0.0);
      double& mass = filled.back().second;
      if (count == 1) {
        mass = nearest_in(sums_, std::real(std::conj(hole) * rest));
        look_at(filled, std::abs(rest - mass * hole));
      }
      for (std::size_t s = 1; s < sums_.size() && count > 1; ++s) {
        mass = sums_[s];
        go_on(filled, k + 1, count - 1, rest - mass * hole);
      }
      filled.pop_back();
    }
  }
  void look_at(const Filled& filled, double left) {
    if (left > enough_) return;
    double total = 0.0;
    for (const auto& [hole, mass] : filled) total += mass;
    const double score = left / enough_ + total / std::abs(weight_);
    if (best_ && score >= score_) return;
    score_ = score;
    best_ = Vec::Zero(angles_.size());
    for (const auto& [hole, mass] : filled) (*best_)(hole) = mass;
  }

  const Vec& angles_;
  const std::vector<double>& sums_;
  Complex weight_;
  double enough_, score_ = 0.0;
  std::vector<Eigen::Index> near_;
  std::optional<Vec> best_;
};

/// The holes that any masses fill, filled with pieces; few others make up for what is left.
/// Nothing: they cannot.
std::optional<Vec> few_holes(const BalancingHoles& holes, const std::vector<double>& sums,
                             const Vec& any, Complex weight) {
  const double enough = 0.5 * *std::ranges::min_element(holes.pieces);
  Vec masses = Vec::Zero(any.size());
  std::vector<Eigen::Index> open;
  for (Eigen::Index i = 0; i < any.size(); ++i) {
    const bool is_full = std::isfinite(holes.most) && any(i) >= holes.most * (1.0 - nearly);
    if (is_full) masses(i) = sums.back();
    if (!is_full) open.push_back(i);
  }
  const Vec angles = holes.angles(open);
  const auto more =
      FewestHoles(angles, sums, weight - sum_of(holes.angles, masses), enough).found();
  if (!more) return std::nullopt;
  masses(open) = *more;
  return masses;
}

}  // namespace

Vec split_over_holes(const BalancingHoles& given, Complex weight) {
  BalancingHoles holes = given;
  std::vector<double> sums;
  if (!holes.pieces.empty()) {
    sums = sums_of_pieces(holes);
    holes.most = std::min(holes.most, sums.back());
  }
  const auto exact = least_masses(holes, weight);
  const Vec any = exact ? *exact : nearest_masses(holes, weight);
  if (holes.pieces.empty()) return any;
  if (const auto few = few_holes(holes, sums, any, weight)) return *few;
  const Eigen::Index count = any.size();
  Improver improver(holes.angles, sums, weight);
  Vec rounded = Vec::Zero(count + 2), grown = Vec::Zero(count + 2);
  rounded.head(count) = any.unaryExpr([&](double m) { return nearest_in(sums, m); });
  improver.improve(rounded);
  improver.improve(grown);
  const auto left = [&](const Vec& m) {
    return std::abs(weight - sum_of(holes.angles, m.head(count)));
  };
  const double of_rounded = left(rounded), of_grown = left(grown);
  const bool is_same = std::abs(of_rounded - of_grown) <= nearly * std::abs(weight);
  const bool takes_rounded = is_same ? rounded.sum() <= grown.sum() : of_rounded < of_grown;
  return takes_rounded ? rounded.head(count) : grown.head(count);
}

}  // namespace whirl::inline data

#include "libfe/analyses/shape_branches.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/error.hpp"

namespace whirl::inline fe {

namespace {

constexpr double sure_match = 0.8;      ///< agreement from which a match needs no second look
constexpr double least = 0.1;           ///< agreement below which shapes have nothing in common
constexpr double nearness_share = 0.2;  ///< share of the distance of values in a match's score
constexpr double equal = 1e-9;          ///< relative distance of equal values
constexpr int most_halved_steps = 6;    ///< halvings of a step
constexpr int nobody = -1;

/// How far apart two solutions are.
double distance(const ShapedValue& a, const ShapedValue& b) {
  return std::max(std::abs(a.value - b.value), std::abs(a.eigenvalue - b.eigenvalue));
}

/// Solutions that are equal but for their shapes, with columns Q^H W Q = I.
struct Space {
  std::size_t first = 0;  ///< number of its first solution
  CMat Q;
};

std::vector<Space> spaces_of(const std::vector<ShapedValue>& found, const Sparse& W) {
  std::vector<Space> spaces;
  for (std::size_t i = 0; i < found.size();) {
    std::size_t end = i + 1;
    while (end < found.size() && distance(found[end], found[i]) <= equal * found[i].value) ++end;
    Space space{i, CMat(found[i].shape.size(), static_cast<Eigen::Index>(end - i))};
    for (std::size_t j = i; j < end; ++j) {
      CVec q = found[j].shape;
      const auto column = static_cast<Eigen::Index>(j - i);
      for (int pass = 0; pass < 2; ++pass) {  // the second one takes what rounding left
        for (Eigen::Index k = 0; k < column; ++k) {
          q -= space.Q.col(k) * space.Q.col(k).dot(CVec(W * q));
        }
      }
      space.Q.col(column) = q / std::sqrt(q.dot(CVec(W * q)).real());
    }
    spaces.push_back(std::move(space));
    i = end;
  }
  return spaces;
}

/// Who goes on as whom.
struct Match {
  std::vector<int> branch_of;  ///< of every solution that was found; nobody: it begins
  bool is_sure = true;
};

class Follower {
 public:
  Follower(const SolveShapes& solve, const Sparse& W, double limit)
      : solve_(solve), W_(W), limit_(limit) {}

  void begin_or_advance(double at) {
    asked_ = at;
    auto found = solved(at);
    if (!found) return;
    if (!has_begun_) {
      const Match all_begin{std::vector<int>(found->size(), nobody)};
      accept(at, std::move(*found), all_begin);
      has_begun_ = true;
    } else {
      advance(at, std::move(*found), 0);
    }
  }
  ShapeBranches take() { return std::move(result_); }

 private:
  std::optional<std::vector<ShapedValue>> solved(double at) {
    std::string reason;
    try {
      return solve_(at);
    } catch (const NumericalError& error) {
      reason = error.what();
    } catch (const ModelError& error) {
      reason = error.what();
    }
    // nobody asked for those between
    if (at == asked_) result_.gaps.push_back({at, std::move(reason)});
    return {};
  }

  void advance(double at, std::vector<ShapedValue> found, int depth) {
    const Match match = best_match(found);
    if (!match.is_sure && depth < most_halved_steps) {
      const double middle = 0.5 * (at_ + at);
      if (auto between = solved(middle)) {
        advance(middle, std::move(*between), depth + 1);
        advance(at, std::move(found), depth + 1);
        return;
      }
    }
    accept(at, std::move(found), match);
  }

  Match best_match(std::vector<ShapedValue>& found) const {
    struct Candidate {
      double score, agreement;
      std::size_t alive, candidate;
    };
    std::vector<Candidate> pairs;
    const std::vector<Space> spaces = spaces_of(found, W_);
    for (std::size_t a = 0; a < alive_.size(); ++a) {
      const ShapedValue& from = last(a);
      for (const Space& space : spaces) {
        const double agreement = share_within(from.shape, space.Q, W_);
        const double away = distance(found[space.first], from) / from.value;
        for (Eigen::Index k = 0; k < space.Q.cols(); ++k) {
          pairs.push_back({agreement - nearness_share * std::min(away, 1.0), agreement, a,
                           space.first + static_cast<std::size_t>(k)});
        }
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    Match match{std::vector<int>(found.size(), nobody), true};
    std::vector<bool> has_successor(alive_.size(), false);
    for (const Candidate& p : pairs) {
      if (has_successor[p.alive] || match.branch_of[p.candidate] != nobody || p.agreement < least) {
        continue;
      }
      has_successor[p.alive] = true;
      match.branch_of[p.candidate] = alive_[p.alive];
      if (p.agreement < sure_match && last(p.alive).value < limit_) match.is_sure = false;
    }
    for (std::size_t a = 0; a < alive_.size(); ++a) {
      if (!has_successor[a] && last(a).value < limit_) match.is_sure = false;
    }
    for (const Space& space : spaces) turn(space, match, found);
    return match;
  }

  /// Turns equal solutions so that each is most like the branch that it goes on: Q U V^H with
  /// Q^H W A = U S V^H, A the shapes of the branches.
  void turn(const Space& space, const Match& match, std::vector<ShapedValue>& found) const {
    const Eigen::Index n = space.Q.cols();
    if (n < 2) return;
    std::vector<std::size_t> taken, free;
    for (std::size_t i = space.first; i < space.first + static_cast<std::size_t>(n); ++i) {
      (match.branch_of[i] == nobody ? free : taken).push_back(i);
    }
    if (taken.empty()) return;
    CMat A(space.Q.rows(), static_cast<Eigen::Index>(taken.size()));
    for (std::size_t j = 0; j < taken.size(); ++j) {
      const auto number = static_cast<std::size_t>(match.branch_of[taken[j]]);
      const CVec& shape = result_.branches[number].found.back().shape;
      A.col(static_cast<Eigen::Index>(j)) = shape / std::sqrt(shape.dot(CVec(W_ * shape)).real());
    }
    const CMat overlap = space.Q.adjoint() * CMat(W_ * A);
    const Eigen::JacobiSVD<CMat> svd(overlap, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const CMat turned = space.Q * svd.matrixU().leftCols(A.cols()) * svd.matrixV().adjoint();
    const CMat rest = space.Q * svd.matrixU().rightCols(n - A.cols());
    for (std::size_t j = 0; j < taken.size(); ++j) {
      found[taken[j]].shape = turned.col(static_cast<Eigen::Index>(j));
    }
    for (std::size_t j = 0; j < free.size(); ++j) {
      found[free[j]].shape = rest.col(static_cast<Eigen::Index>(j));
    }
  }

  void accept(double at, std::vector<ShapedValue> found, const Match& match) {
    alive_.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
      int number = match.branch_of[i];
      if (number == nobody) {
        number = static_cast<int>(result_.branches.size());
        result_.branches.emplace_back();
      }
      ShapeBranch& branch = result_.branches[static_cast<std::size_t>(number)];
      branch.at.push_back(at);
      branch.found.push_back(std::move(found[i]));
      alive_.push_back(number);
    }
    at_ = at;
  }

  const ShapedValue& last(std::size_t alive) const {
    return result_.branches[static_cast<std::size_t>(alive_[alive])].found.back();
  }

  const SolveShapes& solve_;
  const Sparse& W_;
  double limit_;
  bool has_begun_ = false;
  double at_ = 0.0;
  double asked_ = 0.0;      ///< where branches are to be told
  std::vector<int> alive_;  ///< branches that reach the last value
  ShapeBranches result_;
};

}  // namespace

ShapeBranches follow_shapes(const std::vector<double>& at, const SolveShapes& solve,
                            const Sparse& W, double limit) {
  Follower follower(solve, W, limit);
  for (const double value : at) follower.begin_or_advance(value);
  return follower.take();
}

double share_within(const CVec& shape, const CMat& Q, const Sparse& W) {
  const CVec Wa = W * shape;
  const double size = shape.dot(Wa).real();
  return size > 0.0 ? (Q.adjoint() * Wa).squaredNorm() / size : 0.0;
}

}  // namespace whirl::inline fe

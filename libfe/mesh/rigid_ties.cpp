#include "libfe/mesh/rigid_ties.hpp"

#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace whirl::inline fe {

namespace {

/// Groups of dofs that rigid connections hold together; group 0 is the ground.
class Ties {
 public:
  explicit Ties(int dofs) : parent_(static_cast<std::size_t>(dofs) + 1) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  /// Ties two indices of the full vector (-1: ground); false if they were tied already.
  bool tie(int a, int b) {
    int from = root(a + 1), to = root(b + 1);
    if (from == to) return false;
    if (from == 0) std::swap(from, to);
    parent_[from] = to;
    return true;
  }
  /// full = T q with one coordinate per group that is not the ground.
  Sparse transformation() {
    const int n = static_cast<int>(parent_.size()) - 1;
    std::vector<int> coordinate(parent_.size(), -1);
    std::vector<Triplet> entries;
    int count = 0;
    for (int i = 0; i < n; ++i) {
      const int group = root(i + 1);
      if (group == 0) continue;
      if (coordinate[group] < 0) coordinate[group] = count++;
      entries.emplace_back(i, coordinate[group], 1.0);
    }
    Sparse T(n, count);
    T.setFromTriplets(entries.begin(), entries.end());
    return T;
  }

 private:
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<int> parent_;
};

/// Ties the ends of a connection if it is rigid.
/// @return  what is wrong with it; empty: nothing
std::string tie_ends(const Connection& c, const Point& from, const Point& to, const DofMap& dofs,
                     Ties& ties) {
  if (from == to) return "both ends are at the same place";
  if (!c.is_rigid && !c.is_clamped) return "";
  for (int k = 0; k < (c.is_clamped ? 4 : 2); ++k) {
    const int a = dofs.full_index(from, k), b = dofs.full_index(to, k);
    const bool lacks =
        (a < 0 && from.kind != Point::Kind::ground) || (b < 0 && to.kind != Point::Kind::ground);
    if (lacks) return "cannot clamp to a body without tilts; give it tilts = true";
    if (!ties.tie(a, b)) {
      return "its ends are held together already by another rigid bearing or link";
    }
  }
  return "";
}

}  // namespace

Sparse freedoms_left(const Structure& structure, const Mesh& mesh, const DofMap& dofs) {
  std::vector<Problem> problems;
  Ties ties(dofs.full_size);
  for (const auto& [kind, list] : structure.connections()) {
    for (const Connection& c : list) {
      const Point from = resolve(c.from, structure, mesh), to = resolve(c.to, structure, mesh);
      const std::string wrong = tie_ends(c, from, to, dofs, ties);
      if (!wrong.empty()) problems.push_back({c.where, c.name, wrong});
    }
  }
  if (!problems.empty()) throw ModelError(problems);
  Sparse T = ties.transformation();
  if (dofs.full_size > 0 && T.cols() == 0) {
    throw ModelError({}, "", "nothing can move: rigid bearings and links hold every point");
  }
  return T;
}

}  // namespace whirl::inline fe

#pragma once
/// From matrices of elements to sparse ones.

#include <utility>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libfe/eigen/equations_of_motion.hpp"
#include "libfe/mesh/elements/element.hpp"

namespace whirl::inline fe {

/// Collects element matrices at given indices of the full vector; index -1 is the ground.
class Collector {
 public:
  /// @param ratios  of the speeds of the shafts to that of the first one
  explicit Collector(std::vector<double> ratios = {1.0})
      : ratios_(std::move(ratios)), G_(ratios_.size()), H_(ratios_.size()) {}

  /// @param shaft  with which the element spins
  template <int N>
  void add(const ElementMatrices<N>& e, const std::vector<int>& index, std::size_t shaft = 0) {
    add(e.M, index, M_);
    add(e.C, index, C_);
    add(e.G, index, G_[shaft]);
    add(e.K, index, K_);
    add(e.H, index, H_[shaft]);
  }
  Sparse M(int n) const { return matrix(M_, n); }
  Sparse C(int n) const { return matrix(C_, n); }
  Sparse K(int n) const { return matrix(K_, n); }
  std::vector<SpinPart<Sparse>> spins(int n) const {
    std::vector<SpinPart<Sparse>> parts;
    for (std::size_t i = 0; i < ratios_.size(); ++i) {
      parts.push_back({ratios_[i], matrix(G_[i], n), matrix(H_[i], n)});
    }
    return parts;
  }

 private:
  template <class Block>
  static void add(const Block& block, const std::vector<int>& index, std::vector<Triplet>& to) {
    for (std::size_t j = 0; j < index.size(); ++j) {
      for (std::size_t i = 0; i < index.size(); ++i) {
        const double value = block(static_cast<int>(i), static_cast<int>(j));
        if (index[i] >= 0 && index[j] >= 0 && value != 0.0) {
          to.emplace_back(index[i], index[j], value);
        }
      }
    }
  }
  static Sparse matrix(const std::vector<Triplet>& triplets, int n) {
    Sparse A(n, n);
    A.setFromTriplets(triplets.begin(), triplets.end());
    return A;
  }
  std::vector<double> ratios_;
  std::vector<Triplet> M_, C_, K_;
  std::vector<std::vector<Triplet>> G_, H_;  // of each shaft
};

}  // namespace whirl::inline fe

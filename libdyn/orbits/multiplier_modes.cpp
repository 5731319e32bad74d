#include "libdyn/orbits/multiplier_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/numerics/dense.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline dyn {

namespace {

/// Reduced states of the modes, their displacements times Omega.
std::vector<CVec> states_of_modes(const Scene& scene) {
  const StateLayout layout = scene.contacts.layout();
  const CMat coordinates = NearestCoordinates(scene).matrix().cast<Complex>();
  std::vector<CVec> states;
  for (const Mode& m : complex_modes(scene.system, layout.coordinates()).oscillatory) {
    const CVec eta = coordinates * m.shape;
    CVec z(layout.size());
    layout.eta(z) = scene.contacts.Omega() * eta;
    layout.rate(z) = m.lambda * eta;
    states.push_back(std::move(z));
  }
  return states;
}

}  // namespace

std::vector<MultiplierMode> modes_of_multipliers(const Scene& scene, const PeriodicOrbit& orbit) {
  const Eigen::Index size = orbit.multipliers.size();
  const StateLayout layout = scene.contacts.layout();
  std::vector<MultiplierMode> found(static_cast<std::size_t>(size));
  if (orbit.tangents.empty()) return found;
  Mat A = Mat::Identity(size, size);
  for (const Mat& segment : orbit.tangents) A = segment * A;
  const auto directions = general_modes(A);
  if (!directions) return found;
  const Vec scale = scene.contacts.state_scale();
  const std::vector<CVec> states = states_of_modes(scene);
  const Mat& M = scene.reduced.M;
  const auto product = [&](const CVec& a, const CVec& b) {
    return layout.eta(a).dot(M * layout.eta(b)) + layout.rate(a).dot(M * layout.rate(b));
  };
  std::vector<bool> is_taken(static_cast<std::size_t>(size), false);
  for (Eigen::Index i = 0; i < size; ++i) {
    Eigen::Index best = -1;  // eigenvalues of the product, each for one multiplier
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < size; ++k) {
      const double distance = std::abs(directions->values(k) - orbit.multipliers(i));
      if (!is_taken[static_cast<std::size_t>(k)] && distance < nearest) {
        best = k;
        nearest = distance;
      }
    }
    if (best < 0) continue;
    is_taken[static_cast<std::size_t>(best)] = true;
    CVec v = scale.cast<Complex>().cwiseProduct(directions->vectors.col(best));
    layout.eta(v) *= scene.contacts.Omega();
    MultiplierMode& mode = found[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < states.size(); ++k) {
      for (const CVec& z : {states[k], CVec(states[k].conjugate())}) {
        const double mac = std::norm(product(v, z)) / (product(v, v).real() * product(z, z).real());
        if (mac > mode.mac) mode = {static_cast<int>(k) + 1, mac};
      }
    }
  }
  return found;
}

}  // namespace whirl::inline dyn

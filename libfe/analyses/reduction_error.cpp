#include "libfe/analyses/reduction_error.hpp"

#include "libbase/numerics/dense.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "libfe/eigen/quadratic.hpp"

namespace whirl::inline fe {

namespace {

constexpr int band_samples = 25;  ///< frequencies at which receptances are compared
constexpr int fewest_modes = 4,
              enough_modes = 120;  ///< that are looked for, to get beyond the band

}  // namespace

WholeSystem::WholeSystem(const System& system, const std::vector<Vec>& ports, double band)
    : band_(band), ports_(system.size(), std::ssize(ports)) {
  int wanted = fewest_modes;
  Modes modes = complex_modes(system, wanted);
  const auto ends_within = [&] {
    return static_cast<int>(modes.oscillatory.size()) == wanted &&
           modes.oscillatory.back().frequency() <= band;
  };
  while (wanted < enough_modes && ends_within()) modes = complex_modes(system, wanted *= 2);
  has_rigid_modes_ = !modes.rigid_body.empty();
  for (const Mode& mode : modes.oscillatory) {
    if (mode.frequency() > band) break;
    eigenvalues_.push_back(mode.lambda);
  }
  if (ports.empty()) return;
  for (Eigen::Index j = 0; j < ports_.cols(); ++j) {
    ports_.col(j) = ports[static_cast<std::size_t>(j)].cast<Complex>();
  }
  DynamicStiffness stiffness(system);
  for (int s = 0; s < band_samples; ++s) {
    const double w = band * (s + 0.5) / band_samples;
    if (!stiffness.factorize(Complex(0.0, w), system.Omega)) continue;
    CMat q(system.size(), ports_.cols());
    for (Eigen::Index j = 0; j < q.cols(); ++j) q.col(j) = stiffness.solve(ports_.col(j));
    if (q.allFinite()) receptances_.push_back({w, ports_.transpose() * q});
  }
}

ReductionError WholeSystem::error_of(const ReducedSystem& reduced) const {
  ReductionError error{.band = band_};
  const Mat D = reduced.D(), K = reduced.stiffness();
  const QuadraticModes modes =
      dense_quadratic_modes(reduced.M.sparseView(), D.sparseView(), K.sparseView(),
                            has_rigid_modes_ ? -0.1 * std::max(1.0, band_) : 0.0);
  for (const Complex whole : eigenvalues_) {
    ReductionError::Pair pair{whole, 0.0};
    for (const Complex lambda : modes.lambda) {
      if (std::abs(lambda - whole) < std::abs(pair.reduced - whole)) pair.reduced = lambda;
    }
    error.pairs.push_back(pair);
  }
  if (receptances_.empty()) return error;
  // at an antiresonance the static receptance is the measure, not the vanishing one
  const double static_size = receptances_.front().matrix.norm();
  const CMat rows = reduced.Phi.transpose().cast<Complex>() * ports_;
  for (const auto& [w, exact] : receptances_) {
    const CMat Z = (K - w * w * reduced.M).cast<Complex>() + Complex(0.0, w) * D.cast<Complex>();
    const CMat approximate = rows.transpose() * DenseLu<CMat>(Z).solve(rows);
    error.receptance =
        std::max(error.receptance, (approximate - exact).norm() / (exact.norm() + static_size));
  }
  return error;
}

}  // namespace whirl::inline fe

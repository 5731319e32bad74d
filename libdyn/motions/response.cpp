#include "libdyn/motions/response.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline dyn {

ResponseSpectra::ResponseSpectra(const Scene& scene, const Recording& recording)
    : map_(scene.displacement_map()), dofs_(scene.reduced.dofs) {
  // whole revolutions: harmonics of the spin fall on bins; small factors: it is fast
  revolutions_ = smooth_length(recording.revolutions);
  const auto n = revolutions_ * recording.samples;
  const auto coordinates = recording.eta.rows();
  eta_.resize(coordinates, n);
  mean_.resize(coordinates);
  const double spacing = recording.spacing();
  for (Eigen::Index i = 0; i < coordinates; ++i) {
    const Vec samples = recording.eta.row(i).tail(n).transpose();
    mean_(i) = samples.mean();
    const Spectrum s =
        hann_spectrum((samples.array() - mean_(i)).matrix().cast<Complex>(), spacing);
    eta_.row(i) = s.lines.transpose();
    bin_ = s.bin;
  }
}

Eigen::RowVectorXcd ResponseSpectra::row(const Point& point) const {
  return map_.row(dofs_.full_index(point, X)).cast<Complex>() +
         Complex(0, 1) * map_.row(dofs_.full_index(point, Y)).cast<Complex>();
}

Spectrum ResponseSpectra::at(const Point& point) const {
  return {bin_, (row(point) * eta_).transpose()};
}

Spectrum ResponseSpectra::of(const Eigen::RowVectorXd& row) const {
  return {bin_, (row.cast<Complex>() * eta_).transpose()};
}

Complex ResponseSpectra::line(const Point& point, Eigen::Index bin) const {
  return (row(point) * eta_.col((bin % size() + size()) % size()))(0);
}

Complex ResponseSpectra::mean(const Point& point) const {
  return {map_.row(dofs_.full_index(point, X)).dot(mean_),
          map_.row(dofs_.full_index(point, Y)).dot(mean_)};
}

Vec ResponseSpectra::total() const {
  Vec sum = Vec::Zero(size());
  for (const Point& p : dofs_.points()) sum += at(p).lines.cwiseAbs2();
  return sum.cwiseSqrt();
}

CVec ResponseSpectra::amplitudes(Eigen::Index bin) const {
  return 2.0 * eta_.col(std::abs(bin) % size());
}

PointPeaks point_peaks(const ResponseSpectra& spectra, const Point& point, double Omega,
                       double share, int most) {
  PointPeaks result;
  result.stationary = find_peaks(spectra.at(point).lines.cwiseAbs(), spectra.bin(), share, most);
  result.rotating = result.stationary;
  const double rest = std::abs(spectra.mean(point));
  const double largest = result.stationary.empty() ? 0.0 : result.stationary.front().amplitude;
  if (rest > share * largest && rest > 0.0) result.rotating.push_back({0.0, rest, 0});
  for (Peak& p : result.rotating) p.frequency -= Omega;
  std::erase_if(result.rotating,
                [&](const Peak& p) { return std::abs(p.frequency) < 0.5 * spectra.bin(); });
  std::stable_sort(result.rotating.begin(), result.rotating.end(),
                   [](const Peak& a, const Peak& b) { return a.amplitude > b.amplitude; });
  return result;
}

}  // namespace whirl::inline dyn

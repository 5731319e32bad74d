#include "libdata/measured/measured_spectra.hpp"

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/spectrum.hpp"

namespace whirl::inline data {

namespace {

constexpr double even_drift = 0.02;  ///< of a spectral line, that uneven revolutions may make

/// How many samples at the end of a record are transformed.
Eigen::Index transformed_samples(const ProbeReadings& readings, double Omega) {
  const Eigen::Index all = readings.displacement.rows();
  const double per_turn = turn * readings.rate / Omega;
  const double whole = std::round(per_turn);
  const double turns = static_cast<double>(all) / whole;
  if (Omega > 0.0 && turns >= 1.0 && std::abs(per_turn / whole - 1.0) * turns < even_drift) {
    return whole_revolutions(all, static_cast<long>(whole));
  }
  return smooth_length(all);
}

}  // namespace

MeasuredSpectra spectra_of(const ProbeReadings& readings,
                           const std::vector<ProbedStation>& stations, double Omega) {
  const Eigen::Index n = transformed_samples(readings, Omega);
  MeasuredSpectra spectra;
  spectra.probes.resize(n, readings.displacement.cols());
  for (Eigen::Index i = 0; i < readings.displacement.cols(); ++i) {
    const Vec samples = readings.displacement.col(i).tail(n);
    const Spectrum s = hann_spectrum((samples.array() - samples.mean()).matrix().cast<Complex>(),
                                     1.0 / readings.rate);
    spectra.probes.col(i) = s.lines;
    spectra.bin = s.bin;
  }
  spectra.stations.setZero(n, std::ssize(stations));
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const Mat& to_plane = stations[s].to_plane;
    for (std::size_t i = 0; i < stations[s].probes.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      spectra.stations.col(static_cast<Eigen::Index>(s)) +=
          Complex(to_plane(0, c), to_plane(1, c)) * spectra.probes.col(stations[s].probes[i]);
    }
  }
  return spectra;
}

}  // namespace whirl::inline data

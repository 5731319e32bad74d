#pragma once
/// Steady motion in frequencies: signed spectra at points, and peaks in both frames.

#include "libbase/numerics/spectrum.hpp"
#include "libdyn/motions/simulate.hpp"

namespace whirl::inline dyn {

/// Spectra of all reduced coordinates of a recording; spectra of points follow by summation.
class ResponseSpectra {
 public:
  /// Uses the last revolutions; their number is the largest that has small prime factors only.
  ResponseSpectra(const Scene& scene, const Recording& recording);

  double bin() const { return bin_; }  ///< [rad/s]
  Eigen::Index size() const { return eta_.cols(); }
  long revolutions() const { return revolutions_; }

  /// Signed spectrum of x + i y at a point; the mean is left out (see mean()).
  Spectrum at(const Point& point) const;
  /// Signed spectrum of a reading; the mean is left out.
  /// @param row  of the reading in the reduced coordinates, see probe_rows()
  Spectrum of(const Eigen::RowVectorXd& row) const;
  /// Mean of x + i y at a point [m].
  Complex mean(const Point& point) const;

  /// One line of the spectrum at a point.
  Complex line(const Point& point, Eigen::Index bin) const;

  /// Magnitude over all points together, sqrt(sum |Z_p|^2), per bin.
  Vec total() const;

  /// Complex amplitudes a of the reduced coordinates at a bin, eta(t) = Re(a e^(i |w| t)).
  CVec amplitudes(Eigen::Index bin) const;

 private:
  Eigen::RowVectorXcd row(const Point& point) const;

  Mat map_;  // full displacements of the coordinates
  DofMap dofs_;
  CMat eta_;  // coordinates x bins, two-sided
  Vec mean_;
  double bin_ = 0.0;
  long revolutions_ = 0;
};

/// Peaks of one point, stationary and seen from the rotor.
struct PointPeaks {
  std::vector<Peak> stationary;  ///< without the mean position
  std::vector<Peak> rotating;    ///< frequencies less Omega, without what rests in that frame
};

/// @param share  of the largest line, below which no line counts
PointPeaks point_peaks(const ResponseSpectra& spectra, const Point& point, double Omega,
                       double share = 0.01, int most = 12);

}  // namespace whirl::inline dyn

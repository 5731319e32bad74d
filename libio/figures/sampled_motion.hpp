#pragma once
/// What figures make of the samples of a motion: where any point was, how fast, when touch began.

#include <vector>

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// Degrees of freedom of the model of a motion.
/// @pre  the result has a model
/// @throws FileError  if the motion has another number of degrees of freedom
const DofMap& dofs_of(const ResultView& result, const MotionRecord& record);

/// Motion of a point at all samples: x, y [m], theta_x, theta_y [rad] in columns; zero where the
/// point has no such degree of freedom.
/// @throws FileError  as dofs_of
Mat motion_of_point(const ResultView& result, const MotionRecord& record, const Point& point);

/// Rates of numbers at the samples, by central differences, at both ends by one-sided ones.
Vec rates(const Vec& values, const Vec& time);

/// Where a touch begins: the first sample in touch, after one that is not.
std::vector<Eigen::Index> touches(const Mat& normal, Eigen::Index contact,
                                  const MotionSamples& samples);

/// How many samples at the end are taken for spectra, see whole_revolutions().
Eigen::Index spectrum_samples(const Motion& motion);

/// rad, mrad or µrad.
DisplayUnit tilt_unit(double largest);

/// Says what rates() are: "Rates are differences of samples, 64 a revolution."
std::string rates_note(const Motion& motion);

/// A number that may be drawn against its rate.
struct Moving {
  std::string name;  ///< "x"
  Vec value, rate;   ///< at all samples, in SI
  std::string unit;  ///< of the value, in SI: "m", "rad"
};

/// The phase plane of a number: its path in a stretch of the motion, a dot a revolution, and
/// where touch begins.
/// @param begins  samples, see touches()
Panel phase_plane(const Motion& motion, const MotionSamples& shown, const Moving& of,
                  const std::vector<Eigen::Index>& begins);

}  // namespace whirl::inline io::figures

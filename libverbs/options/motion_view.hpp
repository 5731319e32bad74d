#pragma once
/// Options of figures of motions: at which moments, which part of the motion.

#include "libio/figures/motion_view.hpp"
#include "libio/measured/record_values.hpp"
#include "libio/text/option.hpp"

namespace whirl::inline cli {

struct MotionViewVerbOptions {
  Option<Moments> at{"at", "S,...",
                     "speeds or times of a motion, such as 1500rpm,3000rpm or 2s, of orbits",
                     parse_moments};
  Option<std::vector<double>> order{
      "order", "Q,...", "of the speed, of which orbits are made, such as 1,2 or 0.5", parse_orders};
  Option<std::pair<double, double>> band{
      "band", "A:B", "frequencies of which orbits are made, such as 10:200Hz", parse_band};
  Flag average{"average", "orbits averaged over the revolutions about each moment"};
  Option<double> slow_roll{"slow-roll", "S",
                           "speed whose motion is taken off orbits, its vector or its waveform; of "
                           "centerline where the shaft rests",
                           parse_frequency};
  Option<double> clearance{"clearance", "R",
                           "radial, such as 120um, of the circle in centerline; left out: that of "
                           "the model's bearing",
                           parse_length};
  auto fields() { return std::tie(at, order, band, average, slow_roll, clearance); }
};

MotionView view_of(const MotionViewVerbOptions& options);

}  // namespace whirl::inline cli

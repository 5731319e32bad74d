#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// One of every `factor` samples of a record, after its higher frequencies have been taken out.
///
/// The low-pass filter is a sinc under a Hann window, ten of the new samples to either side, and
/// has no phase. Below 0.4 of the new sampling rate it keeps amplitudes within 1 %, from 0.6 on it
/// leaves less than 1 % of them. Ends that the filter does not cover are left out.
///
/// @param samples  times x channels, more than 20 factor of them
/// @return         times x channels, the first at time 10 factor of the record
Mat decimated(const Mat& samples, int factor);

}  // namespace whirl::inline data

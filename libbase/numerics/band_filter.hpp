#pragma once
/// Parts of signals between two frequencies.

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// The part of a signal between two frequencies, without delay: lines of its discrete Fourier
/// transform outside are left out.
///
/// A tone that makes whole periods in the signal is kept or left out exactly; of others the first
/// and last periods are wrong by up to their amplitude.
///
/// @param samples  at equal spacings; a number of them with large prime factors takes long
/// @param spacing  of the samples [s]
/// @param low      frequency from which on lines are kept, >= 0 [rad/s]
/// @param high     frequency up to which they are, > low [rad/s]
/// @return         as many samples
Vec band_passed(const Vec& samples, double spacing, double low, double high);

}  // namespace whirl::inline base

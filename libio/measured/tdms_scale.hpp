#pragma once
/// Scales of channels in TDMS files: from numbers of a converter to what was measured.

#include <string>
#include <vector>

#include "libio/measured/tdms_file.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Polynomials, one after the other.
struct TdmsScale {
  std::vector<std::vector<double>> polynomials;  ///< coefficients, that of x^0 first
  bool is_doubtful = false;  ///< nothing says whether samples are scaled already: taken as not

  double operator()(double sample) const;
};

/// The scale of a channel by its properties NI_Scale, linear ones and polynomials; none where
/// samples are scaled already.
/// @return  or what is wrong, in words: another kind of scale, or one that is not whole
Parsed<TdmsScale> tdms_scale(const TdmsProperties& properties);

/// Whether properties have a scale.
bool has_tdms_scale(const TdmsProperties& properties);

}  // namespace whirl::inline io

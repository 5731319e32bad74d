#pragma once
/// Spectra of parts of a motion, drawn one above the other.

#include <optional>
#include <string>
#include <vector>

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// Spectra of parts of a motion, with where they stand in the figure.
struct ShortSpectra {
  std::vector<double>
      place;               ///< times of the middles of the parts [s], or speeds [rad/s]; ascending
  double bin = 0.0;        ///< [rad/s]
  Eigen::Index count = 0;  ///< lines of a spectrum, even
  Mat amplitude;           ///< places x lines from -count / 2 to count / 2 - 1 [m]

  double frequency(Eigen::Index line) const { return bin * static_cast<double>(line - count / 2); }
};

/// An even number of samples, up to a number, that are soon transformed.
Eigen::Index even_smooth_length(Eigen::Index most);

/// Adds the spectrum of x + i y, without its mean, of `count` samples from one on.
/// @param row  of the amplitudes that receives it
void add_spectrum(const Vec& x, const Vec& y, Eigen::Index from, double spacing, Eigen::Index row,
                  ShortSpectra& to);

/// How far spectra are worth seeing: the largest magnitude of a frequency with more than a
/// thousandth of the largest amplitude, and more than three times the noise, which is the median of
/// the upper half of the frequencies.
double reach_of(const ShortSpectra& s);

/// What spectra are drawn of.
struct SpectraPlace {
  std::string name;
  std::vector<std::string> probes{};  ///< the one that they are of
  double factor = 1.0;                ///< of the circles at both signs of a frequency
  std::optional<DisplayUnit> unit{};  ///< nothing: by the largest number

  bool is_probe() const { return !probes.empty(); }
};

/// Curves of the spectra, one above the other, logarithmic over three powers of ten.
/// @param reach         largest magnitude of a frequency that is drawn [rad/s]
/// @param place_factor  of places in the panel
void add_curves(const ShortSpectra& s, const DisplayUnit& in, const DisplayUnit& unit,
                const SpectraPlace& place, double reach, double place_factor, Panel& p);

/// Says what the heights are.
/// @param largest  amplitude [m]
std::string heights_text(const SpectraPlace& place, const DisplayUnit& unit, double largest);

}  // namespace whirl::inline io::figures

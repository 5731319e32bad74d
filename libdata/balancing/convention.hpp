#pragma once
/// What phases of vibrations and angles of weights mean to who wrote them, and to who reads them.

#include <array>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/field.hpp"

namespace whirl::inline data {

/// Whether the phase of a reading says how far its peak leads the mark, or lags behind it.
enum class PhaseSense { lead, lag };
constexpr auto choices(PhaseSense) {
  return std::array{Choice<PhaseSense>{"lead", PhaseSense::lead},
                    Choice<PhaseSense>{"lag", PhaseSense::lag}};
}

/// In which direction angles on the rotor count, from the mark.
enum class AngleSense { with_rotation, against_rotation };
constexpr auto choices(AngleSense) {
  return std::array{Choice<AngleSense>{"with rotation", AngleSense::with_rotation},
                    Choice<AngleSense>{"against rotation", AngleSense::against_rotation}};
}

/// What an amplitude is.
enum class AmplitudeMeasure { peak_to_peak, peak, rms };
constexpr auto choices(AmplitudeMeasure) {
  return std::array{Choice<AmplitudeMeasure>{"peak to peak", AmplitudeMeasure::peak_to_peak},
                    Choice<AmplitudeMeasure>{"peak", AmplitudeMeasure::peak},
                    Choice<AmplitudeMeasure>{"rms", AmplitudeMeasure::rms}};
}

/// From what people write to complex numbers and back. Behind it a reading is Re(V e^(i theta)),
/// theta the angle that the rotor has turned by, and a weight m e^(i angle) with its angle in the
/// direction of rotation.
struct BalancingConvention {
  PhaseSense phase = PhaseSense::lead;
  AngleSense angles = AngleSense::with_rotation;
  AmplitudeMeasure amplitudes = AmplitudeMeasure::peak_to_peak;

  /// A told amplitude over the peak.
  double per_peak() const {
    return amplitudes == AmplitudeMeasure::peak_to_peak ? 2.0
           : amplitudes == AmplitudeMeasure::peak       ? 1.0
                                                        : std::sqrt(0.5);
  }
  /// @param told_phase  [rad]
  Complex reading(double amplitude, double told_phase) const {
    return std::polar(amplitude / per_peak(), phase == PhaseSense::lead ? told_phase : -told_phase);
  }
  /// @param angle  as told [rad]
  Complex weight(double mass, double angle) const { return mass * direction(angle); }
  Complex direction(double angle) const {
    return std::polar(1.0, angles == AngleSense::with_rotation ? angle : -angle);
  }

  double told_amplitude(Complex reading) const { return per_peak() * std::abs(reading); }
  /// 0 to 360 [deg].
  double told_phase(Complex reading) const {
    return turned(phase == PhaseSense::lead ? std::arg(reading) : -std::arg(reading));
  }
  double told_angle(Complex weight) const {
    return turned(angles == AngleSense::with_rotation ? std::arg(weight) : -std::arg(weight));
  }

 private:
  static double turned(double angle) {
    const double degrees = angle / degree;
    return degrees < 0.0 ? degrees + 360.0 : degrees + 0.0;
  }
};

}  // namespace whirl::inline data

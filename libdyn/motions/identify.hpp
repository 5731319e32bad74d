#pragma once
/// Which complex modes make up a motion: deflection shapes at spectral peaks against modes (MAC).

#include <optional>

#include "libdyn/motions/combinations.hpp"
#include "libdyn/motions/response.hpp"
#include "libfe/modes.hpp"

namespace whirl {

struct IdentifyOptions {
  int modes = 8;               ///< compared with
  bool rotations = false;      ///< tilts count too, times a length
  bool mass_weighted = false;  ///< MAC with the mass matrix instead
  bool stiffened = false;      ///< modes of the system with its contacts closed for good
  double share = 0.02;         ///< of the largest peak, below which peaks are left out
  int most_peaks = 10;
};

struct IdentifiedPeak {
  double frequency = 0.0;                  ///< signed: forward > 0 [rad/s]
  double amplitude = 0.0;                  ///< largest radius of a point at this frequency [m]
  std::vector<double> mac;                 ///< against each mode
  int mode = 0;                            ///< best one, from 0
  double shift = 0.0;                      ///< |frequency| over that mode's, less one
  std::optional<Combination> combination;  ///< of stronger peaks that are none themselves
};

/// Ratio of the two strongest frequencies seen from the rotor.
struct FrequencyRatio {
  int p = 0, q = 0;              ///< p >= q
  double error = 0.0;            ///< |ratio / (p/q) - 1|
  double high = 0.0, low = 0.0;  ///< the frequencies, unsigned [rad/s]
};

struct Identification {
  std::vector<Mode> modes;
  std::vector<IdentifiedPeak> peaks;  ///< strongest first
  std::optional<FrequencyRatio> resonance;
  double bin = 0.0;  ///< distance of spectral lines [rad/s]
};

/// Identifies the modes in a steady motion.
///
/// Peaks are those of the spectrum over all points together; at each, the deflection shape is the
/// complex amplitude of every displacement at the frequency's magnitude, so that a mode's forward
/// and backward parts are compared together. Contacts make combinations of the frequencies of a
/// motion: such peaks have the shape of a mode and not its frequency.
Identification identify(const Model& model, const Scene& scene, const Recording& recording,
                        const IdentifyOptions& options);

/// Weights of a MAC over the coordinates of a system: one for translations of every point; for
/// tilts length^2, or nothing if the length is zero.
Sparse mac_weights(const DofMap& dofs, double length);

/// The ratio p:q of small numbers nearest to high / low; smaller numbers win among good ones.
FrequencyRatio ratio_of(double high, double low);

/// Whether a peak is the response to what turns with the rotor.
///
/// @param bin  distance of spectral lines [rad/s]
bool is_forced(double frequency, double Omega, double bin);

/// Rows of the displacement that closes a contact, over the coordinates of a system: of its station
/// against the other one [m]; of a face its tilts times its radius.
PlaneRows closing_rows(const Contact& contact, const Assembler& assembler, const DofMap& dofs);

/// The system with the stiffness of its contacts added at their stations, as if closed for good: of
/// rings and blades to lateral displacements, of faces to tilts.
System stiffened(const Model& model, const Scene& scene);

}  // namespace whirl

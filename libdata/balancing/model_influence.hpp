#pragma once
/// Influence coefficients and vibration of a model.

#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline data {

/// A probe, by its number in a list, at a speed.
struct ReadingPlace {
  std::size_t probe = 0;
  double speed = 0.0;  ///< [rad/s]
};

struct ModelInfluence {
  CMat coefficients;  ///< places x planes, reading = Re(V e^(i Omega t)) [m/(kg.m)]
  CVec vibration;     ///< of the model's own unbalance, bow and forces of order 1 [m]
  /// Contacts that the rotor touches under these loads and gravity, "contact ring at 3000 rpm".
  std::vector<std::string> touched;
};

/// The linear response at the probes to an unbalance of 1 kg.m in each plane, and to the model's
/// own loads. Contacts are open in both.
///
/// @param model   with an unbalance at every plane, whatever its moment, so that it has nodes there
/// @param planes  where these are, among model.structure.unbalances
/// @throws NumericalError  where a response is not bounded
ModelInfluence model_influence(const Model& model, const std::vector<std::size_t>& planes,
                               const std::vector<Probe>& probes,
                               const std::vector<ReadingPlace>& places);

/// The contacts that the rotor touches under gravity and its loads of the frequency of the speed.
/// @param speeds  [rad/s]
std::vector<std::string> touched_contacts(const Model& model, const std::vector<double>& speeds);

}  // namespace whirl::inline data

#pragma once
/// A simulation: transient, then a recorded stretch with its contact measures.

#include <functional>
#include <numbers>

#include "libdyn/methods/methods.hpp"
#include "libdyn/motions/support_loads.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// A rotor up to an instant, before some of its loads begin.
struct MotionStage {
  const ContactSystem* system = nullptr;   ///< of the scene's coordinates and contacts
  const SupportLoads* supports = nullptr;  ///< null: forces on supports are not recorded
  double until = 0.0;                      ///< revolutions after the start of the recording
};

struct SimulationOptions {
  long revolutions = 512;  ///< recorded
  long discard = 500;      ///< before, not recorded
  int samples = 64;        ///< per revolution, at equal phases from 0
  AnyMethod method;
  IntegrationOptions integration;
  const SupportLoads* supports = nullptr;  ///< null: forces on supports are not recorded
  /// Before the scene itself, ascending; the first one counts before the recording, too.
  std::vector<MotionStage> stages{};
  /// Called once per revolution with the number done; returns false to stop. May be empty.
  std::function<bool(long)> progress;
  /// Asked at every step whether to stop. May be empty.
  std::function<bool()> is_stopped;
};

/// A recorded stretch of motion in reduced coordinates, at equal angles.
struct Recording {
  int samples = 0;            ///< per revolution
  long revolutions = 0;       ///< whole ones that were recorded
  Clock clock{};              ///< of the rotor
  long first_revolution = 0;  ///< number of the first one since the start
  Vec time;                   ///< of every sample, since the start [s]
  Mat eta;                    ///< n x (revolutions * samples)
  Mat normal, friction;       ///< contact forces, contacts x samples [N]; friction signed along t
  Mat on_supports{};          ///< forces on the parts of SupportLoads, 2 parts x samples [N]
  std::vector<double> begins{};  ///< of loads, the ends of stages, since the start [s]
  std::vector<ContactMeasure> contacts;
  std::vector<FrictionLoad> rubbing{};  ///< of the contacts; empty: not told

  /// Angle of the rotor at a sample, from the start of the first revolution [rad].
  double angle(Eigen::Index sample) const {
    return 2.0 * std::numbers::pi / samples * static_cast<double>(sample);
  }
  double speed() const { return clock.speed(); }               ///< at all samples [rad/s]
  double spacing() const { return clock.period() / samples; }  ///< between samples [s]
};

struct Simulation {
  Recording recording;
  MotionState end;          ///< of the motion
  Integration integration;  ///< outcome, cost and failure of the whole
  double wall = 0.0;        ///< duration of the integration [s]
};

/// Integrates a scene from a state, and the stages before it. The end of a stage is an instant of
/// the dense output of its step; contacts are classified anew there, since forces may have jumped.
/// What was recorded before a failure or a stop is kept.
Simulation simulate(const Scene& scene, MotionState start, const SimulationOptions& options);

/// The motion that goes on from a state, by the method that suits the contacts. States of contacts
/// that are left out are those of a motion whose past is not known.
/// @param supports  null: forces on supports are not recorded
Recording recorded_from(const Scene& scene, MotionState start, long revolutions,
                        const SupportLoads* supports = nullptr);

}  // namespace whirl::inline dyn

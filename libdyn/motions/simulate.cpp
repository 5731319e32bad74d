#include "libdyn/motions/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace whirl::inline dyn {

namespace {

/// Takes samples at exact phases of the revolution from the dense output of steps.
class Sampler {
 public:
  Sampler(const ContactSystem& system, Recording& recording, long revolutions)
      : system_(system), recording_(recording), y_(system.size()) {
    const auto total = revolutions * recording.samples;
    recording.eta.resize(system.coordinates(), total);
    recording.normal.setZero(system.owners(), total);
    recording.friction.setZero(system.owners(), total);
    recording.time.resize(total);
    for (Eigen::Index j = 0; j < total; ++j) {
      recording.time(j) =
          recording.clock.time_after(static_cast<double>(recording.first_revolution) +
                                     static_cast<double>(j) / recording.samples);
    }
  }

  void add(const Step& step) {
    while (next_ < recording_.eta.cols()) {
      const long revolution = recording_.first_revolution + next_ / recording_.samples;
      const double phase = recording_.angle(next_ % recording_.samples);
      if (revolution != step.revolution || phase >= step.angle(1.0 + 1e-14)) return;
      // a sample at the very start of a revolution belongs to the step that begins there
      const double s = step.after_turn(phase - step.phase);
      step.at(s, y_.data());
      recording_.eta.col(next_) = system_.layout().eta(y_);
      if (!system_.contacts().empty()) {
        system_.forces({phase, revolution}, y_.data(), step.contacts, forces_);
        for (std::size_t i = 0; i < forces_.size(); ++i) {
          if (!step.contacts[i].in_touch()) continue;
          const int owner = system_.contacts()[i].owner;
          recording_.normal(owner, next_) += forces_[i].normal;
          recording_.friction(owner, next_) += forces_[i].friction;
        }
      }
      ++next_;
    }
  }

  /// Leaves only the whole revolutions that were sampled.
  void close() {
    recording_.revolutions = next_ / recording_.samples;
    const auto whole = recording_.revolutions * recording_.samples;
    recording_.time.conservativeResize(whole);
    recording_.eta.conservativeResize(Eigen::NoChange, whole);
    recording_.normal.conservativeResize(Eigen::NoChange, whole);
    recording_.friction.conservativeResize(Eigen::NoChange, whole);
  }

 private:
  const ContactSystem& system_;
  Recording& recording_;
  Vec y_;
  std::vector<ContactForces> forces_;
  Eigen::Index next_ = 0;
};

}  // namespace

Simulation simulate(const Scene& scene, MotionState start, const SimulationOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const ContactSystem& system = scene.contacts;
  Simulation result{.end = std::move(start)};
  const long first = result.end.revolution;
  long done = first;
  const auto goes_on = [&](const Step& step) {
    if (options.is_stopped && options.is_stopped()) return false;
    if (!options.progress || step.revolution == done) return true;
    done = step.revolution;
    return options.progress(done - first);
  };

  Integration& total = result.integration;
  if (options.discard > 0) {
    // without an observer, methods may jump where nothing happens
    total = integrate(options.method, system, result.end, options.discard, options.integration,
                      options.progress || options.is_stopped ? Observer(goes_on) : Observer());
  }
  Recording& recording = result.recording;
  recording.samples = options.samples;
  recording.clock = system.clock();
  recording.first_revolution = result.end.revolution;
  if (total.outcome == Outcome::reached_end) {
    Sampler sampler(system, recording, options.revolutions);
    ContactMeter meter(system);
    const Cost before = total.cost;
    total = integrate(options.method, system, result.end, options.revolutions, options.integration,
                      [&](const Step& step) {
                        sampler.add(step);
                        meter.add(step);
                        return goes_on(step);
                      });
    total.cost += before;
    sampler.close();
    recording.contacts = meter.measures();
  }
  result.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace whirl::inline dyn

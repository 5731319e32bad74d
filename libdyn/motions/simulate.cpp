#include "libdyn/motions/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

namespace whirl::inline dyn {

namespace {

/// Takes samples at exact phases of the revolution from the dense output of steps.
class Sampler {
 public:
  Sampler(const ContactSystem& system, Recording& recording, long revolutions,
          const SupportLoads* supports)
      : system_(&system), recording_(recording), supports_(supports), y_(system.size()) {
    const auto total = revolutions * recording.samples;
    recording.eta.resize(system.coordinates(), total);
    recording.normal.setZero(system.owners(), total);
    recording.friction.setZero(system.owners(), total);
    if (supports_) recording.on_supports.resize(std::ssize(supports_->parts()) * 2, total);
    recording.time.resize(total);
    for (Eigen::Index j = 0; j < total; ++j) {
      recording.time(j) =
          recording.clock.time_after(static_cast<double>(recording.first_revolution) +
                                     static_cast<double>(j) / recording.samples);
    }
  }

  /// Goes on with the same coordinates and contacts in another system.
  void go_on_in(const MotionStage& stage) {
    system_ = stage.system;
    supports_ = stage.supports;
  }

  void add(const Step& step) {
    while (next_ < recording_.eta.cols()) {
      const long revolution = recording_.first_revolution + next_ / recording_.samples;
      const double phase = recording_.angle(next_ % recording_.samples);
      if (revolution != step.revolution || phase >= step.angle(1.0 + 1e-14)) return;
      // a sample at the very start of a revolution belongs to the step that begins there
      const double s = step.after_turn(phase - step.phase);
      step.at(s, y_.data());
      recording_.eta.col(next_) = system_->layout().eta(y_);
      const Instant instant{phase, revolution};
      if (!system_->contacts().empty()) {
        system_->forces(instant, y_.data(), step.contacts, forces_);
        for (std::size_t i = 0; i < forces_.size(); ++i) {
          if (!step.contacts[i].in_touch()) continue;
          const int owner = system_->contacts()[i].owner;
          recording_.normal(owner, next_) += forces_[i].normal;
          recording_.friction(owner, next_) += forces_[i].friction;
        }
      }
      if (supports_) {
        if (supports_->needs_acceleration()) step.acceleration(s, acceleration_);
        supports_->at(*system_, instant, y_.data(), acceleration_, step.contacts, forces_,
                      recording_.on_supports.col(next_));
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
    recording_.on_supports.conservativeResize(Eigen::NoChange, whole);
  }

 private:
  const ContactSystem* system_;
  Recording& recording_;
  const SupportLoads* supports_;
  Vec y_, acceleration_;
  std::vector<ContactForces> forces_;
  Eigen::Index next_ = 0;
};

/// Angle that the rotor has gone through since revolution 0, at a place of a step [rad].
double whole_angle(const Step& step, double s) {
  return 2.0 * std::numbers::pi * static_cast<double>(step.revolution) + step.angle(s);
}

/// The state at the end of a step, its contacts as a system without a past has them.
MotionState end_of(const Step& step, const ContactSystem& next) {
  MotionState state{step.revolution, step.angle(1.0), Vec(next.size()), {}};
  step.at(1.0, state.y.data());
  if (state.phase >= 2.0 * std::numbers::pi * (1.0 - 1e-15)) ++state.revolution, state.phase = 0.0;
  state.contacts = next.classify(state.instant(), state.y.data());
  return state;
}

}  // namespace

Simulation simulate(const Scene& scene, MotionState start, const SimulationOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<MotionStage> stages = options.stages;
  stages.push_back({&scene.contacts, options.supports, static_cast<double>(options.revolutions)});
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
    total = integrate(options.method, *stages.front().system, result.end, options.discard,
                      options.integration,
                      options.progress || options.is_stopped ? Observer(goes_on) : Observer());
  }
  Recording& recording = result.recording;
  recording.samples = options.samples;
  recording.clock = scene.contacts.clock();
  recording.first_revolution = result.end.revolution;
  if (total.outcome == Outcome::reached_end) {
    Sampler sampler(*stages.front().system, recording, options.revolutions,
                    stages.front().supports);
    ContactMeter meter(*stages.front().system);
    const long last = recording.first_revolution + options.revolutions;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const bool is_last = stages[i].until >= static_cast<double>(options.revolutions);
      const double end_angle = 2.0 * std::numbers::pi *
                               (static_cast<double>(recording.first_revolution) + stages[i].until);
      std::optional<MotionState> next;
      sampler.go_on_in(stages[i]);
      meter.go_on_in(*stages[i].system);
      const Cost before = total.cost;
      const auto observe = [&](const Step& step) {
        if (is_last || whole_angle(step, 1.0) < end_angle) {
          sampler.add(step);
          meter.add(step);
          return goes_on(step);
        }
        const double share = step.after_turn(end_angle - whole_angle(step, 0.0));
        const Step part = step.first_part(share);
        if (share > 0.0) sampler.add(part), meter.add(part);
        next = end_of(part, *stages[i + 1].system);
        return false;
      };
      total = integrate(options.method, *stages[i].system, result.end, last - result.end.revolution,
                        options.integration, observe);
      total.cost += before;
      if (!next) break;
      total.outcome = Outcome::reached_end;
      result.end = std::move(*next);
      recording.begins.push_back(recording.clock.time_after(
          static_cast<double>(recording.first_revolution) + stages[i].until));
    }
    sampler.close();
    recording.contacts = meter.measures();
    recording.rubbing = meter.friction();
  }
  result.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

Recording recorded_from(const Scene& scene, MotionState start, long revolutions,
                        const SupportLoads* supports) {
  if (start.contacts.empty()) {
    start.contacts = scene.contacts.classify(start.instant(), start.y.data());
  }
  return simulate(scene, std::move(start),
                  {.revolutions = revolutions,
                   .discard = 0,
                   .method = suitable_method(scene.contacts),
                   .supports = supports})
      .recording;
}

}  // namespace whirl::inline dyn

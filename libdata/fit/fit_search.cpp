#include "libdata/fit/fit_search.hpp"

#include "libbase/error.hpp"
#include "libdyn/motions/equilibrium.hpp"

namespace whirl::inline data {

namespace {

/// As if the motion was about where the rotor rests.
Vec likely_offset(const FitSource& source, const ContactSystem& system) {
  const Mat& readings = source.record.readings;
  Vec offset = Vec::Zero(readings.rows());
  for (Eigen::Index probe = 0; probe < offset.size(); ++probe) {
    const auto is_there = readings.row(probe).array().isFinite();
    offset(probe) = is_there.select(readings.row(probe).array(), 0.0).sum() /
                    std::max(1.0, is_there.cast<double>().sum());
  }
  try {
    return offset - source.rows * equilibrium(system);
  } catch (const NumericalError&) {  // it rests nowhere
    return offset;
  }
}

}  // namespace

FitSearch::FitSearch(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& free,
                     const FitOptions& asked, int steady_windows_per_revolution)
    : parameters(free), options(asked) {
  const auto count = std::ssize(free);
  x.resize(count);
  sizes.resize(count);
  for (Eigen::Index p = 0; p < count; ++p) {
    const FreeParameter& parameter = free[static_cast<std::size_t>(p)];
    sizes(p) = parameter.size;
    x(p) = parameter.start / parameter.size;
  }
  for (const FitSource& source : sources) {
    RecordShooting shooting{.source = &source, .system = source.system_at(values())};
    const ContactSystem& system = shooting.system->system;
    const StateLayout layout = system.layout();
    const int share = source.record.period > 0 ? steady_windows_per_revolution : 1;
    const double duration = options.window > 0.0 ? options.window : system.period() / share;
    shooting.windows = shooting_windows(source, duration, system);
    shooting.length = system.length_scale();
    shooting.offset = Vec::Zero(source.rows.rows());
    if (shooting.has_offset()) shooting.offset = likely_offset(source, system) / shooting.length;
    shooting.scale = system.state_scale();
    // coordinates that move the probes by their noise, and the rates that do so within a radian
    shooting.gap = shooting.scale * (source.record.noise.mean() / shooting.length);
    layout.rate(shooting.gap) = layout.eta(shooting.gap) * system.phase_rate();
    for (const ShootingWindow& window : shooting.windows) {
      const Vec guess = window.guess(shooting.offset * shooting.length);
      shooting.starts.push_back(guess.cwiseQuotient(shooting.scale));
    }
    shootings.push_back(std::move(shooting));
  }
}

long FitSearch::readings() const {
  long all = 0;
  for (const RecordShooting& shooting : shootings) {
    for (const ShootingWindow& window : shooting.windows) all += window.readings();
  }
  return all;
}

void FitSearch::make_systems() {
  for (RecordShooting& shooting : shootings) {
    try {
      shooting.system = shooting.source->system_at(values());
    } catch (
        const std::runtime_error&) {  // values that make no system: the search takes a shorter step
      shooting.system.reset();
    }
  }
}

}  // namespace whirl::inline data

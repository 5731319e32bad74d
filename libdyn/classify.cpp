#include "libdyn/classify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libdyn/batch/batch.hpp"
#include "libfe/base/error.hpp"
#include "libfe/eigen/dense.hpp"

namespace whirl {

namespace {

/// Distances of sections that make a period worth a try: the nearer they repeat, the surer.
constexpr double repeats[] = {1e-6, 1e-4, 1e-2};
constexpr double nearby = 10.0;            ///< how many of them the orbit may be away
constexpr double same = 1e-6;              ///< of a shorter period that Newton's orbit has, too
constexpr double exact = 1e-12;            ///< tolerance of steps for an orbit and its multipliers
constexpr double converged = 1e-11;        ///< residual of an orbit
constexpr double accurate = 1e-8;          ///< what rounding and events may leave of it
constexpr double attracting = 1.0 - 1e-7;  ///< largest multiplier, whose error is below the rest
constexpr int most_newton = 8;

/// One motion, moved on by pieces; it remembers the first failure.
struct Motion {
  const ContactSystem& system;
  double tolerance;
  MotionState state;
  Outcome outcome = Outcome::reached_end;
  std::string diagnosis;

  bool is_good() const { return outcome == Outcome::reached_end; }

  Trajectory go(long revolutions, BatchOptions options, const Observer& observer = {}) {
    options.tolerance = tolerance;
    Trajectory t{.system = &system, .state = state, .revolutions = revolutions};
    integrate_single(t, options, observer);
    if (t.outcome != Outcome::reached_end && is_good()) {
      outcome = t.outcome;
      diagnosis = t.diagnosis;
    }
    state = t.state;
    return t;
  }
};

/// Smallest period with which the last sections repeat within a bound; 0: none.
int period_of(const ContactSystem& system, const std::vector<double>& sections, int longest,
              double bound) {
  const int size = system.size(), count = static_cast<int>(sections.size()) / size;
  const auto section = [&](int i) -> Vec {
    return Eigen::Map<const Vec>(sections.data() + i * size, size);
  };
  for (int p = 1; p <= std::min(longest, count / 2); ++p) {
    double worst = 0.0;
    for (int i = count - p; i < count; ++i) {
      worst = std::max(worst, distance(system, section(i), section(i - p)));
    }
    if (worst < bound) return p;
  }
  return 0;
}

struct Orbit {
  Vec y;
  double residual = 0.0;
  Vec exponents;  ///< per revolution, descending
};

/// Attracting orbit of a period within a distance of a state, by Newton's method on the return map.
std::optional<Orbit> orbit_near(const ContactSystem& system, const MotionState& start, int period,
                                double farthest, double tolerance) {
  const Vec& scale = system.state_scale();
  const Mat unscale = scale.asDiagonal(), to_scale = scale.cwiseInverse().asDiagonal();
  Orbit orbit{.y = start.y};
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_newton; ++iteration) {
    Motion motion{system, tolerance, {.revolution = 0, .phase = 0.0, .y = orbit.y}};
    const Trajectory t = motion.go(period, {.tangent = true});
    if (!motion.is_good() || !t.tangent.allFinite()) return std::nullopt;
    orbit.residual = distance(system, t.state.y, orbit.y);
    const Mat tangent = to_scale * t.tangent * unscale;
    if (orbit.residual < converged ||
        (orbit.residual < accurate && orbit.residual > 0.5 * before)) {
      const Vec sizes = eigenvalues(tangent).cwiseAbs();
      if (!(sizes.maxCoeff() < attracting)) return std::nullopt;
      orbit.exponents = sizes.array().max(1e-300).log() / period;
      std::sort(orbit.exponents.begin(), orbit.exponents.end(), std::greater<>());
      if (distance(system, orbit.y, start.y) > farthest) return std::nullopt;  // another one
      return orbit;
    }
    if (orbit.residual > 10.0 * before) return std::nullopt;
    before = orbit.residual;
    const DenseLu<Mat> lu(Mat(tangent - Mat::Identity(tangent.rows(), tangent.cols())));
    if (!(lu.rcond() > 1e-14)) return std::nullopt;
    const Vec step = lu.solve((t.state.y - orbit.y).cwiseQuotient(scale));
    orbit.y -= scale.cwiseProduct(step);
  }
  return std::nullopt;
}

/// Whether a motion stands still all through a revolution.
bool stands_still(const ContactSystem& system, const MotionState& state, double tolerance) {
  double moved = 0.0;
  Motion motion{system, tolerance, state};
  Vec y(system.size());
  motion.go(1, {}, [&](const Step& step) {
    for (const double s : {0.5, 1.0}) {
      step.at(s, y.data());
      moved = std::max(moved, distance(system, y, state.y));
    }
    return true;
  });
  return motion.is_good() && moved < same;
}

}  // namespace

double Classification::impacts() const {
  double sum = 0.0;
  for (const ContactMeasure& c : contacts) sum += c.impacts;
  return sum;
}

Classification classify(const ContactSystem& system, MotionState start,
                        const ClassifyOptions& options) {
  if (system.coordinates() == 0) throw NumericalError("nothing moves: the system has no freedoms");
  Classification result;
  Motion motion{system, options.tolerance, std::move(start)};
  const auto finished = [&] {
    result.end = motion.state;
    result.outcome = motion.outcome;
    result.diagnosis = motion.diagnosis;
    return result;
  };

  /// The orbit that the sections show, if there is one: then everything is known.
  const auto is_proven_periodic = [&] {
    const Trajectory searched = motion.go(2 * options.longest_period, {.sections = true});
    if (!motion.is_good()) return false;
    double within = 0.0;
    for (const double bound : repeats) {
      result.period = period_of(system, searched.sections, options.longest_period, within = bound);
      if (result.period > 0) break;
    }
    if (result.period == 0) return false;
    const auto orbit = orbit_near(system, motion.state, result.period, nearby * within,
                                  std::min(options.tolerance, exact));
    if (!orbit) return false;
    motion.state.y = orbit->y;
    motion.state.contacts.clear();  // as they follow from the motion
    Motion twice = motion;
    const Trajectory sections = twice.go(2 * result.period, {.sections = true});
    result.period = std::max(1, period_of(system, sections.sections, result.period, same));
    const bool stands = result.period == 1 && stands_still(system, motion.state, options.tolerance);
    result.kind = stands ? MotionKind::equilibrium : MotionKind::periodic;
    result.exponents = orbit->exponents;
    result.residual = orbit->residual;
    result.is_proven = true;
    ContactMeter meter(system);
    motion.go(result.period, {}, [&](const Step& step) {
      meter.add(step);
      return true;
    });
    result.revolutions = result.period;
    result.contacts = meter.measures();
    return true;
  };

  /// Asks once a revolution whether to go on; `before`: revolutions done when it begins.
  const auto asker = [&](long before) {
    return [&options, before, first = motion.state.revolution,
            last = motion.state.revolution](const Step& step) mutable {
      if (step.revolution == last || !options.progress) return true;
      last = step.revolution;
      return options.progress(before + last - first);
    };
  };

  motion.go(options.discard, {}, options.progress ? Observer(asker(0)) : Observer());
  if (motion.is_good() && is_proven_periodic()) return finished();
  if (!motion.is_good()) return finished();

  ContactMeter meter(system);
  const long first = motion.state.revolution;
  const auto averaging = [&, goes_on = asker(options.discard)](const Step& step) mutable {
    meter.add(step);
    return goes_on(step);
  };
  const Trajectory t = motion.go(options.revolutions, {.exponents = true}, averaging);
  result.revolutions = motion.state.revolution - first;
  result.contacts = meter.measures();
  if (!motion.is_good() || result.revolutions == 0) return finished();

  const double turns = static_cast<double>(result.revolutions);
  result.exponents = t.exponents * system.period();
  result.resolution = (1.0 + std::log(turns)) / turns;
  const auto positive = (result.exponents.array() > result.resolution).count();
  if (positive > 0) {
    result.kind = positive > 1 ? MotionKind::hyperchaotic : MotionKind::chaotic;
    result.period = 0;
  } else if (result.exponents(0) > -result.resolution) {
    result.kind = MotionKind::quasi_periodic;
    result.period = 0;
  } else if (!is_proven_periodic()) {  // it attracts, and has come nearer by now
    result.kind = MotionKind::periodic;
  }
  return finished();
}

}  // namespace whirl

#include "libdyn/studies/classify.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/fractal_dimension.hpp"
#include "libdyn/studies/exponents.hpp"
#include "libdyn/studies/proven_orbit.hpp"
#include "libdyn/studies/stepped.hpp"
#include "libdyn/system/load_periods.hpp"
#include "libdyn/system/require_coordinates.hpp"
#include "libdyn/taylor/mixed.hpp"

namespace whirl::inline dyn {

namespace {

/// Distances of sections that make a period worth a try: the nearer they repeat, the surer.
constexpr double repeats[] = {1e-6, 1e-4, 1e-2};
constexpr int sure_repeats = 2;       ///< how many of them count before the transient is over
constexpr double nearby = 10.0;       ///< how many of them the orbit may be away
constexpr long first_search = 96;     ///< revolutions
constexpr double later_search = 1.5;  ///< times those of the search before
constexpr Eigen::Index most_dimension = 400;  ///< sections that their dimension is taken from
/// Change of averages over sections that a motion may have which has settled.
constexpr double settled_change = 0.02;
constexpr long fewest_averaged = 48;         ///< revolutions, before exponents may be known well
constexpr long averaged_between_looks = 16;  ///< revolutions
constexpr long most_load_periods = 8;        ///< of loads, that a motion may take to repeat
constexpr double most_repeating = 4000;      ///< revolutions, likewise
constexpr long most_flight =
    1'000'000'000;  ///< revolutions that a motion is followed in closed form

/// Time after which a motion repeats under loads that nothing turns with, a few of their periods;
/// 0: it does not, or something turns [s].
double repeating_time(const ContactSystem& system, const MotionState& from, double tolerance) {
  const auto together = load_period(system);
  if (!together) return 0.0;
  const double each = *together * system.phase_rate();  // of the phase
  const auto most =
      std::min<long>(most_load_periods, static_cast<long>(most_repeating * turn / each));
  if (most == 0) return 0.0;
  Trajectory t{.system = &system, .state = from};
  t.revolutions = static_cast<long>(std::ceil(static_cast<double>(most) * each / turn)) + 1;
  Vec y(system.size());
  long number = 1, found = 0;
  integrate_single(t, {.tolerance = tolerance}, [&](const Step& step) {
    const double begin =
        static_cast<double>(step.revolution - from.revolution) * turn + step.phase - from.phase;
    for (; number <= most && static_cast<double>(number) * each <= begin + step.turn(); ++number) {
      step.at(step.after_turn(static_cast<double>(number) * each - begin), y.data());
      if (!(distance(system, y, from.y) < repeats[sure_repeats - 1])) continue;
      found = number;
      return false;
    }
    return number <= most;
  });
  return static_cast<double>(found) * *together;
}

/// Motions that are classified together.
class BatchClassifier {
 public:
  BatchClassifier(std::span<ClassifyCandidate> all, const ClassifyOptions& options)
      : options_(options) {
    for (ClassifyCandidate& s : all) {
      require_coordinates(*s.system);
      if (s.found.is_good() && !s.found.is_proven) open_.push_back(&s);
    }
    fly();
  }

  void settle() {
    if (by_steps()) {
      go(options_.discard, {});
      for (ClassifyCandidate* s : open_) s->found.transient = options_.discard;
      return;
    }
    long done = 0;
    for (double next = first_search; done < options_.discard && !open_.empty();
         next *= later_search) {
      // the last stage takes what would be too short for one of its own
      const bool is_last = later_search * next > static_cast<double>(options_.discard);
      const long to = is_last ? options_.discard : static_cast<long>(next);
      const long watched = std::min(to - done, 2L * options_.longest_period);
      go(to - done - watched, {});
      const std::vector<Trajectory> sections = go(watched, {.sections = true});
      done = to;
      for (ClassifyCandidate* s : open_) s->found.transient = done;
      search(sections, is_last);
      fly();
    }
  }

  void average() {
    std::vector<Trajectory> all = go(std::min(options_.revolutions, options_.exponents),
                                     {.sections = true,
                                      .measures = true,
                                      .exponents = true,
                                      .most_exponents = options_.most_exponents,
                                      .growths = true,
                                      .is_enough = knows_enough()});
    const std::vector<ClassifyCandidate*> before = open_;
    std::vector<long> left;
    for (const Trajectory& t : all) {
      left.push_back(options_.revolutions - std::ssize(t.sections) / t.system->size());
    }
    const std::vector<Trajectory> rest =
        go(left, {.sections = options_.sections > 0, .measures = true});
    for (std::size_t i = 0, j = 0; i < before.size(); ++i) {
      if (j == open_.size() || before[i] != open_[j]) continue;  // it failed meanwhile
      if (j != i) all[j] = std::move(all[i]);
      append(rest[j], all[j]);
      ++j;
    }
    std::vector<ClassifyCandidate*> undecided;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      judge(all[i], *open_[i]);
      if (by_steps()) tell_period(all[i], *open_[i]);
      const Classification& c = open_[i]->found;
      const bool is_order = c.kind == MotionKind::periodic || c.kind == MotionKind::not_settled;
      if (is_order) undecided.push_back(open_[i]);
    }
    open_ = std::move(undecided);  // they have come nearer to their orbits by now
    if (!by_steps()) {
      fly();
      if (!open_.empty()) search(go(2L * options_.longest_period, {.sections = true}), true);
      search_with_forces();
    }
    for (ClassifyCandidate* s : open_) tell_what_settles(*s);
  }

 private:
  bool by_steps() const { return options_.rk4_steps > 0; }
  Eigen::Index exponents_of(const ContactSystem& system) const {
    return dyn::exponents_of(system.size(), options_.most_exponents);
  }

  std::function<bool(long)> watch(bool counts) const {
    if (!options_.watch) return {};
    return [this, counts](long done) { return options_.watch(done_ + (counts ? done : 0)); };
  }

  /// Whether a motion is chaotic for sure, and its largest exponent as well known as asked for.
  std::function<bool(const Trajectory&)> knows_enough() const {
    if (options_.resolution == 0.0) return {};
    return [this](const Trajectory& t) {
      const Eigen::Index count = exponents_of(*t.system);
      const Eigen::Index revolutions = std::ssize(t.growths) / count;
      if (revolutions < fewest_averaged || revolutions % averaged_between_looks != 0) return false;
      const auto found =
          estimate_exponents(Eigen::Map<const Mat>(t.growths.data(), count, revolutions));
      return found.resolution <= options_.resolution && found.exponents(0) > found.resolution;
    };
  }

  /// Moves all open motions on; those that fail or are stopped are open no longer.
  std::vector<Trajectory> go(long revolutions, const BatchOptions& how) {
    return go(std::vector<long>(open_.size(), revolutions), how);
  }
  /// The same by a number of revolutions for each.
  std::vector<Trajectory> go(const std::vector<long>& revolutions, BatchOptions how) {
    how.tolerance = options_.tolerance;
    how.threads = 1;
    how.watch = watch(true);
    std::vector<Trajectory> all;
    std::vector<long> first;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      Classification& found = open_[i]->found;
      first.push_back(found.end.revolution);
      all.push_back({.system = open_[i]->system,
                     .state = std::move(found.end),
                     .revolutions = revolutions[i]});
    }
    move(all, how);
    std::vector<Trajectory> good;
    std::vector<ClassifyCandidate*> open;
    for (std::size_t i = 0; i < all.size(); ++i) {
      Classification& c = open_[i]->found;
      if (how.measures && all[i].outcome != Outcome::reached_end) {  // as far as it came
        c.revolutions = all[i].state.revolution - first[i];
        take_measures(all[i], c);
      }
      c.end = all[i].state;
      c.outcome = all[i].outcome;
      c.failure = all[i].failure;
      if (!c.is_good()) continue;
      open.push_back(open_[i]);
      good.push_back(std::move(all[i]));
    }
    done_ += std::accumulate(revolutions.begin(), revolutions.end(), 0L);
    open_ = std::move(open);
    return good;
  }

  /// Integrates all that have revolutions to go.
  void move(std::vector<Trajectory>& all, const BatchOptions& how) const {
    std::vector<Trajectory> moving;
    for (Trajectory& t : all) {
      if (t.revolutions > 0) moving.push_back(std::move(t));
    }
    if (moving.empty()) return;
    by_steps() ? integrate_stepped(moving, how, options_.rk4_steps) : integrate_mixed(moving, how);
    auto next = moving.begin();
    for (Trajectory& t : all) {
      if (t.revolutions > 0) t = std::move(*next++);
    }
  }

  /// Adds what a trajectory did after another one.
  static void append(const Trajectory& later, Trajectory& to) {
    to.sections.insert(to.sections.end(), later.sections.begin(), later.sections.end());
    for (std::size_t i = 0; i < later.contacts.size(); ++i) {
      to.contacts[i].append(later.contacts[i]);
    }
  }

  /// What the contacts did in so many revolutions, and the last sections.
  void take_measures(const Trajectory& t, Classification& to) const {
    to.contacts.clear();
    if (to.revolutions == 0) return;
    to.contacts = shares_of(t.contacts, t.system->period() * static_cast<double>(to.revolutions));
    if (options_.sections == 0) return;
    const std::ptrdiff_t size = t.system->size();
    const auto kept = std::min(std::ssize(t.sections), options_.sections * size);
    to.sections.assign(t.sections.end() - kept, t.sections.end());
  }

  /// Dimension of the last sections of a motion.
  static double dimension(const Trajectory& t) {
    const Eigen::Index size = t.system->size(), all = std::ssize(t.sections) / size;
    const Eigen::Index used = std::min(all, most_dimension);
    const Eigen::Map<const Mat> sections(t.sections.data() + (all - used) * size, size, used);
    return fractal_dimension(t.system->state_scale().cwiseInverse().asDiagonal() * sections);
  }

  /// What a motion is by the growth of its tangents and by its sections, which may leave it open.
  void judge(const Trajectory& t, ClassifyCandidate& s) const {
    Classification& c = s.found;
    c.revolutions = options_.revolutions;
    take_measures(t, c);
    const Eigen::Index size = s.system->size(), count = t.exponents.size();
    const Eigen::Map<const Mat> growths(t.growths.data(), count, std::ssize(t.growths) / count);
    const ExponentEstimate estimate = estimate_exponents(growths);
    c.exponents = estimate.exponents;
    c.zero = estimate.zero;
    c.resolution = estimate.resolution;
    if (options_.path > 0) c.path = exponent_path(growths, options_.path);
    c.section_dimension = dimension(t);
    const Eigen::Map<const Mat> sections(t.sections.data(), size, std::ssize(t.sections) / size);
    c.drift = drift_of(s.system->state_scale().cwiseInverse().asDiagonal() * sections);
    const auto positive = (c.exponents.array() > c.zero).count();
    if (positive > 0) {
      c.kind = positive > 1 ? MotionKind::hyperchaotic : MotionKind::chaotic;
    } else if (c.drift.change > settled_change) {
      c.kind = MotionKind::not_settled;
    } else {
      // a force that does not repeat makes a torus of a motion that attracts
      const bool is_torus = c.exponents(0) > -c.zero || !loads_repeat(*s.system);
      c.kind = is_torus ? MotionKind::quasi_periodic : MotionKind::periodic;
    }
  }

  /// Of a motion by equal steps that is no chaos: its sections alone tell whether it repeats.
  void tell_period(const Trajectory& t, ClassifyCandidate& s) const {
    Classification& c = s.found;
    if (c.kind == MotionKind::chaotic || c.kind == MotionKind::hyperchaotic) return;
    c.period =
        repeating_period(*s.system, t.sections, repeats[sure_repeats - 1], options_.longest_period);
    if (c.period > 0) c.kind = MotionKind::periodic;
  }

  /// Finds out when a motion would have settled that has not.
  void tell_what_settles(ClassifyCandidate& s) const {
    Classification& c = s.found;
    if (c.kind != MotionKind::not_settled) return;
    double more = 0.0;
    const bool touches = std::any_of(c.contacts.begin(), c.contacts.end(),
                                     [](const ContactMeasure& m) { return m.duty > 0.0; });
    if (!touches && s.system->films().empty()) {
      more = static_cast<double>(free_after(s));
    } else if (c.drift.rate > 0.0) {
      // averages change no longer, and sections repeat as well as is asked for at last
      const double reach =
          std::max(c.drift.left / settled_change,
                   c.drift.left * c.drift.spread / repeats[std::ssize(repeats) - 1]);
      more = std::max(1.0, std::log(reach) / c.drift.rate);
    }
    if (more == 0.0) return;
    c.settles_after = c.transient + options_.revolutions + static_cast<long>(std::ceil(more));
  }

  static FreeFlight& flight_of(ClassifyCandidate& s) {
    if (!s.flight) s.flight = std::make_shared<FreeFlight>(*s.system);
    return *s.flight;
  }

  /// Revolutions after which no contact can happen to a motion without any; 0: never.
  static long free_after(ClassifyCandidate& s) {
    FreeFlight& flight = flight_of(s);
    if (!flight.decays()) return 0;
    constexpr double finer = 1.1;
    MotionState state = s.found.end;
    const long first = state.revolution;
    for (double after = 1.0; after < most_flight; after = std::ceil(finer * after)) {
      flight.finish(state, first + static_cast<long>(after));
      if (flight.is_certain(state)) return static_cast<long>(after);
    }
    return 0;
  }

  /// Closes the motions to which no contact can happen any more: they are those of the linear
  /// rotor, whose transient and multipliers are known.
  void fly() {
    if (by_steps()) return;
    std::vector<OrbitCandidate> free;
    for (ClassifyCandidate* s : open_) {
      const ContactSystem& system = *s->system;
      if (!system.films().empty()) continue;
      FreeFlight& flight = flight_of(*s);
      if (!flight.is_certain(s->found.end) || !flight.decays()) continue;
      Vec exponents = system.period() * eigenvalues(first_order_matrix(system)).real();
      std::sort(exponents.begin(), exponents.end(), std::greater<>());
      if (!(exponents(0) < std::log(largest_attracting))) continue;
      free.push_back({.of = s, .period = 1, .farthest = 0.0, .y = flight.steady_state(0.0)});
      free.back().exponents = std::move(exponents);
      free.back().is_free = true;
    }
    close(free);
  }

  /// Closes the motions whose sections show a period, if it is proven.
  void search(const std::vector<Trajectory>& sections, bool is_last) {
    std::vector<OrbitCandidate> candidates;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      for (int k = 0; k < (is_last ? std::ssize(repeats) : sure_repeats); ++k) {
        const int p = repeating_period(*open_[i]->system, sections[i].sections, repeats[k],
                                       options_.longest_period);
        if (p == 0) continue;
        candidates.push_back({open_[i], p, nearby * repeats[k], open_[i]->found.end.y});
        break;
      }
    }
    find_orbits(candidates, options_.tolerance, watch(false), is_last);
    close(candidates);
  }

  /// Tells motions that repeat with forces which take longer to do so than is searched, or that do
  /// not repeat with the revolutions. Their exponents stay the means that they are.
  void search_with_forces() {
    long revolutions = 0;
    for (const ClassifyCandidate* s : open_) {
      revolutions = std::max(revolutions, s->system->repeats_after());
    }
    if (revolutions > options_.longest_period) {
      const std::vector<Trajectory> sections = go(2 * revolutions, {.sections = true});
      for (std::size_t i = 0; i < open_.size(); ++i) {
        Classification& found = open_[i]->found;
        found.period = repeating_period(*open_[i]->system, sections[i].sections,
                                        repeats[sure_repeats - 1], static_cast<int>(revolutions));
        if (found.period > 0) found.kind = MotionKind::periodic;
      }
    }
    for (ClassifyCandidate* s : open_) {
      s->found.period_time = repeating_time(*s->system, s->found.end, options_.tolerance);
      if (s->found.period_time > 0.0) s->found.kind = MotionKind::periodic;
    }
  }

  /// Puts motions on the orbits that were found, and measures these.
  void close(const std::vector<OrbitCandidate>& candidates) {
    std::vector<Trajectory> orbits;
    for (const OrbitCandidate& c : candidates) {
      MotionState on_it = c.of->found.end;
      on_it.y = c.y;
      on_it.phase = 0.0;
      on_it.contacts.clear();  // as they follow from the motion
      orbits.push_back({.system = c.of->system, .state = on_it, .revolutions = c.period});
    }
    if (orbits.empty()) return;
    integrate_mixed(orbits, {.tolerance = options_.tolerance,
                             .threads = 1,
                             .sections = options_.sections > 0,
                             .measures = true});
    for (std::size_t i = 0; i < orbits.size(); ++i) {
      if (orbits[i].outcome != Outcome::reached_end) continue;  // a border case: it stays open
      Classification& found = candidates[i].of->found;
      found.end = orbits[i].state;
      found.period = candidates[i].period;
      found.exponents = candidates[i].exponents->head(exponents_of(*candidates[i].of->system));
      found.is_free = candidates[i].is_free;
      found.residual = found.is_free
                           ? distance(*candidates[i].of->system, found.end.y, candidates[i].y)
                           : candidates[i].residual;
      found.zero = found.resolution = 0.0;
      found.is_proven = true;
      found.revolutions = found.period;
      take_measures(orbits[i], found);
      found.kind = found.period == 1 && stands_still(*candidates[i].of, options_.tolerance)
                       ? MotionKind::equilibrium
                       : MotionKind::periodic;
    }
    std::erase_if(open_, [](const ClassifyCandidate* s) { return s->found.is_proven; });
  }

  const ClassifyOptions& options_;
  std::vector<ClassifyCandidate*> open_;
  long done_ = 0;  ///< revolutions of all motions
};

}  // namespace

double Classification::impacts() const {
  double sum = 0.0;
  for (const ContactMeasure& c : contacts) sum += c.impacts;
  return sum;
}

void settle(std::span<ClassifyCandidate> motions, const ClassifyOptions& options) {
  BatchClassifier(motions, options).settle();
}

void average(std::span<ClassifyCandidate> motions, const ClassifyOptions& options) {
  BatchClassifier(motions, options).average();
}

Classification classify(const ContactSystem& system, MotionState start,
                        const ClassifyOptions& options) {
  ClassifyCandidate motion{.system = &system};
  motion.found.end = std::move(start);
  settle({&motion, 1}, options);
  ClassifyOptions rest = options;  // counts on where the transient ended
  if (options.watch) {
    rest.watch = [&](long done) { return options.watch(options.discard + done); };
  }
  average({&motion, 1}, rest);
  Classification& found = motion.found;
  if (found.is_good() && found.is_proven && found.kind == MotionKind::periodic) {
    found.period_time = repeating_time(system, found.end, options.tolerance);
  }
  return motion.found;
}

}  // namespace whirl::inline dyn

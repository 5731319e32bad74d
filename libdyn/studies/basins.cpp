#include "libdyn/studies/basins.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "libbase/numerics/random.hpp"
#include "libdyn/studies/point_runner.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double same_section = 1e-5;  ///< distance of sections [length scales]
constexpr int most_draws = 100;        ///< until a start is inside its bearings

/// Whether the last section of one orbit is any of another.
bool is_on(const ContactSystem& system, const Ending& one, const Ending& other) {
  const int size = system.size();
  const auto count = static_cast<int>(other.sections.size()) / size;
  const Eigen::Map<const Vec> last(one.sections.data(), size);
  for (int i = 0; i < count; ++i) {
    const Eigen::Map<const Vec> section(other.sections.data() + i * size, size);
    if (distance(system, last, section) < same_section) return true;
  }
  return false;
}

bool is_same(const ContactSystem& system, const Ending& a, const Ending& b) {
  if (a.kind != b.kind || a.period != b.period || a.is_proven != b.is_proven ||
      a.regimes != b.regimes) {
    return false;
  }
  return !a.is_proven || is_on(system, a, b);
}

StudyMotion motion_from(std::size_t point, const StudyModels& models,
                        const BasinsOptions& options) {
  if (!options.is_random()) return begin_motion(models, options.grid.values_at(point));
  StudyMotion motion = begin_motion(models, {});
  if (point > 0 && motion.is_good()) {
    MotionState& start = motion.subject.found.end;
    start = random_start(motion.scene->contacts, start, options.size, options.seed, point);
  }
  return motion;
}

std::vector<BasinsPoint> compute(const std::vector<std::size_t>& piece, const StudyModels& models,
                                 const BasinsOptions& options) {
  std::vector<StudyMotion> motions;
  std::vector<BasinsPoint> points;
  for (const std::size_t point : piece) {
    const StudyMotion& motion = motions.emplace_back(motion_from(point, models, options));
    points.emplace_back();
    if (motion.is_good()) points.back().start = full_state(*motion.scene, motion.subject.found.end);
  }
  classify_together(motions, options.classify);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    points[i].motion = classified(motions[i]);
    points[i].sections = motions[i].subject.found.sections;
  }
  return points;
}

Ending ending_of(BasinsPoint point) {
  Ending ending{.kind = *point.motion.kind,
                .period = point.motion.period,
                .is_proven = point.motion.is_proven,
                .regimes = {},
                .sections = std::move(point.sections)};
  for (const ContactDoing& c : point.motion.contacts) ending.regimes.push_back(c.regime);
  return ending;
}

/// Numbers the motions that the starts ended in.
void find_basins(const ContactSystem& system, BasinsResult& result) {
  AttractorNumbers numbers(system);
  result.attractor.assign(result.points.size(), failed_start);
  result.basins.clear();
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    std::optional<BasinsPoint> point = result.points[i];
    if (!point || point->motion.has_failed()) continue;
    if (point->motion.kind == MotionKind::not_settled) {
      result.attractor[i] = unsettled_start;
      continue;
    }
    result.attractor[i] = numbers.number_of(ending_of(std::move(*point)));
    const auto number = static_cast<std::size_t>(result.attractor[i]);
    if (number == result.basins.size()) result.basins.push_back({.first = i});
    ++result.basins[number].count;
  }
  const bool has_failed = std::all_of(result.attractor.begin(), result.attractor.end(),
                                      [](int number) { return number == failed_start; });
  if (has_failed || done_points(result.points) < result.points.size()) result.attractor.clear();
}

constexpr std::size_t most_starts = 64;  ///< in the lanes of one batch

}  // namespace

int AttractorNumbers::number_of(const Ending& ending) {
  const auto same = std::find_if(found_.begin(), found_.end(), [&](const Ending& known) {
    return is_same(system_, ending, known);
  });
  const auto number = static_cast<int>(same - found_.begin());
  if (same == found_.end()) found_.push_back(ending);
  return number;
}

MotionState random_start(const ContactSystem& system, const MotionState& around, double size,
                         std::uint64_t seed, std::uint64_t number) {
  std::seed_seq sequence{seed & 0xffffffffu, seed >> 32, number & 0xffffffffu, number >> 32};
  std::mt19937_64 random(sequence);
  MotionState start = around;
  for (int draw = 0; draw < most_draws; ++draw) {
    start.y = around.y;
    for (Eigen::Index i = 0; i < start.y.size(); ++i) {
      start.y(i) += size * (2.0 * random_share(random) - 1.0) * system.state_scale()(i);
    }
    if (!system.left_bearing(start.y.data())) break;
  }
  return start;
}

std::vector<int> BasinsResult::starts() const {
  std::vector<int> numbers(is_random ? points.size() : 0);
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

ColumnSizes BasinsResult::sizes() const {
  return {{"exponents", system.exponents()},
          {"full", system.dofs},
          {"sections", sections},
          {"states", system.states}};
}

namespace {

std::vector<Regime> regimes_of(const ClassifiedMotion& motion) {
  std::vector<Regime> regimes;
  for (const ContactDoing& c : motion.contacts) regimes.push_back(c.regime);
  return regimes;
}

}  // namespace

BasinShares basin_shares(const BasinsResult& result) {
  BasinShares shares{.starts = std::ssize(result.points)};
  double ended = 0.0;
  for (const auto& p : result.points) ended += p && !p->motion.has_failed() ? 1.0 : 0.0;
  for (const Basin& basin : result.basins) {
    const BasinsPoint first = result.points[basin.first].value();
    Attractor a{summary_of(first.motion)};
    a.number = std::ssize(shares.attractors);
    a.share = static_cast<double>(basin.count) / ended;
    a.impacts_per_rev = first.motion.impacts_per_rev();
    a.regimes = regimes_of(first.motion);
    a.start = {static_cast<long>(basin.first) + 1, first.start};
    shares.attractors.push_back(std::move(a));
  }
  std::stable_sort(shares.attractors.begin(), shares.attractors.end(),
                   [](const Attractor& a, const Attractor& b) { return a.share > b.share; });
  std::map<std::vector<Regime>, double> open;
  for (std::size_t i = 0; i < result.attractor.size(); ++i) {
    if (result.attractor[i] != unsettled_start) continue;
    open[regimes_of(result.points[i].value().motion)] += 1.0 / ended;
  }
  for (const auto& [regimes, share] : open) shares.unsettled.push_back({regimes, share});
  std::stable_sort(shares.unsettled.begin(), shares.unsettled.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  return shares;
}

BasinsResult basins(const StudyModels& models, const BasinsOptions& wanted,
                    const Monitor<BasinsResult>& monitor, BasinsResult earlier) {
  BasinsOptions options = wanted;
  options.classify = stopped_by(monitor.stop_asked(), wanted.classify);
  options.classify.sections = options.classify.longest_period;
  BasinsResult result = std::move(earlier);
  const auto first = models.member(options.grid.values_at(0)).scene;
  result.system = study_system(*first, options.classify);
  result.is_random = options.is_random();
  result.sections = options.classify.sections;
  result.points.resize(options.points());
  PointWork<BasinsPoint> work{
      .most_together = most_starts, .stripe = options.stripe, .threads = options.threads};
  work.compute = [&](const auto& piece, NothingGiven&) { return compute(piece, models, options); };
  work.conclude = [&] { find_basins(first->contacts, result); };
  run_points(work, result, monitor);
  if (done_points(result.points) < result.points.size()) work.conclude();  // of those that are done
  return result;
}

}  // namespace whirl::inline dyn

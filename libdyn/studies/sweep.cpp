#include "libdyn/studies/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "libbase/structs/names.hpp"
#include "libdyn/motions/support_loads.hpp"
#include "libdyn/studies/point_runner.hpp"
#include "libdyn/studies/travel.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr std::size_t carried_piece = 16, most_fresh = 64;  ///< values that go together

/// Motions of a piece that have settled, with the states in which the next ones begin.
struct Settled {
  std::vector<StudyMotion> motions;
  std::vector<SweepEnd> ends;
};

template <class Bytes>
void travel(Bytes& bytes, Is<Settled> auto& piece) {
  auto& [motions, ends] = piece;
  bytes(motions, ends);
}

/// Number of the value of a point: up, then down.
std::size_t value_of(std::size_t point, const SweepOptions& options) {
  return point < options.values.size() ? point : point - options.values.size();
}

/// Makes the scenes of motions that another process has settled.
void restore_scenes(Settled& piece, const std::vector<std::size_t>& points,
                    const StudyModels& models, const SweepOptions& options) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    StudyMotion& motion = piece.motions[i];
    if (motion.scene || motion.failure) continue;
    StudyMember member = models.member({&options.values[value_of(points[i], options)], 1});
    motion.scene = member.scene;
    motion.model = std::make_shared<const Model>(std::move(member.model));
    motion.subject.system = &motion.scene->contacts;
  }
}

/// One way along the values and back, each motion going on from the one before.
class Chain {
 public:
  Chain(const StudyModels& models, const SweepOptions& options, const PointRows<SweepPoint>& points)
      : models_(models), options_(options), points_(points), values_(options.values.size()) {}

  /// Settles the motion at a point, and finds where the next one begins.
  void go(std::size_t point, Settled& piece) {
    const auto from = before(point);
    if (from && last_ != from) end_ = points_[*from].value_or(SweepPoint{}).end;
    const bool goes_on = from && end_.displacement.size() > 0 && end_.displacement.allFinite();
    StudyMotion motion = begin_motion(models_, {&options_.values[value_of(point, options_)], 1},
                                      goes_on ? &end_ : nullptr, end_.revolution);
    last_ = point;
    end_ = end_of(motion);
    piece.motions.push_back(std::move(motion));
    piece.ends.push_back(end_);
  }

 private:
  /// The point whose end a point starts from; none for the first.
  std::optional<std::size_t> before(std::size_t point) const {
    if (point == 0) return std::nullopt;
    if (point < values_) return point - 1;
    return point == 2 * values_ - 1 ? values_ - 1 : point + 1;
  }

  /// Settles a motion and says where the next one begins; nowhere if it fails.
  SweepEnd end_of(StudyMotion& motion) const {
    if (motion.failure) return {};
    settle({&motion.subject, 1}, options_.classify);
    const Classification& found = motion.subject.found;
    if (!found.is_good()) return {};
    Trajectory on{.system = motion.subject.system, .state = found.end};
    on.revolutions = found.is_proven ? 0 : options_.classify.revolutions;
    if (on.revolutions > 0) {
      integrate_single(
          on, {.tolerance = options_.classify.tolerance, .watch = options_.classify.watch});
    }
    if (on.outcome != Outcome::reached_end) return {};
    const bool is_same_again = on.system->repeats_after() == 1;
    return {full_state(*motion.scene, on.state), is_same_again ? 0 : on.state.revolution};
  }

  const StudyModels& models_;
  const SweepOptions& options_;
  const PointRows<SweepPoint>& points_;
  std::size_t values_;
  std::optional<std::size_t> last_;
  SweepEnd end_;  ///< of the last motion
};

/// Motions that begin at the start of their models, settled.
Settled settle_fresh(const StudyModels& models, const SweepOptions& options,
                     const std::vector<std::size_t>& piece) {
  Settled settled{.motions = {}, .ends = std::vector<SweepEnd>(piece.size())};
  for (const std::size_t point : piece) {
    settled.motions.push_back(begin_motion(models, {&options.values[point], 1}));
  }
  together(settled.motions,
           [&](std::span<ClassifyCandidate> good) { settle(good, options.classify); });
  return settled;
}

/// Tells settled motions apart and portrays them.
std::vector<SweepPoint> finish(Settled& piece, const SweepOptions& options) {
  together(piece.motions,
           [&](std::span<ClassifyCandidate> good) { average(good, options.classify); });
  std::vector<SweepPoint> points;
  for (std::size_t i = 0; i < piece.motions.size(); ++i) {
    const StudyMotion& motion = piece.motions[i];
    SweepPoint& point = points.emplace_back();
    point.motion = classified(motion);
    if (!motion.is_good()) continue;
    point.end = piece.ends[i];
    point.portrait =
        portrait_of(*motion.model, *motion.scene, motion.subject.found, options.classify.sections,
                    options.classify.tolerance, options.portrait);
  }
  return points;
}

/// Stretches of values, up and then down.
std::vector<std::vector<std::size_t>> carried_pieces(std::size_t values) {
  std::vector<std::vector<std::size_t>> pieces;
  for (const bool is_up : {true, false}) {
    for (std::size_t k = 0; k < values; ++k) {
      if (k % carried_piece == 0) pieces.emplace_back();
      pieces.back().push_back(is_up ? k : 2 * values - 1 - k);
    }
  }
  return pieces;
}

}  // namespace

std::vector<std::string> SweepResult::ways() const {
  if (start == SweepStart::fresh) return {"fresh"};
  return {"up", "down"};
}

Vec SweepResult::orders() const {
  return spectrum_revolutions > 0 ? portrait_orders(spectrum_revolutions) : Vec();
}

Vec SweepResult::sectors() const {
  return spectrum_revolutions > 0 ? portrait_sectors() : Vec();
}

ColumnSizes SweepResult::sizes() const {
  return {{"exponents", system.exponents()}, {"full", system.dofs}, {"sections", sections}};
}

Vec SweepResult::probe_orders() const {
  const bool has_spectra = spectrum_revolutions > 0 && probes.size() > 0;
  return has_spectra ? dyn::probe_orders(spectrum_revolutions) : Vec();
}

bool SweepResult::leaves_out(std::string_view column) const {
  if (column == "probe_poincare") return probes.size() == 0;
  if (column.starts_with("probe_")) return probes.size() == 0 || spectrum_revolutions == 0;
  if (column == "end_revolution") {
    for (const auto& p : points) {
      if (p && p->end.revolution != 0) return false;
    }
    return true;
  }
  if (column.starts_with("support")) return spectrum_revolutions == 0 || supports.empty();
  if (column == "contact_angle") return spectrum_revolutions == 0 || system.contacts.empty();
  return spectrum_revolutions == 0 && (column == "max_radius" || column == "spectrum");
}

std::optional<SweepPoint> SweepWay::point(std::size_t k) const {
  return sweep.points[way * size() + index(k)];
}

std::vector<SweepEntry> SweepWay::entries() const {
  std::vector<SweepEntry> entries;
  for (std::size_t k = 0; k < size(); ++k) {
    const std::optional<SweepPoint> p = point(k);
    if (!p) continue;
    SweepEntry entry{summary_of(p->motion), values[index(k)], {}, p->motion.impacts_per_rev()};
    const Portrait& seen = p->portrait;
    entry.probe_mean.assign(seen.probe_mean.begin(), seen.probe_mean.end());
    entry.probe_peak_to_peak.assign(seen.probe_peak_to_peak.begin(), seen.probe_peak_to_peak.end());
    entry.support_largest.assign(seen.support_largest.begin(), seen.support_largest.end());
    if (const Mat& x = p->portrait.poincare_x; x.rows() > 0) {
      std::copy_if(x.row(0).begin(), x.row(0).end(), std::back_inserter(entry.poincare),
                   [](double section) { return std::isfinite(section); });
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<TouchRange> touch_ranges(const SweepWay& way) {
  // points stand in rows of columns: each is put together once
  std::vector<std::vector<std::optional<Regime>>> regimes(
      way.sweep.system.contacts.size(), std::vector<std::optional<Regime>>(way.size()));
  for (std::size_t k = 0; k < way.size(); ++k) {
    const auto point = way.point(k);
    if (!point || point->motion.has_failed()) continue;
    for (std::size_t i = 0; i < regimes.size(); ++i) {
      regimes[i][k] = point->motion.contacts[i].regime;
    }
  }
  std::vector<TouchRange> ranges;
  for (std::size_t i = 0; i < regimes.size(); ++i) {
    const auto touches = [&](std::size_t k) {
      return k < way.size() && regimes[i][k].value_or(Regime::none) != Regime::none;
    };
    const auto is_free = [&](std::size_t k) {
      return k < way.size() && regimes[i][k] == Regime::none;
    };
    for (std::size_t k = 0; k < way.size(); ++k) {
      if (!touches(k)) continue;
      TouchRange range{.contact = i,
                       .from = k,
                       .to = k,
                       .begins = k > 0 && is_free(k - 1),
                       .is_permanent = true};
      for (; touches(k); ++k) {
        range.to = k;
        range.is_permanent = range.is_permanent && regimes[i][k] == Regime::permanent;
      }
      range.ends = is_free(k);
      ranges.push_back(range);
    }
  }
  return ranges;
}

SweepResult sweep(const StudyModels& models, const SweepOptions& wanted,
                  const Monitor<SweepResult>& monitor, SweepResult earlier) {
  SweepOptions options = wanted;
  options.classify = stopped_by(monitor.stop_asked(), wanted.classify);
  SweepResult result = std::move(earlier);
  const StudyMember first = models.member({options.values.data(), 1});
  result.system = study_system(*first.scene, options.classify);
  result.probes = ProbeLabels(first.scene->assembler.structure().probes);
  result.supports.clear();
  for (const auto& part : SupportLoads::parts_of(first.model, first.scene->assembler)) {
    result.supports.push_back(named(part.kind, part.name));
  }
  result.start = options.start;
  result.sections = options.classify.sections;
  result.spectrum_revolutions = options.portrait.spectrum_revolutions;
  result.stations.clear();
  for (const NamedPoint& p : options.portrait.stations) result.stations.push_back(p.label());
  result.points.resize(result.ways().size() * options.values.size());

  if (options.start == SweepStart::fresh) {
    PointWork<SweepPoint> work{
        .most_together = most_fresh, .stripe = options.stripe, .threads = options.threads};
    work.compute = [&](const auto& piece, NothingGiven&) {
      Settled settled = settle_fresh(models, options, piece);
      return finish(settled, options);
    };
    run_points(work, result, monitor);
    return result;
  }
  Chain chain(models, options, result.points);
  PointWork<SweepPoint, Settled> work{.pieces = carried_pieces(options.values.size()),
                                      .threads = options.threads};
  work.prepare = [&](const auto& piece) {
    Settled settled;
    for (const std::size_t point : piece) chain.go(point, settled);
    return settled;
  };
  work.compute = [&](const auto& piece, Settled& settled) {
    restore_scenes(settled, piece, models, options);
    return finish(settled, options);
  };
  run_points(work, result, monitor);
  return result;
}

}  // namespace whirl::inline dyn

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/numerics/constants.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/short_spectra.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr Eigen::Index least_window = 16, most_window = 64;  ///< revolutions of a spectrum
constexpr Eigen::Index windows = 8;      ///< that the motion has room for, one after another
constexpr Eigen::Index most_lines = 40;  ///< spectra, which overlap

/// Of a station, or nothing if the motion is too short for spectra to tell something.
ShortSpectra short_time_spectra(const RecordedMotion& m, const Vec& x, const Vec& y) {
  ShortSpectra s;
  const Eigen::Index window = std::clamp(m.time.size() / windows, least_window * m.per_revolution,
                                         most_window * m.per_revolution);
  if (m.time.size() < 2 * window) return s;
  s.count = even_smooth_length(window);
  const Eigen::Index room = m.time.size() - s.count;
  const Eigen::Index lines = std::min(most_lines, 1 + 4 * room / s.count);
  s.amplitude.resize(lines, s.count);
  const double spacing =
      (m.time(m.time.size() - 1) - m.time(0)) / static_cast<double>(m.time.size() - 1);
  for (Eigen::Index i = 0; i < lines; ++i) {
    const Eigen::Index from = lines > 1 ? i * room / (lines - 1) : 0;
    add_spectrum(x, y, from, spacing, i, s);
    s.place.push_back(0.5 * (m.time(from) + m.time(from + s.count - 1)));
  }
  return s;
}

/// One place's spectra; nothing if there is nothing to be seen.
std::optional<Figure> waterfall(const ResultView& result, const RecordedMotion& m,
                                const SpectraPlace& place, const Vec& x, const Vec& y) {
  const DisplayUnit in = result.frequency;
  const ShortSpectra s = short_time_spectra(m, x, y);
  const double largest = s.place.empty() ? 0.0 : s.amplitude.maxCoeff();
  if (!(largest > 0.0)) return std::nullopt;
  Figure f{.variant = place.name, .probes = place.probes};
  f.width = 760.0;
  f.height = 680.0;
  f.subtitle = fmt::format("{}: waterfall of {}{}{}", place.name,
                           place.is_probe() ? "spectra" : "full spectra", at_speeds(result),
                           place.is_probe() ? ", peak to peak" : ", backward left, forward right");
  const double speed = speed_of(result);
  double reach = 1.15 * reach_of(s);
  if (m.spins) reach = std::max(reach, 2.2 * speed);
  reach = std::min(reach, s.bin * static_cast<double>(s.count) / 2.0);
  Panel p;
  p.cursor = "frequency";
  p.x = {.title = with_unit(place.is_probe() ? "frequency" : "whirl frequency", in),
         .first = place.is_probe() ? 0.0 : -reach * in.factor,
         .last = reach * in.factor};
  if (m.spins) p.x.also_unit = "X", p.x.also_factor = 1.0 / (in.factor * speed);
  p.y.title = "time [s]";
  const DisplayUnit unit = place.unit.value_or(unit_for(largest, "m"));
  add_curves(s, in, unit, place, reach, 1.0, p);
  p.rules.push_back({Rule::Kind::vertical, 0.0, "", Paint::ink, Dash::dotted});
  for (const double order : {-1.0, 1.0}) {
    if (!m.spins || (place.is_probe() && order < 0.0)) continue;
    const char* name = place.is_probe() ? "1X" : order > 0.0 ? "+1X" : "−1X";
    p.rules.push_back(
        {Rule::Kind::vertical, order * speed * in.factor, name, Paint::gray, Dash::dotted});
  }
  f.panels.push_back(std::move(p));
  f.notes = {fmt::format("Each spectrum is of {:.3g} s, around its time. ", turn / s.bin) +
             heights_text(place, unit, largest)};
  return f;
}

std::vector<Figure> waterfall_figures(const ResultView& result) {
  const Motion m(result);
  constexpr std::size_t most_figures = 4;  // of each kind
  std::vector<Figure> figures;
  for (const ProbeSignal& probe : m.record.probes) {
    if (!is_drawn(result, probe)) continue;
    constexpr double circles = 4.0;  // a cosine is two of half its amplitude
    const SpectraPlace place{probe_name(probe), {probe.name}, circles, unit_of(probe)};
    const Vec none = Vec::Zero(probe.displacement.size());
    if (auto f = waterfall(result, m, place, probe.displacement, none)) {
      figures.push_back(std::move(*f));
    }
    if (figures.size() == most_figures) break;
  }
  const std::size_t of_probes = figures.size();
  for (const std::size_t station : stations_by_interest(result, m.stations)) {
    const StationMotion& motion = m.record.stations[station];
    if (auto f = waterfall(result, m, {m.stations[station]}, motion.x, motion.y)) {
      figures.push_back(std::move(*f));
    }
    if (figures.size() == of_probes + most_figures) break;
  }
  return figures;
}

/// A speed that changes: instead of straight rules its own course, either way.
void follow_speed(const std::vector<double>& turns, const DisplayUnit& in, Panel& p) {
  p.rules.resize(1);
  for (const double sense : {-1.0, 1.0}) {
    Curve c{.name = "1X", .paint = Paint::gray};
    c.dash = Dash::dotted;
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
      c.x.push_back(sense * in.factor * turn / (turns[i + 1] - turns[i]));
      c.y.push_back(0.5 * (turns[i] + turns[i + 1]));
    }
    p.curves.push_back(std::move(c));
  }
}

/// The unit of all probes of a record; nothing where they differ.
std::optional<DisplayUnit> shared_unit(const std::vector<ProbeLabel>& probes) {
  const bool is_one = !probes.empty() && std::all_of(probes.begin(), probes.end(), [&](auto& p) {
    return p.unit == probes.front().unit;
  });
  return is_one ? std::optional(unit_of(probes.front())) : std::nullopt;
}

std::vector<Figure> measured_waterfall_figures(const ResultView& result) {
  const auto& record = result_of<StationRecord>(result);
  const auto unit = shared_unit(result_of<MeasuredIdentification>(result).probes);
  const double speed = speed_of(result);
  RecordedMotion m{.time = record.time};
  if (m.time.size() < 2) return {};
  const double spacing =
      (m.time(m.time.size() - 1) - m.time(0)) / static_cast<double>(m.time.size() - 1);
  m.spins = speed > 0.0;
  m.period = m.spins ? turn / speed : 1.0;
  m.per_revolution = std::max<Eigen::Index>(1, std::lround(m.period / spacing));
  std::vector<Figure> figures;
  for (const StationMotion& s : record.stations) {
    if (s.x.size() != m.time.size() || s.y.size() != m.time.size()) {
      throw FileError("the measured motion is not of its times");
    }
    auto f = waterfall(result, m, {.name = s.station, .unit = unit}, s.x, s.y);
    if (!f) continue;
    if (!record.turns.empty()) follow_speed(record.turns, result.frequency, f->panels.front());
    figures.push_back(std::move(*f));
  }
  return figures;
}

}  // namespace

FigureKind measured_waterfall_kind() {
  return {
      .name = "measured_waterfall",
      .title = "Measured waterfall",
      .summary = "full spectra of a record one after another in time, with the course of the speed",
      .needs = {dataset_of<StationRecord>(&StationMotion::x)},
      .make = measured_waterfall_figures,
  };
}

FigureKind waterfall_kind() {
  return {
      .name = "waterfall",
      .title = "Waterfall",
      .summary = "full spectra one after another in time, one above the other",
      .needs = {dataset_of<MotionRecord>(&StationMotion::x)},
      .make = waterfall_figures,
  };
}

}  // namespace whirl::inline io

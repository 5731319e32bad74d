#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/spectrum.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr Eigen::Index least_window = 16, most_window = 64;  ///< revolutions of a spectrum
constexpr Eigen::Index windows = 8;       ///< that the motion has room for, one after another
constexpr Eigen::Index most_lines = 40;   ///< spectra, which overlap
constexpr std::size_t most_told = 20000;  ///< points with a text each, for the size of pages
constexpr double powers = 3.0;            ///< of ten that a height shows: 1X would hide all else

/// Spectra of parts of a motion, with the middles of these parts.
struct ShortTimeSpectra {
  std::vector<double> time;  ///< [s], ascending
  double bin = 0.0;          ///< [rad/s]
  Eigen::Index count = 0;    ///< lines of a spectrum
  Mat amplitude;             ///< time x lines from -count / 2 to count / 2 - 1 [m]

  double frequency(Eigen::Index line) const { return bin * static_cast<double>(line - count / 2); }
};

/// Of a station, or nothing if the motion is too short for spectra to tell something.
ShortTimeSpectra short_time_spectra(const RecordedMotion& m, const Vec& x, const Vec& y) {
  ShortTimeSpectra s;
  const Eigen::Index window = std::clamp(m.time.size() / windows, least_window * m.per_revolution,
                                         most_window * m.per_revolution);
  if (m.time.size() < 2 * window) return s;
  s.count = static_cast<Eigen::Index>(smooth_length(static_cast<long>(window)) / 2 * 2);
  while (s.count > 2 && smooth_length(static_cast<long>(s.count)) != s.count) s.count -= 2;
  const Eigen::Index room = m.time.size() - s.count;
  const Eigen::Index lines = std::min(most_lines, 1 + 4 * room / s.count);
  s.amplitude.resize(lines, s.count);
  const double spacing =
      (m.time(m.time.size() - 1) - m.time(0)) / static_cast<double>(m.time.size() - 1);
  for (Eigen::Index i = 0; i < lines; ++i) {
    const Eigen::Index from = lines > 1 ? i * room / (lines - 1) : 0;
    CVec z(s.count);
    z.real() = x.segment(from, s.count);
    z.imag() = y.segment(from, s.count);
    z.array() -= z.mean();
    const Spectrum spectrum = hann_spectrum(z, spacing);
    s.bin = spectrum.bin;
    s.amplitude.row(i) = spectrum.ascending().cwiseAbs().transpose();
    s.time.push_back(0.5 * (m.time(from) + m.time(from + s.count - 1)));
  }
  return s;
}

/// The largest magnitude of a frequency with more than a thousandth of the largest amplitude.
double reach_of(const ShortTimeSpectra& s) {
  const Vec most = s.amplitude.colwise().maxCoeff().transpose();
  const double least = 1e-3 * most.maxCoeff();
  double reach = 0.0;
  for (Eigen::Index k = 0; k < s.count; ++k) {
    if (most(k) > least) reach = std::max(reach, std::abs(s.frequency(k)));
  }
  return reach;
}

/// What spectra are drawn of.
struct WaterfallPlace {
  std::string name;
  std::vector<std::string> probes{};  ///< the one that it is of
  double factor = 1.0;                ///< of the circles at both signs of a frequency
  std::optional<DisplayUnit> unit{};  ///< nothing: by the largest number

  bool is_probe() const { return !probes.empty(); }
};

/// Curves of the spectra, one above the other.
void add_spectra(const ShortTimeSpectra& s, const DisplayUnit& in, const DisplayUnit& unit,
                 const WaterfallPlace& place, double reach, Panel& p) {
  const double largest = s.amplitude.maxCoeff();
  const double range = s.time.back() - s.time.front();
  const double height = (range > 0.0 ? range : 1.0) * 0.09;
  for (std::size_t i = 0; i < s.time.size(); ++i) {
    Curve c{.paint = i % 2 == 0 ? Paint::forward : Paint::ink};
    c.width = 0.9;
    for (Eigen::Index k = place.is_probe() ? s.count / 2 : 0; k < s.count; ++k) {
      if (std::abs(s.frequency(k)) > 1.02 * reach) continue;
      const double a = s.amplitude(static_cast<Eigen::Index>(i), k);
      c.x.push_back(in.factor * s.frequency(k));
      c.y.push_back(s.time[i] +
                    height *
                        (a > 0.0 ? std::max(0.0, 1.0 + std::log10(a / largest) / powers) : 0.0));
      c.hover.push_back(fmt::format("{:.3g} {}", place.factor * unit.factor * a, unit.name));
    }
    if (s.time.size() * c.x.size() > most_told) c.hover.clear();
    p.curves.push_back(std::move(c));
  }
}

/// One place's spectra; nothing if there is nothing to be seen.
std::optional<Figure> waterfall(const ResultView& result, const RecordedMotion& m,
                                const WaterfallPlace& place, const Vec& x, const Vec& y) {
  const DisplayUnit in = result.frequency;
  const ShortTimeSpectra s = short_time_spectra(m, x, y);
  const double largest = s.time.empty() ? 0.0 : s.amplitude.maxCoeff();
  if (!(largest > 0.0)) return std::nullopt;
  Figure f{.variant = place.name, .probes = place.probes};
  f.width = 760.0;
  f.height = 680.0;
  f.subtitle = fmt::format("{}: waterfall of {}{}{}", place.name,
                           place.is_probe() ? "spectra" : "full spectra", at_speed(result),
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
  add_spectra(s, in, unit, place, reach, p);
  p.rules.push_back({Rule::Kind::vertical, 0.0, "", Paint::ink, Dash::dotted});
  for (const double order : {-1.0, 1.0}) {
    if (!m.spins || (place.is_probe() && order < 0.0)) continue;
    const char* name = place.is_probe() ? "1X" : order > 0.0 ? "+1X" : "−1X";
    p.rules.push_back(
        {Rule::Kind::vertical, order * speed * in.factor, name, Paint::gray, Dash::dotted});
  }
  f.panels.push_back(std::move(p));
  f.notes = {
      fmt::format("Each spectrum is of {:.3g} s, around its time. Heights are "
                  "logarithmic: from {:.3g} {}, the largest {}, down to a thousandth "
                  "of it.",
                  turn / s.bin, place.factor * unit.factor * largest, unit.name,
                  place.is_probe() ? "reading, peak to peak" : "radius")};
  return f;
}

std::vector<Figure> waterfall_figures(const ResultView& result) {
  const Motion m(result);
  constexpr std::size_t most_figures = 4;  // of each kind
  std::vector<Figure> figures;
  for (const ProbeSignal& probe : m.record.probes) {
    if (!is_drawn(result, probe)) continue;
    constexpr double circles = 4.0;  // a cosine is two of half its amplitude
    const WaterfallPlace place{probe_name(probe), {probe.name}, circles, unit_of(probe)};
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

std::vector<Figure> measured_waterfall_figures(const ResultView& result) {
  const auto& record = result_of<StationRecord>(result);
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
    auto f = waterfall(result, m, {s.station}, s.x, s.y);
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

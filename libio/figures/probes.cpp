#include "libio/figures/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/spectrum.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io::figures {

namespace {

constexpr double seen_of_probes = 8.0;               ///< revolutions, at first
constexpr double bar_begins = 1.12, bar_ends = 1.4;  ///< ends of a probe over the size of an orbit
constexpr double seen_share = 1e-3;  ///< of the largest line: below, a line is not looked at

/// What a probe reads, as lines of a spectrum without the mean.
struct ProbeLines {
  std::vector<double> frequency;     ///< 0 or more [rad/s]
  std::vector<double> peak_to_peak;  ///< [m]
};

/// Of whole revolutions, so that harmonics of the speed are lines: the last ones, as
/// ResponseSpectra.
ProbeLines lines_of(const RecordedMotion& motion, const Vec& reading) {
  ProbeLines lines;
  const long revolutions = smooth_length(reading.size() / motion.per_revolution);
  const Eigen::Index count = revolutions * motion.per_revolution;
  if (count < 4) return lines;
  const Vec used = reading.tail(count);
  const Vec centered = used.array() - used.mean();
  const Spectrum spectrum =
      hann_spectrum(centered.cast<Complex>(), motion.time(1) - motion.time(0));
  for (Eigen::Index k = 0; k < count / 2; ++k) {
    lines.frequency.push_back(static_cast<double>(k) * spectrum.bin);
    // a cosine is two circles of half its amplitude
    lines.peak_to_peak.push_back((k == 0 ? 2.0 : 4.0) * std::abs(spectrum.at(k)));
  }
  return lines;
}

/// How far a spectrum is worth seeing.
double reach_of(const ProbeLines& lines, double speed) {
  const double least = seen_share * largest_of(lines.peak_to_peak);
  double reach = std::isfinite(speed) ? 2.2 * speed : 0.0;
  for (std::size_t k = 0; k < lines.frequency.size(); ++k) {
    if (lines.peak_to_peak[k] > least) reach = std::max(reach, 1.15 * lines.frequency[k]);
  }
  return reach;
}

}  // namespace

DisplayUnit unit_of(const ProbeLabel& probe) {
  const auto one = parse_as("1 " + probe.unit, "m");
  if (!one) throw FileError(fmt::format("the unit of probe {}: {}", probe.name, one.problem));
  return {probe.unit, 1.0 / *one};
}

std::string probe_name(const ProbeLabel& probe) {
  return fmt::format("{}, {:g}°{}", probe.name, probe.angle_deg(),
                     probe.is_axial() ? " along z" : "");
}

bool is_drawn(const ResultView& result, const ProbeLabel& probe) {
  return result.probe.empty() || result.probe == probe.name;
}

std::vector<std::size_t> drawn_probes(const ResultView& result, const ProbeLabels& probes) {
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (is_drawn(result, probes[i])) drawn.push_back(i);
  }
  return drawn;
}

const Probe* probe_of(const ResultView& result, const std::string& name) {
  if (!result.model) return nullptr;
  const std::vector<Probe>& all = result.model->structure.probes;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Probe& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<Figure> probe_histories(const ResultView& result) {
  const Motion m(result);
  const MotionSamples drawn = m.drawn(seen_of_probes);
  Figure f{.variant = "probes"};
  f.subtitle = fmt::format("Along the probes: time history{}", at_speed(result));
  for (const ProbeSignal& probe : m.record.probes) {
    if (!is_drawn(result, probe)) continue;
    f.probes.push_back(probe.name);
    const DisplayUnit unit = unit_of(probe);
    Panel p;
    m.show_over_time(p, seen_of_probes);
    p.y.title = with_unit(probe_name(probe), unit);
    Curve c{.paint = Paint::series, .x = numbers(m.time, drawn)};
    c.y = scaled(numbers(probe.displacement, drawn), unit.factor);
    c.width = 1.3;
    p.curves.push_back(std::move(c));
    f.panels.push_back(std::move(p));
  }
  if (f.panels.empty()) return {};
  f.height = 90.0 + 170.0 * static_cast<double>(f.panels.size());
  if (f.panels.size() == 1) f.height = 320.0;
  f.notes = m.time_notes(seen_of_probes);
  return {f};
}

namespace {

/// What a probe reads once a revolution: in time, and each over the one before.
Figure section_of(const ResultView& result, const Motion& m, const ProbeSignal& probe) {
  const DisplayUnit unit = unit_of(probe);
  Figure f{.variant = probe_name(probe), .probes = {probe.name}};
  f.width = 900.0;
  f.columns = 2;
  f.subtitle = fmt::format("{}: once a revolution at {}", f.variant, speed_text(result));
  Panel in_time, next;
  in_time.title = "once a revolution";
  next.title = "from one revolution to the next";
  in_time.x.title = "time [s]";
  in_time.cursor = "time";
  in_time.y.title = next.x.title = with_unit("reading", unit);
  next.y.title = with_unit("reading a revolution later", unit);
  Curve c{.paint = Paint::forward, .has_line = false};
  c.has_marker = true;
  c.size = 4.0;
  Curve after = c;
  constexpr double all_revolutions = 1e9;
  const MotionSamples drawn = m.drawn(all_revolutions);
  for (Eigen::Index j = drawn.first; j <= drawn.last; ++j) {
    if (!m.ends_revolution(j)) continue;
    c.x.push_back(m.time(j));
    c.y.push_back(unit.factor * probe.displacement(j));
  }
  for (std::size_t j = 0; j + 1 < c.y.size(); ++j) {
    after.x.push_back(c.y[j]);
    after.y.push_back(c.y[j + 1]);
  }
  const double far = unit.factor * probe.displacement.cwiseAbs().maxCoeff();
  keep_room(in_time.y, c.y, 1e-3 * far);
  keep_room(next.x, after.x, 1e-3 * far);
  keep_room(next.y, after.y, 1e-3 * far);
  Curve diagonal{.paint = Paint::gray, .x = {-2.0 * far, 2.0 * far}, .y = {-2.0 * far, 2.0 * far}};
  diagonal.width = 1.0;
  diagonal.dash = Dash::dashed;
  diagonal.is_key = false;
  f.notes = {fmt::format("{} revolutions.", c.y.size())};
  if (result.window.is_given()) f.notes = m.notes(all_revolutions);
  in_time.curves = {std::move(c)};
  next.curves = {std::move(diagonal), std::move(after)};
  f.panels = {std::move(in_time), std::move(next)};
  return f;
}

}  // namespace

std::vector<Figure> probe_sections(const ResultView& result) {
  const Motion m(result);
  std::vector<Figure> figures;
  for (const ProbeSignal& probe : m.record.probes) {
    if (!m.spins || !is_drawn(result, probe)) continue;
    Figure f = section_of(result, m, probe);
    if (!f.panels.front().curves.front().x.empty()) figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> probe_spectra(const ResultView& result) {
  const Motion m(result);
  const double speed = speed_of(result);
  const DisplayUnit in = result.frequency;
  std::vector<Figure> figures;
  std::vector<std::string> units;
  for (const ProbeSignal& probe : m.record.probes) {
    if (!is_drawn(result, probe)) continue;
    const ProbeLines lines = lines_of(m, probe.displacement);
    if (!(largest_of(lines.peak_to_peak) > 0.0)) continue;
    const DisplayUnit unit = unit_of(probe);
    auto known = std::find(units.begin(), units.end(), unit.name);
    if (known == units.end()) {
      known = units.insert(units.end(), unit.name);
      Figure f{.variant = "probes in " + unit.name, .width = 860.0, .height = 430.0};
      f.subtitle = fmt::format("Along the probes: spectrum{}, peak to peak", at_speed(result));
      Panel p;
      p.cursor = "frequency";
      p.x = {.title = with_unit("frequency", in), .first = 0.0, .last = 0.0};
      p.y = {.title = with_unit("peak to peak", unit), .first = 0.0};
      if (speed > 0.0) {
        p.x.also_unit = "X", p.x.also_factor = 1.0 / (in.factor * speed);
        p.rules.push_back(
            {Rule::Kind::vertical, speed * in.factor, "1X", Paint::gray, Dash::dotted});
      }
      f.panels.push_back(std::move(p));
      figures.push_back(std::move(f));
    }
    Figure& shown = figures[static_cast<std::size_t>(known - units.begin())];
    shown.probes.push_back(probe.name);
    Panel& p = shown.panels.front();
    Curve c{.name = probe_name(probe), .paint = series_paint(p.curves.size())};
    c.x = scaled(lines.frequency, in.factor);
    c.y = scaled(lines.peak_to_peak, unit.factor);
    c.width = 1.2;
    p.x.last = std::max(p.x.last, std::min(reach_of(lines, speed) * in.factor, c.x.back()));
    p.curves.push_back(std::move(c));
  }
  if (figures.size() == 1) figures.front().variant = "probes";
  return figures;
}

std::vector<Probe> probes_at(const ResultView& result, const std::string& station) {
  std::vector<Probe> there;
  if (!result.model || !result.assembler) return there;
  for (const Probe& probe : result.model->structure.probes) {
    if (!probe.is_axial() && is_at(result, probe.at, station)) there.push_back(probe);
  }
  return there;
}

void add_probes(const std::vector<Probe>& probes, double size, double factor, Panel& panel) {
  for (const Probe& probe : probes) {
    const double c = factor * size * std::cos(probe.angle),
                 s = factor * size * std::sin(probe.angle);
    Curve line{.name = "probe", .paint = Paint::stator};
    line.width = 3.0;
    line.x = {bar_begins * c, bar_ends * c};
    line.y = {bar_begins * s, bar_ends * s};
    line.hover.assign(2, probe_name(probe));
    panel.curves.push_back(std::move(line));
    const bool is_left = c < 0.0;  // names stand towards the middle
    panel.labels.push_back({bar_ends * c, bar_ends * s, probe.name,
                            is_left ? Anchor::start : Anchor::end, is_left ? 6.0 : -6.0,
                            s < 0.0 ? 12.0 : -4.0, Paint::stator});
  }
}

}  // namespace whirl::inline io::figures

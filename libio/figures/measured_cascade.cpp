// Spectra along the speed of a run-up or coast-down: full spectra of stations, spectra of probes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/numerics/constants.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/short_spectra.hpp"
#include "libio/figures/turned_motion.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double least_of_part = 16.0, most_of_part = 32.0;  ///< of a spectrum
constexpr double parts_of_run_up = 16.0;  ///< that the motion has room for, one after another
constexpr std::size_t most_spectra = 40;

/// Spectra where the rotor first has speeds at equal steps.
std::optional<ShortSpectra> spectra_over_speed(const DrawnMotion& m, const Vec& x, const Vec& y) {
  const Vec& time = m.motion.time;
  const double spacing = m.motion.spacing();
  const double per_revolution = turn / (m.motion.clock.mean_speed() * spacing);
  const auto all = static_cast<double>(time.size());
  const double wanted = std::clamp(all / parts_of_run_up, least_of_part * per_revolution,
                                   most_of_part * per_revolution);
  if (!(wanted < 0.5 * all)) return std::nullopt;
  ShortSpectra s;
  s.count = even_smooth_length(static_cast<Eigen::Index>(wanted));
  if (s.count < 8 || time.size() < 2 * s.count) return std::nullopt;
  std::vector<Eigen::Index> starts;
  for (std::size_t k = 0; k < most_spectra; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(most_spectra - 1);
    const double speed = m.slowest + part * (m.fastest - m.slowest);
    const double middle = (moment_of_speed(m.motion.clock, speed) - time(0)) / spacing;
    const auto from =
        std::clamp<Eigen::Index>(std::lround(middle) - s.count / 2, 0, time.size() - s.count);
    if (!starts.empty() && from == starts.back()) continue;  // at the ends
    const double at =
        std::clamp(time(from + s.count / 2), m.motion.clock.first(), m.motion.clock.last());
    const double there = m.motion.clock.speed(at);
    if (!s.place.empty() && there <= s.place.back()) continue;
    starts.push_back(from);
    s.place.push_back(there);
  }
  s.amplitude.resize(std::ssize(starts), s.count);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    add_spectrum(x, y, starts[i], spacing, static_cast<Eigen::Index>(i), s);
  }
  return s;
}

/// Lines along which a frequency is a multiple of the speed.
void add_orders(double reach, double fastest, const DisplayUnit& in, bool is_full, Panel& p) {
  for (const double order : {0.5, 1.0, 2.0, 3.0}) {
    if (order > 1.0 && order * fastest > 1.2 * reach) continue;
    for (const double sense : {1.0, -1.0}) {
      if (sense < 0.0 && !is_full) continue;
      const char* sign = sense < 0.0 ? "−" : is_full ? "+" : "";
      p.rules.push_back({Rule::Kind::slope, sense / (in.factor * order * speed_unit().size),
                         fmt::format("{}{:g}X", sign, order), Paint::gray, Dash::dotted});
    }
  }
}

std::optional<Figure> cascade_of(const ResultView& result, const DrawnMotion& m,
                                 const SpectraPlace& place, const Vec& x, const Vec& y) {
  const auto s = spectra_over_speed(m, x, y);
  const double largest = s ? s->amplitude.maxCoeff() : 0.0;
  if (!(largest > 0.0)) return std::nullopt;
  const DisplayUnit in = result.frequency;
  const DisplayUnit unit = place.unit.value_or(unit_for(largest, "m"));
  Figure f{.variant = place.name, .probes = place.probes, .width = 760.0, .height = 680.0};
  f.subtitle =
      fmt::format("{}: {}", place.name,
                  place.is_probe() ? "spectra over speed, peak to peak"
                                   : "full spectra over speed, backward left, forward right");
  double reach = std::max(1.15 * reach_of(*s), 2.2 * m.fastest);
  reach = std::min(reach, s->bin * static_cast<double>(s->count) / 2.0);
  Panel p;
  p.cursor = "frequency";
  p.x = {.title = with_unit(place.is_probe() ? "frequency" : "whirl frequency", in),
         .first = place.is_probe() ? 0.0 : -reach * in.factor,
         .last = reach * in.factor};
  p.y.title = shown_heading("speed", "rpm");
  add_curves(*s, in, unit, place, reach, 1.0 / speed_unit().size, p);
  p.rules.push_back({Rule::Kind::vertical, 0.0, "", Paint::ink, Dash::dotted});
  add_orders(reach, m.fastest, in, !place.is_probe(), p);
  f.panels.push_back(std::move(p));
  f.notes = {
      fmt::format("Each spectrum is of {:.3g} s, about the moment of its speed. ", turn / s->bin) +
      heights_text(place, unit, largest)};
  return f;
}

std::vector<Figure> measured_cascade_figures(const ResultView& result) {
  const auto m = drawn_motion(result);
  if (!m || !m->is_run_up() || !m->motion.has_marks) return {};
  std::vector<Figure> figures;
  const auto add = [&](const SpectraPlace& place, const Vec& x, const Vec& y) {
    if (auto f = cascade_of(result, *m, place, x, y)) figures.push_back(std::move(*f));
  };
  for (const StationMotion* s : m->motion.stations) {
    const std::vector<Probe> probes = probes_of_station(result, *m, s->station);
    add({.name = s->station, .unit = unit_of_station(probes, 0.0)}, s->x, s->y);
  }
  for (const StationMotion* s : m->motion.stations) {
    const Vec none = Vec::Zero(s->x.size());
    for (const Probe& probe : probes_of_station(result, *m, s->station)) {
      if (!is_drawn(result, probe)) continue;
      constexpr double circles = 4.0;  // a cosine is two of half its amplitude
      const Vec reading = std::cos(probe.angle) * s->x + std::sin(probe.angle) * s->y;
      add({probe_name(probe), {probe.name}, circles, unit_of(ProbeLabel(probe))}, reading, none);
    }
  }
  return figures;
}

}  // namespace

FigureKind measured_cascade_kind() {
  return {
      .name = "measured_cascade",
      .title = "Measured cascade",
      .summary = "spectra over the speed of a run-up: full ones of stations, those of probes",
      .needs_one = motion_datasets(),
      .make = measured_cascade_figures,
  };
}

}  // namespace whirl::inline io

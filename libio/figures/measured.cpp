// What is measured: orbits and full spectra at the stations of probes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/interpolation.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libio/figures/full_spectrum.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

std::vector<Figure> measured_spectrum_figures(const ResultView& result) {
  const auto& measured = result_of<MeasuredIdentification>(result);
  std::vector<Figure> figures;
  for (const StationFullSpectrum& s : measured.stations) {
    if (s.amplitude.size() != measured.frequency.size()) {
      throw FileError("the measured spectra are not of their frequencies");
    }
    if (!(s.amplitude.maxCoeff() > 0.0)) continue;
    figures.push_back(full_spectrum(result, s.station, measured.frequency, s.amplitude,
                                    unit_of(measured.probes, s.amplitude.maxCoeff())));
  }
  return figures;
}

/// A record's last revolutions.
struct LastRevolutions {
  double from = 0.0;   ///< when they begin [s]
  double speed = 0.0;  ///< there [rad/s]; 0: the rotor does not spin

  LastRevolutions(const StationRecord& record, double Omega) : speed(Omega) {
    constexpr std::size_t count = 4;
    const std::vector<double>& turns = record.turns;
    const double end = record.time(record.time.size() - 1);
    from = Omega > 0.0 ? end - static_cast<double>(count) * turn / Omega : record.time(0);
    if (turns.size() <= count) return;
    from = turns[turns.size() - 1 - count];
    speed = turn * static_cast<double>(count) / (turns.back() - from);
  }
};

std::vector<Figure> measured_orbit_figures(const ResultView& result) {
  const auto& record = result_of<StationRecord>(result);
  const std::vector<ProbeLabel>& probes = result_of<MeasuredIdentification>(result).probes;
  const Eigen::Index n = record.time.size();
  if (n < 2) return {};
  const double* times = record.time.data();
  const LastRevolutions last(record, speed_of(result));
  const Eigen::Index from = std::lower_bound(times, times + n - 1, last.from) - times;
  std::vector<Figure> figures;
  for (const StationMotion& s : record.stations) {
    if (s.x.size() != n || s.y.size() != n) {
      throw FileError("the measured motion is not of its times");
    }
    const double gap_x = s.x.tail(n - from).mean(), gap_y = s.y.tail(n - from).mean();
    const Vec x = s.x.tail(n - from).array() - gap_x, y = s.y.tail(n - from).array() - gap_y;
    const DisplayUnit unit =
        unit_of(probes, std::hypot(x.cwiseAbs().maxCoeff(), y.cwiseAbs().maxCoeff()));
    Figure f{.variant = s.station, .width = 560.0, .height = 560.0};
    f.subtitle =
        fmt::format("{}: measured orbit at {}", s.station, shown_value(last.speed, "rpm", ".4g"));
    Panel p;
    p.has_equal_scales = true;
    p.x.title = with_unit("x", unit);
    p.y.title = with_unit("y", unit);
    Curve c{.name = "path", .paint = Paint::forward, .x = scaled(numbers(x), unit.factor)};
    c.y = scaled(numbers(y), unit.factor);
    c.along = numbers(Vec(record.time.tail(n - from)));
    c.along_title = "time";
    c.width = 1.2;
    Curve dots{.name = "key-phasor", .paint = Paint::alarm, .has_line = false};
    dots.has_marker = true;
    const auto at = [&](const Vec& signal, double t) {
      const auto size = static_cast<std::size_t>(n);
      return interpolated(std::span(record.time.data(), size), std::span(signal.data(), size), t,
                          Interpolation::linear);
    };
    for (const double t : record.turns) {
      if (t < record.time(from) || t > record.time(n - 1)) continue;
      dots.x.push_back(unit.factor * (at(s.x, t) - gap_x));
      dots.y.push_back(unit.factor * (at(s.y, t) - gap_y));
    }
    p.curves = {std::move(c)};
    if (!dots.x.empty()) p.curves.push_back(std::move(dots));
    f.panels = {std::move(p)};
    f.notes = {
        fmt::format("The last {:.3g} s of the record.", record.time(n - 1) - record.time(from)),
        with_minus(fmt::format("The mean position (gap), {:.4g} and {:.4g} {} along x and y, is "
                               "taken off.",
                               unit.factor * gap_x, unit.factor * gap_y, unit.name))};
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind measured_orbit_kind() {
  return {
      .name = "measured_orbit",
      .title = "Measured orbit",
      .summary = "path of a station of probes, with a dot where the key-phasor is",
      .needs = {dataset_of<StationRecord>(&StationMotion::x)},
      .make = measured_orbit_figures,
  };
}

FigureKind measured_spectrum_kind() {
  return {
      .name = "measured_spectrum",
      .title = "Measured spectrum",
      .summary = "full spectrum of a record, backward left and forward right",
      .needs = {dataset_of<MeasuredIdentification>(&StationFullSpectrum::amplitude)},
      .make = measured_spectrum_figures,
  };
}

}  // namespace whirl::inline io

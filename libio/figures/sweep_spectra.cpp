// Spectra along a sweep: of stations, and of what probes read.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/sweep_view.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double shown_orders = 4.0;
constexpr std::size_t most_places = 4;  ///< probes with figures of their own, of each kind

/// Spectra of one place along a sweep.
struct PlaceSpectra {
  std::string name, subject;          ///< "7 ring", "full spectra"
  std::vector<std::string> probes{};  ///< the one that it is of
  Mat Portrait::*amplitude = &Portrait::spectrum;
  std::size_t row = 0;
  double first_order = -shown_orders;
  std::string along{"whirl frequency over speed (backward left)"}, what{"radius"};
  std::optional<DisplayUnit> unit{};  ///< nothing: by the largest number
};

/// A sweep with the orders of its spectra.
struct SpectraView {
  SweepView of;
  PlaceSpectra place;
  std::vector<double> order;

  SpectraView(const ResultView& result, PlaceSpectra at)
      : of(result),
        place(std::move(at)),
        order(result.file.numbers(place.probes.empty()
                                      ? dataset_of<SweepResult>(&SweepResult::orders)
                                      : dataset_of<SweepResult>(&SweepResult::probe_orders))) {}

  double at(std::size_t way, std::size_t value, std::size_t line) const {
    const SweepPoint* point = of.point(way * of.axis.values.size() + value);
    return point ? number_of(point->portrait.*place.amplitude, place.row, line) : std::nan("");
  }
  double largest(std::size_t way) const {
    double most = 0.0;
    for (std::size_t j = 0; j < of.axis.values.size(); ++j) {
      for (std::size_t i = 0; i < order.size(); ++i) {
        const double a = at(way, j, i);
        if (std::isfinite(a)) most = std::max(most, a);
      }
    }
    return most;
  }
  /// A figure of one of the ways, without its panel.
  Figure figure(std::size_t way, const char* subject) const {
    Figure f{.variant = place.name};
    f.probes = place.probes;
    if (of.ways.size() > 1) f.variant += fmt::format(" ({})", of.ways[way]);
    f.subtitle = fmt::format("{}: {} along {}", f.variant, subject, of.axis.path);
    return f;
  }
  Panel panel() const {
    Panel p;
    p.x = {.title = place.along, .first = place.first_order, .last = shown_orders};
    p.y.title = of.axis.title;
    return p;
  }
  DisplayUnit unit(double most) const { return place.unit.value_or(unit_for(most, "m")); }
};

/// Those of the probes that are drawn.
std::vector<PlaceSpectra> probe_places(const ResultView& result) {
  std::vector<PlaceSpectra> places;
  if (!result.file.has(point_dataset<SweepResult>("probe_spectrum"))) return places;
  const SweepView v(result);
  for (const std::size_t i : drawn_probes(result, v.study.probes)) {
    const ProbeLabel label = v.study.probes[i];
    places.push_back({.name = probe_name(label),
                      .subject = "spectra",
                      .probes = {label.name},
                      .amplitude = &Portrait::probe_spectrum,
                      .row = i,
                      .first_order = 0.0,
                      .along = "frequency over speed",
                      .what = "reading, peak to peak",
                      .unit = unit_of(label)});
    if (places.size() == most_places) break;
  }
  return places;
}

std::vector<PlaceSpectra> station_places(const ResultView& result, std::size_t most) {
  std::vector<PlaceSpectra> places;
  const SweepView v(result);
  for (const std::size_t s : stations_by_interest(result, v.stations)) {
    if (places.size() == most) break;
    places.push_back({.name = v.stations[s], .subject = "full spectra", .row = s});
  }
  return places;
}

std::optional<Figure> spectral_map(const SpectraView& s, std::size_t way) {
  Figure f = s.figure(way, s.place.subject.c_str());
  f.width = 820.0;
  f.height = 600.0;
  const double largest = s.largest(way);
  if (!(largest > 0.0)) return std::nullopt;
  const DisplayUnit unit = s.unit(largest);
  Panel p = s.panel();
  Cells& c = p.cells;
  c.x = s.order;
  c.y = s.of.axis.values;
  for (std::size_t j = 0; j < c.y.size(); ++j) {
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      const double a = s.at(way, j, i);
      c.values.push_back(a > 0.0 ? std::log10(a) + std::log10(unit.factor) : std::nan(""));
    }
  }
  c.title = fmt::format("log10 of the {} [{}]", s.place.what, unit.name);
  c.last = std::ceil(std::log10(largest * unit.factor) * 2.0) / 2.0;
  c.first = c.last - 4.0;
  for (const int order : {-3, -2, -1, 0, 1, 2, 3}) {
    if (order < s.place.first_order) continue;
    p.rules.push_back({Rule::Kind::vertical, static_cast<double>(order), "",
                       order == 0 ? Paint::ink : Paint::gray, Dash::dotted});
  }
  f.panels.push_back(std::move(p));
  return f;
}

std::vector<Figure> spectral_map_figures(const ResultView& result) {
  std::vector<Figure> figures;
  const auto add = [&](const SpectraView& s, std::size_t ways) {
    for (std::size_t w = 0; w < ways; ++w) {
      if (auto f = spectral_map(s, w)) figures.push_back(std::move(*f));
    }
  };
  for (const PlaceSpectra& place : probe_places(result)) {
    const SpectraView s(result, place);
    add(s, s.of.ways.size());
  }
  constexpr std::size_t most_stations = 3;
  bool is_first = true;
  for (const PlaceSpectra& place : station_places(result, most_stations)) {
    const SpectraView s(result, place);
    add(s, is_first ? s.of.ways.size() : 1);
    is_first = false;
  }
  return figures;
}

std::optional<Figure> cascade(const SpectraView& s, std::size_t way) {
  Figure f = s.figure(way, "cascade");
  f.width = 760.0;
  f.height = 680.0;
  const double largest = s.largest(way);
  if (!(largest > 0.0)) return std::nullopt;
  constexpr std::size_t most_lines = 40;
  const std::vector<double>& values = s.of.axis.values;
  const std::size_t every = (values.size() + most_lines - 1) / most_lines;
  const double range = values.back() - values.front();
  constexpr double powers = 3.0;  // of ten, below the largest: 1X would hide all else
  const double height = (range > 0.0 ? range : 1.0) * 0.09;
  const DisplayUnit unit = s.unit(largest);
  Panel p = s.panel();
  std::size_t number = 0;
  for (std::size_t j = 0; j < values.size(); j += every) {
    Curve c{.paint = number++ % 2 == 0 ? Paint::forward : Paint::ink};
    c.width = 0.9;
    for (std::size_t i = 0; i < s.order.size(); ++i) {
      if (std::abs(s.order[i]) > shown_orders + 0.05) continue;
      const double a = s.at(way, j, i);
      c.x.push_back(s.order[i]);
      const double rise = a > 0.0 ? std::max(0.0, 1.0 + std::log10(a / largest) / powers) : 0.0;
      c.y.push_back(values[j] + height * rise);
    }
    p.curves.push_back(std::move(c));
  }
  for (const int order : {-1, 0, 1}) {
    if (order < s.place.first_order) continue;
    p.rules.push_back({Rule::Kind::vertical, static_cast<double>(order), "",
                       order == 0 ? Paint::ink : Paint::gray, Dash::dotted});
  }
  f.panels.push_back(std::move(p));
  f.notes = {
      fmt::format("Heights are logarithmic: from {:.3g} {}, the largest {}, down to a "
                  "thousandth of it.",
                  unit.factor * largest, unit.name, s.place.what)};
  return f;
}

std::vector<Figure> cascade_figures(const ResultView& result) {
  std::vector<Figure> figures;
  std::vector<PlaceSpectra> places = probe_places(result);
  for (PlaceSpectra& place : station_places(result, 1)) places.push_back(std::move(place));
  for (const PlaceSpectra& place : places) {
    const SpectraView s(result, place);
    for (std::size_t w = 0; w < s.of.ways.size(); ++w) {
      if (auto f = cascade(s, w)) figures.push_back(std::move(*f));
    }
  }
  return figures;
}

}  // namespace

FigureKind spectral_map_kind() {
  return {
      .name = "spectral_map",
      .title = "Spectral map",
      .summary = "spectra along a parameter, as colors",
      .needs = {point_dataset<SweepResult>("spectrum")},
      .make = spectral_map_figures,
  };
}

FigureKind cascade_kind() {
  return {
      .name = "cascade",
      .title = "Cascade",
      .summary = "spectra along a parameter, one above the other",
      .needs = {point_dataset<SweepResult>("spectrum")},
      .make = cascade_figures,
  };
}

}  // namespace whirl::inline io

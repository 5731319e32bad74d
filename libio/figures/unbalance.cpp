#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libfe/analyses/amplification.hpp"
#include "libio/figures/bode_curves.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// What curves are drawn of: as many speeds as they need, where a result has them beside those that
/// were asked for.
struct Response {
  explicit Response(const ResultView& result) : study(result_of<UnbalanceStudy>(result)) {
    const bool has_curve = !study.curve_speeds.empty();
    speed = scaled(has_curve ? study.curve_speeds : study.speeds, 1.0 / speed_unit().size);
    const auto count = std::ssize(study.stations), points = std::ssize(speed);
    x.resize(count, points);
    y.resize(count, points);
    major.resize(count, points);
    for (Eigen::Index i = 0; i < count; ++i) {
      const StationResponse& s = study.stations[static_cast<std::size_t>(i)];
      const CVec &of_x = has_curve ? s.curve_x : s.x, &of_y = has_curve ? s.curve_y : s.y;
      const Vec& axis = has_curve ? s.curve_major : s.major;
      if (of_x.size() != points || of_y.size() != points || axis.size() != points) {
        throw FileError("the response is not of its speeds");
      }
      stations.push_back(s.label);
      x.row(i) = of_x;
      y.row(i) = of_y;
      major.row(i) = axis;
    }
  }
  const UnbalanceStudy& study;
  std::vector<double> speed;  ///< [speed_unit()]
  std::vector<std::string> stations;
  CMat x, y;
  Mat major;  ///< semi-axes

  std::vector<Eigen::Index> named() const { return named_rows(stations); }
};

/// Whether a result holds its peaks; earlier versions did not write them.
bool has_peaks(const ResultView& result) {
  return result.file.has(dataset_of<UnbalanceStudy>(&UnbalanceStudy::peaks));
}

/// Peaks of the largest orbit [speed_unit()]; of a result that does not hold them, as its speeds
/// show them.
std::vector<ResponsePeak> peaks_in(const ResultView& result, const Response& r, const CMat& a) {
  if (!has_peaks(result)) return response_peaks(r.speed, a.cwiseAbs());
  std::vector<ResponsePeak> peaks;
  for (const StationPeak& p : r.study.peaks) {
    peaks.push_back({p.row, p.speed / speed_unit().size, p.amplitude, p.below / speed_unit().size,
                     p.above / speed_unit().size});
  }
  return peaks;
}

/// Peaks [speed_unit()] with amplification factors, and their margins to the operating speeds.
/// @param place  what the names of their rows are, for the heading
FigureTable table_of_peaks(const ResultView& result, const std::vector<ResponsePeak>& peaks,
                           const std::string& place, const std::vector<std::string>& names,
                           const DisplayUnit& unit) {
  FigureTable t{.header = {shown_heading("peak", "rpm"), place, with_unit("p-p", unit),
                           "amplification", "margin", "required"}};
  for (const ResponsePeak& peak : peaks) {
    const double factor = peak.amplification();
    std::vector<std::string> row{speed_label(peak.speed), names[static_cast<std::size_t>(peak.row)],
                                 fmt::format("{:.4g}", 2.0 * unit.factor * peak.amplitude),
                                 std::isfinite(factor) ? fmt::format("{:.3g}", factor) : "–"};
    ResponsePeak si = peak;
    for (double* speed : {&si.speed, &si.below, &si.above}) *speed *= speed_unit().size;
    const auto margin = result.model ? machine_margin(*result.model, si) : std::nullopt;
    if (margin) {
      const SeparationMargin& m = *margin;
      row.push_back(fmt::format("{:.1f} % {}", 100.0 * m.actual, m.is_below ? "below" : "above"));
      row.push_back(!std::isfinite(m.required) ? "–"
                    : m.required == 0.0        ? "none"
                                               : fmt::format("{:.1f} %, {}", 100.0 * m.required,
                                                      m.is_kept() ? "kept" : "not kept"));
    } else {
      row.insert(row.end(), {"–", "–"});
    }
    t.rows.push_back(std::move(row));
  }
  return t;
}

/// Says of pictures what they leave out.
void add_notes(const Response& r, std::vector<Figure>& figures) {
  if (r.study.forced.empty()) return;
  for (Figure& f : figures) {
    f.notes.push_back(
        "At the frequency of the speed; responses to forces of other frequencies are not drawn "
        "here, but as forced.");
  }
}

/// Along x or y at the stations with a name.
Figure bode_along(const ResultView& result, const Response& r, const CMat& a,
                  const char* direction) {
  const std::vector<Eigen::Index> named = r.named();
  BodeCurves shown{{}, a(named, Eigen::all), unit_for(2.0 * a.cwiseAbs().maxCoeff(), "m"), {}};
  for (const Eigen::Index i : named) {
    shown.names.push_back(r.stations[static_cast<std::size_t>(i)]);
  }
  Figure f = bode_figure(result, r.speed, shown);
  f.variant = direction;
  f.subtitle = fmt::format("Unbalance response along {}, amplitude peak to peak", direction);
  f.table = table_of_peaks(result, peaks_in(result, r, a), "largest at", r.stations, shown.unit);
  if (has_peaks(result)) {
    f.notes.push_back(
        "Peaks are those of the largest orbit of all stations, along its major axis.");
  }
  return f;
}

/// Probes of one unit with their readings.
std::vector<BodeCurves> probe_curves(const ResultView& result, const Response& r) {
  std::vector<BodeCurves> all;
  for (const ProbeResponse& probe : r.study.probes) {
    if (!is_drawn(result, probe)) continue;
    const CVec& reading = r.study.curve_speeds.empty() ? probe.amplitude : probe.curve_amplitude;
    if (reading.size() != std::ssize(r.speed)) {
      throw FileError("the readings of probes are not of the speeds");
    }
    add_reading(probe, reading, all);
  }
  return all;
}

/// Along the probes, a figure for each of their units.
std::vector<Figure> bode_of_probes(const ResultView& result, const Response& r) {
  std::vector<Figure> figures;
  const std::vector<BodeCurves> groups = probe_curves(result, r);
  for (const BodeCurves& shown : groups) {
    Figure f = bode_figure(result, r.speed, shown);
    f.variant = groups.size() == 1 ? "probes" : "probes in " + shown.unit.name;
    f.probes = shown.probes;
    f.subtitle = "Unbalance response along the probes, amplitude peak to peak";
    std::vector<ResponsePeak> peaks;
    for (const ProbePeak& p : r.study.probe_peaks) {
      const ProbeResponse& probe = r.study.probes[static_cast<std::size_t>(p.row)];
      const auto at = std::find(shown.names.begin(), shown.names.end(), probe_name(probe));
      if (at == shown.names.end()) continue;  // of another unit
      peaks.push_back({at - shown.names.begin(), p.speed / speed_unit().size, p.amplitude,
                       p.below / speed_unit().size, p.above / speed_unit().size});
    }
    f.table = table_of_peaks(result, peaks, "probe", shown.names, shown.unit);
    figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> bode_figures(const ResultView& result) {
  const Response r(result);
  std::vector<Figure> figures = bode_of_probes(result, r);
  figures.push_back(bode_along(result, r, r.x, "x"));
  constexpr double same = 1e-6;  // of an isotropic rotor
  if ((r.x.cwiseAbs() - r.y.cwiseAbs()).cwiseAbs().maxCoeff() > same * r.x.cwiseAbs().maxCoeff()) {
    figures.push_back(bode_along(result, r, r.y, "y"));
  }
  add_notes(r, figures);
  return figures;
}

std::vector<Figure> polar_figures(const ResultView& result) {
  const Response r(result);
  const double operating = speed_of(result) / speed_unit().size;
  std::vector<Figure> figures;
  for (const BodeCurves& shown : probe_curves(result, r)) {
    for (std::size_t i = 0; i < shown.names.size(); ++i) {
      const CVec a = shown.a.row(static_cast<Eigen::Index>(i)).transpose();
      figures.push_back(polar_figure(
          r.speed, {shown.names[i], a, shown.unit, shown.probes[i], shown.angles[i], operating}));
      figures.back().probes = {shown.probes[i]};
      figures.back().subtitle =
          shown.names[i] + ": complex amplitude, peak to peak, speeds along the loop";
    }
  }
  const std::size_t of_probes = figures.size();
  auto stations = r.named();
  std::stable_sort(stations.begin(), stations.end(), [&](Eigen::Index a, Eigen::Index b) {
    return r.x.row(a).cwiseAbs().maxCoeff() > r.x.row(b).cwiseAbs().maxCoeff();
  });
  for (const Eigen::Index i : stations) {
    const std::string name = r.stations[static_cast<std::size_t>(i)];
    const CVec a = r.x.row(i).transpose();
    const DisplayUnit unit = unit_for(2.0 * a.cwiseAbs().maxCoeff(), "m");
    figures.push_back(polar_figure(r.speed, {name, a, unit, "x", 0.0, operating}));
    figures.back().subtitle =
        name + ": complex amplitude along x, peak to peak, speeds along the loop";
    constexpr std::size_t most = 8;
    if (figures.size() == of_probes + most) break;
  }
  add_notes(r, figures);
  return figures;
}

std::vector<Figure> deflection_figures(const ResultView& result) {
  const Response r(result);
  const Mat& major = r.major;
  const std::vector<double> z = numbers(result_of<PointNames>(result).z);
  // stations along the shafts
  struct Place {
    int shaft;
    double z;
    Eigen::Index row;
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < r.stations.size(); ++i) {
    int node = 0;
    const std::string& s = r.stations[i];
    std::from_chars(s.data(), s.data() + s.size(), node);
    if (node < 1 || static_cast<std::size_t>(node) > z.size()) continue;
    const auto at = static_cast<std::size_t>(node - 1);
    const int shaft = result.assembler ? result.assembler->mesh().shaft_of.at(at) : 0;
    places.push_back({shaft, z[at], static_cast<Eigen::Index>(i)});
  }
  std::ranges::sort(places, {}, [](const Place& p) { return std::pair(p.shaft, p.z); });
  if (places.size() < 3) return {};
  const Vec largest = major.cwiseAbs().colwise().maxCoeff().transpose();
  const std::vector<Eigen::Index> peaks = deflection_peaks(major.cwiseAbs());
  Figure f{.height = 400.0};
  f.subtitle = "Deflected shapes at the peaks of the response";
  Panel p;
  p.x.title = shown_heading("position along the shaft", "mm");
  double top = 0.0;
  for (const Eigen::Index k : peaks) top = std::max(top, largest(k));
  const DisplayUnit unit = unit_for(2.0 * top, "m");
  p.y.title = with_unit("major axis p-p, signed", unit);
  std::size_t number = 0;
  for (const Eigen::Index k : peaks) {
    Curve c{
        .name = shown_value(r.speed[static_cast<std::size_t>(k)] * speed_unit().size, "rpm", ".0f"),
        .paint = series_paint(number++)};
    c.has_marker = true;
    c.marker = static_cast<Marker>(number % markers);
    c.size = 6.0;
    Eigen::Index reference = 0;
    major.col(k).cwiseAbs().maxCoeff(&reference);
    int last = 0;
    for (const auto& [shaft, at, i] : places) {
      if (shaft != last) c.x.push_back(not_set), c.y.push_back(not_set);
      last = shaft;
      // with the place that moves most or against it, as far as both ellipses go together
      const double turned =
          (std::conj(r.x(reference, k)) * r.x(i, k) + std::conj(r.y(reference, k)) * r.y(i, k))
              .real();
      c.x.push_back(per_mm() * at);
      c.y.push_back(2.0 * unit.factor * std::copysign(std::abs(major(i, k)), turned));
    }
    p.curves.push_back(c);
  }
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::gray, Dash::dash_dot});
  f.panels.push_back(p);
  std::vector<Figure> figures{std::move(f)};
  add_notes(r, figures);
  return figures;
}

}  // namespace

std::vector<Eigen::Index> figures::deflection_peaks(const Mat& magnitude) {
  const Vec largest = magnitude.colwise().maxCoeff().transpose();
  std::vector<Eigen::Index> peaks;
  for (Eigen::Index k = 1; k + 1 < largest.size(); ++k) {
    if (largest(k) > largest(k - 1) && largest(k) >= largest(k + 1)) peaks.push_back(k);
  }
  constexpr std::size_t most = 4;
  std::sort(peaks.begin(), peaks.end(),
            [&](Eigen::Index a, Eigen::Index b) { return largest(a) > largest(b); });
  if (peaks.size() > most) peaks.resize(most);
  if (peaks.empty()) peaks.push_back(largest.size() - 1);
  std::sort(peaks.begin(), peaks.end());
  return peaks;
}

FigureKind bode_kind() {
  return {
      .name = "bode",
      .title = "Bode",
      .summary = "amplitude and phase of the unbalance response",
      .needs = {dataset_of<UnbalanceStudy>(&StationResponse::x)},
      .make = bode_figures,
  };
}

FigureKind polar_kind() {
  return {
      .name = "polar",
      .title = "Polar",
      .summary = "the same in the plane of its complex amplitude",
      .needs = {dataset_of<UnbalanceStudy>(&StationResponse::x)},
      .make = polar_figures,
  };
}

FigureKind deflection_kind() {
  return {
      .name = "deflection",
      .title = "Deflected shapes",
      .summary = "deflected shape at the peaks of the response",
      .needs = {dataset_of<UnbalanceStudy>(&StationResponse::major),
                dataset_of<PointNames>(&PointNames::z)},
      .make = deflection_figures,
  };
}

}  // namespace whirl::inline io

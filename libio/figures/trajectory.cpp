#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libcontact/blade.hpp"
#include "libio/figures/full_spectrum.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double drawn_orbits = 48.0;     ///< revolutions, of an orbit
constexpr double all_sections = 1e9;      ///< revolutions, of a Poincare section

std::string revolution_text(const Motion& m, Eigen::Index i) {
  return fmt::format("{:.2f} revolutions before the end",
                     (m.time(m.size() - 1) - m.time(i)) / m.period);
}

/// Normal and friction forces of a contact in a panel.
void add_forces(const Motion& m, Eigen::Index contact, Panel& p, const std::string& name) {
  const Vec normal = m.record.normal.row(contact), friction = m.record.friction.row(contact);
  const DisplayUnit unit = unit_for(normal.cwiseAbs().maxCoeff(), "N");
  p.y.title = with_unit(name.empty() ? "force" : name, unit);
  const MotionSamples drawn = m.drawn(seen_revolutions);
  const auto time = numbers(m.time, drawn);
  Curve n{.name = "normal force", .paint = series_paint(1), .x = time};
  n.y = scaled(numbers(normal, drawn), unit.factor);
  n.width = 1.3;
  p.curves.push_back(std::move(n));
  if (friction.cwiseAbs().maxCoeff() > 0.0) {
    Curve t{.name = "friction force", .paint = series_paint(4), .x = time};
    t.y = scaled(numbers(friction, drawn), unit.factor);
    t.width = 1.1;
    p.curves.push_back(std::move(t));
  }
}

std::vector<Figure> time_history_figures(const ResultView& result) {
  const Motion m(result);
  const MotionSamples drawn = m.drawn(seen_revolutions);
  const auto time = numbers(m.time, drawn);
  std::vector<Figure> figures = probe_histories(result);
  for (const std::size_t i : stations_by_interest(result, m.stations)) {
    const StationMotion& s = m.record.stations[i];
    Figure f{.variant = m.stations[i], .height = 500.0};
    f.subtitle = fmt::format("{}: time history{}", m.stations[i], at_speed(result));
    const DisplayUnit unit = unit_for(largest_displacement(s), "m");
    for (const auto& [name, values] : {std::pair{"x", &s.x}, std::pair{"y", &s.y}}) {
      Panel p;
      m.show_over_time(p, seen_revolutions);
      p.y.title = with_unit(name, unit);
      Curve c{.name = name[0] == 'x' ? "x" : "y",
              .paint = name[0] == 'x' ? Paint::series : series_paint(2),
              .x = time};
      c.y = scaled(numbers(*values, drawn), unit.factor);
      c.width = 1.3;
      p.curves.push_back(std::move(c));
      f.panels.push_back(std::move(p));
    }
    const int contact = contact_at(result, m.stations[i]);
    if (contact >= 0 && m.record.normal.size() > 0) {
      Panel p;
      m.show_over_time(p, seen_revolutions);
      add_forces(m, contact, p, "contact force");
      f.panels.push_back(std::move(p));
      f.height = 620.0;
    }
    f.notes = m.time_notes(seen_revolutions);
    figures.push_back(std::move(f));
  }
  return figures;
}

/// The mean position, where it is farther from the axis than the motion goes from it, such as the
/// sag of a heavy rotor; else the axis. Seen from the rotor it is a circle beside which nothing is
/// seen.
Complex leading_middle(const StationMotion& of, const MotionSamples& shown) {
  const Vec x = of.x.segment(shown.first, shown.size()),
            y = of.y.segment(shown.first, shown.size());
  const Complex mean(x.mean(), y.mean());
  const Vec away = ((x.array() - mean.real()).square() + (y.array() - mean.imag()).square()).sqrt();
  return std::abs(mean) > away.maxCoeff() ? mean : Complex();
}

/// Says that a mean position is left out.
std::string about_middle_note(const Complex& middle, const DisplayUnit& unit) {
  constexpr double nothing = 1e-4;  // beside the other part
  const auto shown = [&](double part) {
    return std::abs(part) < nothing * std::abs(middle) ? 0.0 : unit.factor * part;
  };
  return with_minus(
      fmt::format("Seen from the rotor without the mean position, {:.4g} and {:.4g} {} along x and "
                  "y, which turns there once a revolution.",
                  shown(middle.real()), shown(middle.imag()), unit.name));
}

/// A path, in the frame that stands or in the one that turns with the rotor, and how it ends.
/// @param middle  that is left out of it [m]
std::vector<Curve> orbit_curves(const Motion& m, const MotionSamples& shown,
                                const StationMotion& of, double factor, bool is_rotating,
                                const Complex& middle) {
  Curve c{.name = "orbit", .paint = is_rotating ? series_paint(2) : Paint::forward};
  c.width = 1.0;
  c.along_title = "time";
  Curve dots = dots_of_revolutions();
  for (Eigen::Index j = shown.first; j <= shown.last; ++j) {
    const Complex q = (Complex(of.x(j), of.y(j)) - middle) *
                      (is_rotating ? std::polar(1.0, -m.phase(j)) : Complex(1.0));
    c.x.push_back(factor * q.real());
    c.y.push_back(factor * q.imag());
    c.along.push_back(m.time(j));
    if (!m.ends_revolution(j)) continue;
    dots.x.push_back(c.x.back());
    dots.y.push_back(c.y.back());
    dots.along.push_back(m.time(j));
    dots.hover.push_back(revolution_text(m, j));
  }
  Curve end{.name = "end", .paint = Paint::ink, .has_line = false};
  end.has_marker = true;
  end.size = 7.0;
  end.x = {c.x.back()};
  end.y = {c.y.back()};
  // how it ends: the way it turns
  const auto back = static_cast<std::ptrdiff_t>(
      std::min<std::size_t>(c.x.size() - 1, static_cast<std::size_t>(m.per_revolution / 12 + 1)));
  Curve tail{.name = "last twelfth of a revolution", .paint = Paint::ink};
  tail.width = 2.4;
  tail.x.assign(c.x.end() - back, c.x.end());
  tail.y.assign(c.y.end() - back, c.y.end());
  std::vector<Curve> curves{std::move(c)};
  if (m.spins) curves.push_back(std::move(dots));
  curves.push_back(std::move(tail));
  curves.push_back(std::move(end));
  return curves;
}

/// The clearance circle of a contact, its ellipse, or the line of a stop, where it stands still in
/// a frame and is not far outside.
/// @param size  of the orbit [m]
std::optional<Curve> clearance_curve(const Contact& contact, double size, double factor,
                                     bool is_rotating) {
  const bool is_fixed = contact.against.kind == Station::Kind::ground;
  const AnyGeometry geometry = geometry_of(contact);
  const auto direction = direction_of(geometry);
  const bool is_centered = contact.offset.norm() == 0.0 && !direction && !is_wall(geometry);
  if (!(contact.clearance > 0.0 && contact.clearance < 6.0 * size)) return std::nullopt;
  if (is_rotating && !(is_fixed && is_centered)) return std::nullopt;
  const std::string name = is_fixed ? "clearance" : "clearance, stator at rest";
  const double distance = factor * contact.clearance;
  const Vec2 middle = factor * contact.offset;
  if (direction) return line_across(name, *direction, distance, factor * size, middle);
  return curve_around(
      name, [&](const Vec2& along) { return reach_of(geometry, distance, along); }, middle);
}

std::vector<Figure> orbit_figures(const ResultView& result) {
  const Motion m(result);
  const MotionSamples shown = m.shown(drawn_orbits);
  std::vector<Figure> figures;
  for (const std::size_t i : stations_by_interest(result, m.stations)) {
    const StationMotion& s = m.record.stations[i];
    Figure f{.variant = m.stations[i], .width = 900.0, .height = 480.0};
    f.columns = 2;
    f.subtitle = fmt::format("{}: orbit{}", m.stations[i], at_speed(result));
    const double size = largest_displacement(s);
    const std::vector<Probe> probes = probes_at(result, m.stations[i]);
    const DisplayUnit unit = probes.empty() ? unit_for(size, "m") : unit_of(probes.front());
    const int contact = contact_at(result, m.stations[i]);
    f.notes = m.notes(drawn_orbits);
    for (const bool is_rotating : {false, true}) {
      if (is_rotating && !m.spins) break;
      const Complex middle = is_rotating ? leading_middle(s, shown) : Complex();
      const bool is_about_middle = std::abs(middle) > 0.0;
      Panel p;
      p.title = is_rotating ? "seen from the rotor" : "seen from the ground";
      p.has_equal_scales = true;
      p.x.title = with_unit(is_rotating ? "ξ" : "x", unit);
      p.y.title = with_unit(is_rotating ? "η" : "y", unit);
      if (is_about_middle) {
        p.title += ", about the mean position";
        f.notes.push_back(about_middle_note(middle, unit));
      }
      if (contact >= 0 && !is_about_middle) {
        const Contact& at = result.model->contacts[static_cast<std::size_t>(contact)];
        if (auto around = clearance_curve(at, size, unit.factor, is_rotating)) {
          p.curves.push_back(std::move(*around));
        }
      }
      for (Curve& c : orbit_curves(m, shown, s, unit.factor, is_rotating, middle)) {
        p.curves.push_back(std::move(c));
      }
      if (!is_rotating) add_probes(probes, size, unit.factor, p);
      f.panels.push_back(std::move(p));
    }
    if (f.panels.size() == 1) f.width = 540.0, f.columns = 1;
    figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> poincare_figures(const ResultView& result) {
  const Motion m(result);
  if (!m.spins) return {};
  std::vector<Figure> figures = probe_sections(result);
  for (const std::size_t i : stations_by_interest(result, m.stations)) {
    const StationMotion& s = m.record.stations[i];
    Figure f{.variant = m.stations[i], .width = 900.0, .height = 480.0};
    f.columns = 2;
    f.subtitle = fmt::format("{}: Poincaré section at {}", m.stations[i], speed_text(result));
    const DisplayUnit unit = unit_for(largest_displacement(s), "m");
    Panel plane, next;
    plane.title = "once a revolution";
    next.title = "from one revolution to the next";
    plane.x.title = next.x.title = with_unit("x", unit);
    plane.y.title = with_unit("y", unit);
    next.y.title = with_unit("x a revolution later", unit);
    Curve c{.paint = Paint::forward, .has_line = false};
    c.has_marker = true;
    c.size = 4.0;
    c.along_title = "time";
    Curve after = c;
    const MotionSamples drawn = m.drawn(all_sections);
    for (Eigen::Index j = drawn.first; j <= drawn.last; ++j) {
      if (!m.ends_revolution(j)) continue;
      c.x.push_back(unit.factor * s.x(j));
      c.y.push_back(unit.factor * s.y(j));
      c.along.push_back(m.time(j));
      c.hover.push_back(revolution_text(m, j));
    }
    for (std::size_t j = 0; j + 1 < c.x.size(); ++j) {
      after.x.push_back(c.x[j]);
      after.y.push_back(c.x[j + 1]);
    }
    const std::size_t count = c.x.size();
    if (count == 0) return {};
    // a motion that repeats is one point: an orbit's size is the scale then, not rounding
    const double room = 1e-3 * unit.factor * s.x.cwiseAbs().maxCoeff();
    keep_room(plane.x, c.x, room);
    keep_room(plane.y, c.y, room);
    keep_room(next.x, after.x, room);
    keep_room(next.y, after.y, room);
    Curve diagonal{.paint = Paint::gray};
    diagonal.width = 1.0;
    diagonal.dash = Dash::dashed;
    diagonal.is_key = false;
    const double far = 2.0 * unit.factor * s.x.cwiseAbs().maxCoeff();
    diagonal.x = {-far, far};
    diagonal.y = {-far, far};
    plane.curves = {std::move(c)};
    next.curves = {std::move(diagonal), std::move(after)};
    f.panels = {std::move(plane), std::move(next)};
    f.notes = {fmt::format("{} revolutions.", count)};
    if (result.window.is_given()) f.notes = m.notes(all_sections);
    figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> spectrum_figures(const ResultView& result) {
  const auto& spectra = result_of<StationSpectra>(result);
  const std::vector<std::string> stations = recorded_stations(result);
  std::vector<Figure> figures = probe_spectra(result);
  for (const std::size_t i : stations_by_interest(result, stations)) {
    const Vec& amplitude = spectra.stations.at(i).amplitude;
    if (!(amplitude.maxCoeff() > 0.0)) continue;
    figures.push_back(full_spectrum(result, stations[i], spectra.frequency, amplitude,
                                    unit_for(amplitude.maxCoeff(), "m")));
  }
  return figures;
}

/// How far friction bends the blade that touches; nothing: the contact has no blades.
std::optional<Panel> blade_panel(const ResultView& result, const Motion& m, std::size_t contact) {
  if (!result.model || contact >= result.model->contacts.size()) return std::nullopt;
  const Contact& of = result.model->contacts[contact];
  const auto* blade = std::get_if<BladeTip<>>(&of.law);
  if (!blade) return std::nullopt;
  const Vec deflection = blade_deflection(*blade, result.model->speed) *
                         m.record.friction.row(static_cast<Eigen::Index>(contact));
  const DisplayUnit unit = unit_for(deflection.cwiseAbs().maxCoeff(), "m");
  const MotionSamples drawn = m.drawn(seen_revolutions);
  Panel p;
  m.show_over_time(p, seen_revolutions);
  p.title = of.name + ", blade in touch";
  p.y.title = with_unit("deflection of its tip", unit);
  Curve c{.name = "tip of the blade", .paint = series_paint(4), .x = numbers(m.time, drawn)};
  c.y = scaled(numbers(deflection, drawn), unit.factor);
  c.width = 1.1;
  p.curves.push_back(std::move(c));
  return p;
}

std::vector<Figure> contact_force_figures(const ResultView& result) {
  const Motion m(result);
  const auto& contacts = result_of<ContactShares>(result).contacts;
  Figure f;
  f.subtitle = fmt::format("Contact forces{}", at_speed(result));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Panel p;
    m.show_over_time(p, seen_revolutions);
    p.title = contacts[i].name;
    add_forces(m, static_cast<Eigen::Index>(i), p, "");
    if (p.curves[0].y.empty() || largest_of(p.curves[0].y) == 0.0) p.title += " (never touches)";
    f.panels.push_back(std::move(p));
    if (auto bent = blade_panel(result, m, i)) f.panels.push_back(std::move(*bent));
  }
  f.height = 90.0 + 190.0 * static_cast<double>(f.panels.size());
  f.notes = m.time_notes(seen_revolutions);
  return f.panels.empty() ? std::vector<Figure>{} : std::vector<Figure>{f};
}

}  // namespace

FigureKind orbit_kind() {
  return {
      .name = "orbit",
      .title = "Orbit",
      .summary = "path of a station, seen from the ground and from the rotor",
      .subject = Subject::orbit,
      .needs = {dataset_of<MotionRecord>(&StationMotion::x)},
      .make = orbit_figures,
      .takes_window = true,
  };
}

FigureKind time_history_kind() {
  return {
      .name = "time_history",
      .title = "Time history",
      .summary = "displacements and contact forces in time",
      .needs = {dataset_of<MotionRecord>(&StationMotion::x)},
      .make = time_history_figures,
      .takes_window = true,
  };
}

FigureKind spectrum_kind() {
  return {
      .name = "spectrum",
      .title = "Spectrum",
      .summary = "full spectrum, backward left and forward right",
      .needs = {dataset_of<StationSpectra>(&StationSpectrum::amplitude)},
      .make = spectrum_figures,
  };
}

FigureKind poincare_kind() {
  return {
      .name = "poincare",
      .title = "Poincaré",
      .summary = "where a station is once a revolution",
      .needs = {dataset_of<MotionRecord>(&StationMotion::x)},
      .make = poincare_figures,
      .takes_window = true,
  };
}

FigureKind contact_forces_kind() {
  return {
      .name = "contact_forces",
      .title = "Contact forces",
      .summary = "normal and friction force of the contacts in time",
      .needs = {dataset_of<MotionRecord>(&MotionRecord::normal)},
      .make = contact_force_figures,
      .takes_window = true,
  };
}

}  // namespace whirl::inline io

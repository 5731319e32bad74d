#include "libio/texts/orbit_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"
#include "libio/texts/motion_text.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

std::string gap_text(const ShootingGap& gap) {
  if (gap.failure) return "\n  shooting from there: " + gap.failure.text();
  return fmt::format(
      "\n  from shooting it differs by {:.1e} in displacements, {:.1e} in velocities (length "
      "scales, and those times the speed), {:.1e} in multipliers",
      *gap.displacement, *gap.velocity, *gap.multiplier);
}

std::string series_text(const FoundOrbit& orbit) {
  const OrbitSeries& series = *orbit.series;
  std::string text = fmt::format(
      "residual {:.1e} length scales\n  {} harmonics of {}", orbit.residual, series.harmonics,
      orbit.period == 1 ? std::string("the speed")
                        : fmt::format("1/{} of the speed", orbit.period));
  text += std::isfinite(series.truncation)
              ? fmt::format(", those left out change displacements by about {:.1e} length scales",
                            series.truncation)
              : std::string(", what those left out change is not known");
  if (series.stability_failure) text += "\n  stability: " + series.stability_failure.text();
  if (const int count = series.averaged_multipliers.value_or(0); count > 0) {
    text += fmt::format(
        "\n  {} multipliers of modes too fast for the harmonics are from mean forces", count);
  }
  if (const int count = series.missing_multipliers.value_or(0); count > 0) {
    text += fmt::format("\n  {} multipliers below 1e-4 are left out", count);
  }
  return series.gap ? text + gap_text(*series.gap) : text;
}

/// "+0.500000 -0.250000 i"
std::string pair_text(const Complex& m) {
  return fmt::format("{:+.6f} {:+.6f} i", m.real(), m.imag());
}

/// How the orbit was found, and how well.
std::string method_text(const FoundOrbit& orbit) {
  if (orbit.series) return series_text(orbit);
  return fmt::format("residual {:.1e} length scales after {} steps of Newton's method",
                     orbit.residual, orbit.steps);
}

std::string multipliers_table(const FoundOrbit& orbit) {
  std::vector<std::string> head{"multiplier", "real",           "imaginary",
                                "size",       "exponent [1/s]", shown_heading("frequency", "rpm")};
  if (!orbit.modes.empty()) head.push_back("most like mode (MAC)");
  Table table(head);
  const CVec& rates = orbit.exponents;
  for (Eigen::Index i = 0; i < rates.size(); ++i) {
    const Complex m = orbit.multipliers(i);
    std::vector<std::string> row{std::to_string(i + 1),
                                 fmt::format("{:+.8f}", m.real()),
                                 fmt::format("{:+.8f}", m.imag()),
                                 fmt::format("{:.8f}", std::abs(m)),
                                 texts::number_text(rates(i).real(), "+.6f"),
                                 shown_number(rates(i).imag(), "rpm", ".2f")};
    if (!orbit.modes.empty()) {
      const MultiplierMode& mode = orbit.modes[static_cast<std::size_t>(i)];
      row.push_back(mode.mode > 0 ? fmt::format("{} ({:.2f})", mode.mode, mode.mac) : "-");
    }
    table.row(row);
  }
  return table.text();
}

/// What probes read of all orbits; empty without probes.
std::string readings_table(const OrbitSearch& search) {
  if (search.orbits.empty() || search.orbits[0].probes.empty()) return "";
  std::vector<std::string> head{"orbit"};
  for (const OrbitProbe& probe : search.orbits[0].probes) head.push_back(probe.name);
  Table table(head);
  for (std::size_t i = 0; i < search.orbits.size(); ++i) {
    std::vector<std::string> row{std::to_string(i + 1)};
    for (const OrbitProbe& p : search.orbits[i].probes) {
      row.push_back(reading_text(p.peak_to_peak, p));
    }
    table.row(row);
  }
  return "\n  Along the probes, peak to peak\n\n" + table.text();
}

}  // namespace

std::string text_of(const FoundOrbit& orbit) {
  if (!orbit.is_good()) return "";
  const int period = orbit.period;
  double impacts = 0.0;
  for (const ContactMeasure& c : orbit.contacts) impacts += c.impacts;
  std::string text = fmt::format("  {} orbit of {} revolution{}, {:.0f}/{} impacts; {}\n",
                                 orbit.is_stable ? "stable" : "unstable", period,
                                 period == 1 ? "" : "s", impacts, period, method_text(orbit));
  if (orbit.shortest_period != period) {
    text += fmt::format("  it repeats after {} already: --period {}\n", orbit.shortest_period,
                        orbit.shortest_period);
  }
  text += "\n" + multipliers_table(orbit);
  if (!orbit.contacts.empty()) text += "\n" + contacts_table(orbit.contacts, period);
  return text + text_of(orbit.probes);
}

std::string text_of(const RotatingOrbit& orbit) {
  if (!orbit.is_good()) return "";
  Table table({"multiplier", "real", "imaginary", "size"});
  for (Eigen::Index i = 0; i < orbit.multipliers.size(); ++i) {
    const Complex m = orbit.multipliers(i);
    table.row({std::to_string(i + 1), fmt::format("{:+.8f}", m.real()),
               fmt::format("{:+.8f}", m.imag()), fmt::format("{:.8f}", std::abs(m))});
  }
  return fmt::format(
             "  {} orbit of {:.9g} revolutions, {} seen from the rotor; residual {:.1e} length "
             "scales after {} steps of Newton's method\n\n",
             orbit.is_stable() ? "stable" : "unstable", orbit.revolutions,
             shown_value(turn / orbit.period, "rpm", ".6g"), orbit.residual, orbit.steps()) +
         table.text() + text_of(orbit.probes);
}

std::string text_of(const OrbitSearch& search) {
  using S = SearchedOrbit;
  const std::string table = table_of(
      search.orbits,
      {row_number("orbit"),
       {"", [](const S& s) { return s.is_stable() ? "stable" : "unstable"; }},
       shown("period_revs").as("repeats after"),
       {"impacts",
        [](const S& s) { return fmt::format("{:.0f}/{}", s.impacts(), s.orbit.period); }},
       {"largest multiplier", [](const S& s) { return pair_text(s.orbit.multipliers(0)); }},
       shown("starts").as("of starts")});
  return (search.orbits.empty() ? "" : table + readings_table(search) + "\n") +
         fmt::format("  {} starts led to none\n", search.failed);
}

}  // namespace whirl::inline io

#include "apps/verbs/orbit_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/verbs/common.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline cli {

namespace {

Record gap_record(const ShootingGap& gap) {
  Record r;
  if (!gap.failure.empty()) return r.set("failure", gap.failure);
  r.set("displacement", gap.displacement).set("velocity", gap.velocity);
  r.set("multiplier", gap.multiplier).set("residual", gap.residual);
  return r;
}

Record series_record(const FoundOrbit& orbit) {
  const OrbitSeries& series = *orbit.series;
  Record r, levels = Record::array();
  for (const HarmonicOrbit::Level& level : series.levels) {
    Record l;
    l.set("harmonics", level.harmonics).set("steps", level.steps).set("change", level.change);
    levels.add(l);
  }
  r.set("harmonics", series.harmonics).set("truncation", series.truncation).set("levels", levels);
  if (!orbit.is_good()) return r;
  r.set("multipliers_left_out", series.missing_multipliers);
  r.set("multipliers_of_means", series.averaged_multipliers);
  if (series.gap) r.set("shooting", gap_record(*series.gap));
  return r;
}

std::string gap_text(const ShootingGap& gap) {
  if (!gap.failure.empty()) return "\n  shooting from there: " + gap.failure;
  return fmt::format(
      "\n  from shooting it differs by {:.1e} in displacements, {:.1e} in velocities (length "
      "scales, and those times the speed), {:.1e} in multipliers",
      gap.displacement, gap.velocity, gap.multiplier);
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
  if (!series.stability_failure.empty()) text += "\n  stability: " + series.stability_failure;
  if (series.averaged_multipliers > 0) {
    text +=
        fmt::format("\n  {} multipliers of modes too fast for the harmonics are from mean forces",
                    series.averaged_multipliers);
  }
  if (series.missing_multipliers > 0) {
    text += fmt::format("\n  {} multipliers below 1e-4 are left out", series.missing_multipliers);
  }
  return series.gap ? text + gap_text(*series.gap) : text;
}

/// How the orbit was found, and how well.
std::string method_text(const FoundOrbit& orbit) {
  if (orbit.series) return series_text(orbit);
  return fmt::format("residual {:.1e} length scales after {} steps of Newton's method",
                     orbit.residual, orbit.steps);
}

std::string multipliers_table(const FoundOrbit& orbit) {
  std::vector<std::string> head{"multiplier", "real",           "imaginary",
                                "size",       "exponent [1/s]", "frequency [rpm]"};
  if (!orbit.modes.empty()) head.push_back("most like mode (MAC)");
  Table table(head);
  const CVec& rates = orbit.exponents;
  for (Eigen::Index i = 0; i < rates.size(); ++i) {
    const Complex m = orbit.multipliers(i);
    std::vector<std::string> row{std::to_string(i + 1),
                                 fmt::format("{:+.8f}", m.real()),
                                 fmt::format("{:+.8f}", m.imag()),
                                 fmt::format("{:.8f}", std::abs(m)),
                                 fmt::format("{:+.6f}", rates(i).real()),
                                 texts::number_text(rates(i).imag() / rpm, ".2f")};
    if (!orbit.modes.empty()) {
      const MultiplierMode& mode = orbit.modes[static_cast<std::size_t>(i)];
      row.push_back(mode.mode > 0 ? fmt::format("{} ({:.2f})", mode.mode, mode.mac) : "-");
    }
    table.row(row);
  }
  return table.text();
}

}  // namespace

Record complex_list(const CVec& numbers) {
  Record list = Record::array();
  for (const Complex& z : numbers) list.add(z);
  return list;
}

void add_orbit(Record& record, const FoundOrbit& orbit) {
  record.set("period_revs", orbit.period).set("shortest_period_revs", orbit.shortest_period);
  record.set("residual", orbit.residual).set("steps", orbit.steps);
  record.set("floquet", complex_list(orbit.multipliers));
  record.set("exponents_1_s", complex_list(orbit.exponents));
  Record modes = Record::array();
  for (const MultiplierMode& m : orbit.modes) {
    Record mode;
    mode.set("mode", m.mode > 0 ? Record(m.mode) : Record(nullptr)).set("mac", m.mac);
    modes.add(mode);
  }
  record.set("floquet_modes", modes);
  record.set("stable", orbit.is_good() ? Record(orbit.is_stable) : Record(nullptr));
  record.set("state", orbit.states.front());
  record.merge(record_of(contact_shares(orbit.contacts, orbit.period)));
  if (orbit.series) record.set("harmonic_balance", series_record(orbit));
}

std::string orbit_text(const FoundOrbit& orbit) {
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
  return text;
}

}  // namespace whirl::inline cli

#include "libio/texts/identification_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// What a peak is beside the mode of its shape: forced, a combination, or that mode, shifted.
std::string shift_text(const IdentifiedPeak& p) {
  constexpr double far = 0.1;  // of a mode's frequency: a peak beyond is not that mode's own
  if (!p.forced.empty()) return fmt::format("forced ({})", p.forced);
  const std::string shift = fmt::format("{:+.1f} %", 100.0 * p.shift);
  if (!p.combination) return shift;
  const std::string made_of = p.combination->text();
  return std::abs(p.shift) > far ? made_of : shift + ", " + made_of;
}

/// "2F 1664": number, sense and frequency of a mode.
std::string mode_heading(const Mode& m, std::size_t number) {
  const std::string_view whirl = name_of(m.whirl);
  return fmt::format("{}{} {}", number, static_cast<char>(std::toupper(whirl.front())),
                     shown_number(m.frequency(), "rpm", ".0f"));
}

}  // namespace

std::string text_of(const Identification& found, double Omega, bool has_sense,
                    const ProbeLabel* told_like) {
  TableColumns<IdentifiedPeak> columns{
      shown("frequency", "rpm", has_sense ? "+.1f" : ".1f").as("peak")};
  if (has_sense) {
    columns.push_back({"from the rotor", [=](const IdentifiedPeak& p) {
                         return shown_number(p.frequency - Omega, "rpm", "+.1f");
                       }});
  }
  const std::string size = has_sense ? "radius" : "amplitude";
  if (told_like) {
    columns.push_back(
        {size, [=](const IdentifiedPeak& p) { return reading_text(p.amplitude, *told_like); }});
  } else {
    columns.push_back(shown("amplitude").as(size));
  }
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    columns.push_back({mode_heading(found.modes[i], i + 1), [i](const IdentifiedPeak& p) {
                         return p.mac[i] < 0.005 ? "·" : fmt::format("{:.2f}", p.mac[i]);
                       }});
  }
  columns.push_back({"best", [](const IdentifiedPeak& p) {
                       return p.mac.empty() ? "-" : fmt::format("mode {}", p.mode + 1);
                     }});
  columns.push_back({"shift", shift_text});
  std::string text = table_of(found.peaks, columns);
  if (const auto& r = found.resonance) {
    text += fmt::format("\n  seen from the rotor {} : {} = {}:{} within {:.2g} %\n",
                        shown_number(r->high, "rpm", ".1f"), shown_value(r->low, "rpm", ".1f"),
                        r->p, r->q, 100.0 * r->error);
  }
  return text;
}

const ProbeLabel* probe_told_like(const MeasuredIdentification& measured) {
  const std::vector<ProbeLabel>& probes = measured.probes;
  const bool is_one = !probes.empty() && std::all_of(probes.begin(), probes.end(), [&](auto& p) {
    return p.unit == probes.front().unit;
  });
  return is_one ? &probes.front() : nullptr;
}

std::string text_of(const MeasuredIdentification& measured) {
  std::string probes;
  for (const ProbeLabel& p : measured.probes) {
    probes += fmt::format("{}{} ({:g} deg{})", probes.empty() ? "" : ", ", p.name, p.angle_deg(),
                          p.is_axial() ? " along z" : "");
  }
  return fmt::format("  probes: {}\n  speed: {}\n  transformed: {:.4g} s, lines {} apart\n", probes,
                     shown_value(measured.speed, "rpm", ".6g"), measured.duration,
                     shown_value(measured.found.bin, "rpm", ".3g"));
}

std::string deflection_text(const MeasuredIdentification& measured) {
  constexpr std::size_t most = 4;
  const std::size_t peaks = std::min(most, measured.found.peaks.size());
  if (peaks == 0 || measured.probes.size() < 2) return "";
  std::vector<std::string> head{"probe"};
  for (std::size_t i = 0; i < peaks; ++i) {
    head.push_back(shown_value(measured.found.peaks[i].frequency, "rpm",
                               measured.is_in_one_direction ? ".1f" : "+.1f"));
  }
  Table table(std::move(head));
  for (std::size_t p = 0; p < measured.probes.size(); ++p) {
    std::vector<std::string> row{measured.probes[p].name};
    for (std::size_t i = 0; i < peaks; ++i) {
      const Complex reading =
          measured.deflection(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(p));
      row.push_back(fmt::format("{} {:>6}", reading_text(std::abs(reading), measured.probes[p]),
                                fmt::format("{:+.0f}°", std::arg(reading) / degree)));
    }
    table.row(std::move(row));
  }
  return fmt::format("\nDeflection shapes at the {}peak{}: amplitude and phase of readings\n\n{}",
                     peaks < measured.found.peaks.size() ? "strongest " : "", peaks == 1 ? "" : "s",
                     table.text());
}

namespace {

/// Peaks of orders with their amplification factors; empty: there are none.
std::string peaks_text(const OrderTracking& tracking) {
  if (tracking.peaks.empty()) return "";
  const auto curve = [&](const OrderPeak& p) -> const OrderCurve& {
    return tracking.curves[static_cast<std::size_t>(p.row)];
  };
  const auto told = [](double value, const char* format, double unit) {
    return std::isfinite(value) ? texts::number_text(value / unit, format) : std::string("-");
  };
  const auto speed = [](double value) {
    return std::isfinite(value) ? shown_number(value, "rpm", ".1f") : std::string("-");
  };
  const TableColumns<OrderPeak> columns{
      {"probe", [=](const OrderPeak& p) { return curve(p).name; }},
      {"order", [=](const OrderPeak& p) { return fmt::format("{:g}X", curve(p).order); }},
      {shown_heading("peak", "rpm"), [=](const OrderPeak& p) { return speed(p.speed); }},
      {"p-p", [=](const OrderPeak& p) { return reading_text(p.peak_to_peak(), curve(p)); }},
      {"phase [deg]", [=](const OrderPeak& p) { return told(p.phase, "+.1f", degree); }},
      {shown_heading("N1", "rpm"), [=](const OrderPeak& p) { return speed(p.below); }},
      {shown_heading("N2", "rpm"), [=](const OrderPeak& p) { return speed(p.above); }},
      {"AF", [=](const OrderPeak& p) { return told(p.amplification(), ".3g", 1.0); }}};
  return "\nPeaks along the record, AF = N / (N2 - N1) at 0.707 of the peak\n\n" +
         table_of(tracking.peaks, columns);
}

}  // namespace

std::string text_of(const OrderTracking& tracking) {
  const auto largest = [](const OrderCurve& c) {
    Eigen::Index at = 0;
    c.response.cwiseAbs().maxCoeff(&at);
    return at;
  };
  const TableColumns<OrderCurve> columns{
      shown("name").as("probe"),
      {"order", [](const OrderCurve& c) { return fmt::format("{:g}X", c.order); }},
      {"largest p-p",
       [&](const OrderCurve& c) { return reading_text(c.peak_to_peak()(largest(c)), c); }},
      {shown_heading("at", "rpm"),
       [&](const OrderCurve& c) { return shown_number(tracking.speed(largest(c)), "rpm", ".1f"); }},
      {"phase [deg]", [&](const OrderCurve& c) {
         return texts::number_text(std::arg(c.response(largest(c))) / degree, "+.1f");
       }}};
  const std::string off = tracking.slow_roll
                              ? fmt::format(", readings at {} taken off",
                                            shown_value(*tracking.slow_roll, "rpm", ".6g"))
                              : "";
  return fmt::format("Orders from {} to {}, {} points{}\n\n{}",
                     shown_number(tracking.speed.minCoeff(), "rpm", ".6g"),
                     shown_value(tracking.speed.maxCoeff(), "rpm", ".6g"), tracking.speed.size(),
                     off, table_of(tracking.curves, columns)) +
         peaks_text(tracking);
}

std::string doubt_text(const MeasuredIdentification& measured) {
  constexpr std::size_t most = 6;
  std::string text;
  if (!measured.unseen.empty()) {
    text += fmt::format("\n  no probe sees mode{} {}\n", measured.unseen.size() == 1 ? "" : "s",
                        fmt::join(measured.unseen, ", "));
  }
  if (measured.indistinct.empty()) return text;
  std::string pairs;
  for (std::size_t i = 0; i < std::min(most, measured.indistinct.size()); ++i) {
    const IndistinctModes& m = measured.indistinct[i];
    pairs += fmt::format("{}{} and {} ({:.2f})", i == 0 ? "" : ", ", m.first, m.second, m.mac);
  }
  if (measured.indistinct.size() > most) {
    pairs += fmt::format(" and {} more pairs", measured.indistinct.size() - most);
  }
  return text +
         fmt::format("\n  the probes cannot tell apart modes {}: their MAC among themselves\n",
                     pairs);
}

}  // namespace whirl::inline io

#include "libio/texts/fit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/results/call.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// A value with all digits that its deviation leaves, and one more.
std::string value_text(double value, const FittedParameter& p) {
  const double ratio = std::abs(p.value) / p.standard_deviation;
  const int digits = ratio > 1.0 && std::isfinite(ratio) ? 2 + std::ilogb(ratio) * 3 / 10 : 4;
  return format_engineering(value, p.unit, std::clamp(digits, 4, 10));
}

std::string deviation_text(const FittedParameter& p) {
  if (p.is_at_bound) return "at its bound";
  if (!std::isfinite(p.standard_deviation)) return "cannot be told";
  const std::string share =
      p.value != 0.0 ? fmt::format(" ({:.2g} %)", 100.0 * p.standard_deviation / std::abs(p.value))
                     : "";
  return fmt::format("± {}{}", format_engineering(p.standard_deviation, p.unit, 2), share);
}

std::string interval_text(const FittedParameter& p) {
  if (!std::isfinite(p.lower) || !std::isfinite(p.upper)) return "-";
  return fmt::format("{} to {}{}", value_text(p.lower, p), value_text(p.upper, p),
                     p.is_told ? "" : ": hardly told");
}

std::string parameter_table(const MeasuredFit& found) {
  using P = FittedParameter;
  return table_of(
      found.parameters,
      TableColumns<P>{row_number(""),
                      shown("path").as("parameter"),
                      {"start", [](const P& p) { return format_engineering(p.start, p.unit); }},
                      {"value", [](const P& p) { return value_text(p.value, p); }},
                      {"standard deviation", deviation_text},
                      {"95 % interval", interval_text}});
}

/// Correlations of the errors, the numbers of the parameters in the head.
std::string correlation_table(const MeasuredFit& found) {
  const auto count = std::ssize(found.parameters);
  if (count < 2) return "";
  std::vector<std::string> head{"correlation of errors"};
  for (Eigen::Index j = 1; j < count; ++j) head.push_back(fmt::format("{}", j));
  Table table(std::move(head));
  for (Eigen::Index i = 1; i < count; ++i) {
    std::vector<std::string> row{
        fmt::format("{} {}", i + 1, found.parameters[static_cast<std::size_t>(i)].path)};
    for (Eigen::Index j = 0; j + 1 < count; ++j) {
      const bool is_there = j < i;
      row.push_back(is_there ? texts::number_text(found.correlation(i, j), "+.3f") : "");
    }
    table.row(std::move(row));
  }
  return "\n" + table.text();
}

std::string probe_table(const MeasuredFit& found) {
  using P = FittedProbe;
  TableColumns<P> columns{shown("name").as("probe")};
  if (found.files.size() > 1) {
    columns.push_back({"record", [&](const P& p) {
                         return found.files[static_cast<std::size_t>(p.record)].file;
                       }});
  }
  const auto told = [](double P::*length) {
    return [=](const P& p) { return std::isfinite(p.*length) ? reading_text(p.*length, p) : "-"; };
  };
  columns.push_back({"left, rms", told(&P::residual)});
  const bool has_offsets = std::any_of(found.probes.begin(), found.probes.end(),
                                       [](const P& p) { return p.offset_deviation > 0.0; });
  if (has_offsets) {
    columns.push_back({"offset", told(&P::offset)});
    columns.push_back({"±", told(&P::offset_deviation)});
  }
  if (found.is_noise_known) {
    columns.push_back({"noise", told(&P::noise)});
  } else {
    columns.push_back({"noise floor", told(&P::floor)});
  }
  return "\n" + table_of(found.probes, columns);
}

std::string runout_table(const MeasuredFit& found) {
  if (found.runouts.empty()) return "";
  using R = FittedRunout;
  const auto told = [&](const R& r, double length) {
    const auto probe = std::ranges::find(found.probes, r.probe, &FittedProbe::name);
    return probe == found.probes.end() ? format_length(length) : reading_text(length, *probe);
  };
  return "\nRunout, amplitude and phase against the mark, the same in all records\n\n" +
         table_of(found.runouts,
                  TableColumns<R>{shown("probe"),
                                  {"order", [](const R& r) { return fmt::format("{}X", r.order); }},
                                  {"amplitude", [=](const R& r) { return told(r, r.amplitude); }},
                                  {"±", [=](const R& r) { return told(r, r.standard_deviation); }},
                                  {"phase [deg]", [](const R& r) {
                                     return fmt::format("{:.0f}", r.phase / degree);
                                   }}});
}

std::string candidate_table(const MeasuredFit& found) {
  if (found.candidates.empty()) return "";
  using C = FitCandidate;
  const double best = found.candidates.front().log_likelihood;
  return "\nModels beside one another, by their likelihood\n\n" +
         table_of(found.candidates,
                  TableColumns<C>{
                      shown("model"),
                      shown("parameters").as("free"),
                      shown("residual", "", ".4g").as("left / noise"),
                      {"log likelihood",
                       [best](const C& c) {
                         return texts::number_text(c.log_likelihood - best, "+.1f");
                       }},
                      shown("weight", "", ".3g"),
                      {"", [](const C& c) { return c.has_converged ? "" : "did not converge"; }}});
}

}  // namespace

std::string text_of(const MeasuredFit& found, const std::string& model) {
  std::string text;
  for (const FittedRecord& r : found.files) {
    const std::string average = r.period == 0 ? ""
                                : r.period == 1
                                    ? ", their average"
                                    : fmt::format(", averaged to {} revolutions", r.period);
    text += fmt::format("  record: {}, {:.4g} revolutions at {}{}\n", r.file, r.revolutions,
                        shown_value(r.speed, "rpm", ".6g"), average);
  }
  text += fmt::format("  readings: {} of {} probes, {:.5g} % of their variance explained\n",
                      found.readings, found.probes.size(), 100.0 * found.explained);
  if (found.starts > 1) {
    text += fmt::format("  starts: {}, of which {} end here\n", found.starts, found.same_end);
  }
  text += "\n" + parameter_table(found) + correlation_table(found) + probe_table(found) +
          runout_table(found) + candidate_table(found);
  text += "\n  to go on: whirl simulate " + shell_word(model);
  for (const FittedParameter& p : found.parameters) {
    text += " \\\n    --set " + shell_word(fmt::format("{}={:.10g}{}", p.path, p.value, p.unit));
  }
  return text + "\n";
}

}  // namespace whirl::inline io

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/frequency_response.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr std::size_t most_curves = 8;

/// One of the three forms in which a response is told.
struct ResponseForm {
  const char* name;
  CVec ResponsePair::*values;
  const char* unit;
};

/// Phases between -180 and 180 degrees; a line is interrupted where one leaves them.
std::vector<double> phases(const CVec& values) {
  std::vector<double> list;
  for (const Complex& v : values) list.push_back(std::arg(v) / degree);
  for (std::size_t i = 1; i < list.size(); ++i) {
    if (std::abs(list[i] - list[i - 1]) > 180.0) list[i - 1] = not_set;
  }
  return list;
}

Figure figure_of(const ResultView& result, const FrequencyResponse& found,
                 const ResponseForm& form) {
  Figure f{.variant = form.name, .height = 560.0};
  const DisplayUnit in = result.frequency;
  f.subtitle = fmt::format("{} at {}", form.name, shown_value(found.speed, "rpm", ".0f"));
  f.subtitle.front() = static_cast<char>(std::toupper(f.subtitle.front()));
  Panel amplitude, phase;
  for (Panel* p : {&amplitude, &phase}) {
    p->x = {.title = with_unit("frequency", in),
            .first = found.frequencies.front() * in.factor,
            .last = found.frequencies.back() * in.factor};
    p->cursor = "frequency";
    if (found.speed > 0.0 && found.speed < found.frequencies.back()) {
      p->rules.push_back({Rule::Kind::vertical, found.speed * in.factor,
                          p == &amplitude ? "1X" : "", Paint::gray, Dash::dotted});
    }
  }
  amplitude.share = 1.5;
  const double per_unit = 1.0 / shown_unit(form.unit).size;
  amplitude.y = {.title = shown_heading(form.name, form.unit), .scale = Scale::logarithmic};
  phase.y = {.title = "phase [deg]", .first = -180.0, .last = 180.0, .step = 90.0};
  const std::vector<bool> silent = found.silent_pairs();
  for (std::size_t i = 0; i < std::min(most_curves, found.pairs.size()); ++i) {
    const ResponsePair& pair = found.pairs[i];
    if (silent[i]) {
      f.notes.push_back(fmt::format("{} by {}: no response.", pair.to, pair.from));
      continue;
    }
    Curve c{.name = fmt::format("{} by {}", pair.to, pair.from),
            .paint = series_paint(i),
            .x = scaled(found.frequencies, in.factor)};
    c.dash = series_dash(i);
    Curve lag = c;
    for (const Complex& v : pair.*form.values) {
      c.y.push_back(std::abs(v) > 0.0 ? per_unit * std::abs(v) : not_set);
    }
    lag.y = phases(pair.*form.values);
    amplitude.curves.push_back(std::move(c));
    phase.curves.push_back(std::move(lag));
  }
  f.panels = {amplitude, phase};
  if (found.pairs.size() > most_curves) {
    f.notes.push_back(
        fmt::format("The first {} of {} responses.", most_curves, found.pairs.size()));
  }
  return f;
}

std::vector<Figure> frf_figures(const ResultView& result) {
  const auto& found = result_of<FrequencyResponse>(result);
  std::vector<Figure> figures;
  for (const ResponseForm& form : {ResponseForm{"receptance", &ResponsePair::receptance, "m/N"},
                                   {"mobility", &ResponsePair::mobility, "m/(N.s)"},
                                   {"accelerance", &ResponsePair::accelerance, "1/kg"}}) {
    figures.push_back(figure_of(result, found, form));
  }
  return figures;
}

}  // namespace

FigureKind frf_kind() {
  return {
      .name = "frf",
      .title = "Frequency responses",
      .summary = "amplitude and phase of receptances, mobilities and accelerances",
      .needs = {dataset_of<FrequencyResponse>(&ResponsePair::receptance)},
      .make = frf_figures,
  };
}

}  // namespace whirl::inline io

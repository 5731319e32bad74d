#include "libio/figures/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

std::string tolerance_range(const std::vector<double>& tolerances) {
  if (tolerances.empty()) return "";
  const auto [least, largest] = std::minmax_element(tolerances.begin(), tolerances.end());
  return fmt::format("tolerances from {} to {}", format_tolerance(*largest),
                     format_tolerance(*least));
}

WorkPrecision work_precision_of(const WorkPrecisionStudy& study, const Model& model) {
  const WorkPrecisionOptions& options = study.options;
  const auto by_methods = [](const Mat& table) {
    const auto numbers = table.transpose().reshaped();
    return std::vector<double>(numbers.begin(), numbers.end());
  };
  return {.title = model.title.empty() ? "Speed against error" : model.title,
          .subtitle = fmt::format("{}, one core, {}", shown_value(model.speed, "rpm", ".6g"),
                                  tolerance_range(options.tolerances)),
          .methods = options.methods,
          .tolerances = options.tolerances,
          .error = by_methods(study.errors()),
          .time = by_methods(study.times()),
          .revolutions = static_cast<double>(options.revolutions),
          .reference_error = study.reference.error,
          .unit = model.contacts.empty() ? "sizes of the motion" : "clearances"};
}

Figure work_precision_figure(const WorkPrecision& data) {
  Figure f{.kind = "work_precision", .title = data.title, .subtitle = data.subtitle};
  Panel p;
  p.x = {.title = fmt::format("error after {:g} revolution{} [{}]", data.revolutions,
                              data.revolutions == 1.0 ? "" : "s", data.unit),
         .scale = Scale::logarithmic};
  p.y = {.title = "time per revolution [ns]", .scale = Scale::logarithmic};
  const std::size_t columns = data.tolerances.size();
  for (std::size_t i = 0; i < data.methods.size(); ++i) {
    Curve c{.end_name = data.methods[i], .paint = series_paint(i)};
    c.width = 2.0;
    c.has_marker = true;
    c.marker = static_cast<Marker>(i % markers);
    c.size = 8.0;
    for (std::size_t j = 0; j < columns; ++j) {
      const std::size_t k = i * columns + j;
      if (!std::isfinite(data.error[k])) continue;  // it failed
      // nearer to the reference than this nothing is known
      c.x.push_back(std::max(data.error[k], data.reference_error));
      c.y.push_back(1e9 * data.time[k]);
      c.hover.push_back(
          fmt::format("{} at {}", data.methods[i], format_tolerance(data.tolerances[j])));
    }
    if (!c.x.empty()) p.curves.push_back(std::move(c));
  }
  if (data.reference_error > 0.0) {
    p.rules.push_back({Rule::Kind::vertical, data.reference_error, "error of the reference",
                       Paint::gray, Dash::dashed});
  }
  f.panels.push_back(std::move(p));
  return f;
}

namespace {

std::vector<Figure> work_precision_figures(const ResultView& result) {
  using Study = WorkPrecisionStudy;
  const auto& study = figures::result_of<Study>(result);  // without its runs
  WorkPrecision data;
  data.methods = study.options.methods;
  data.tolerances = study.options.tolerances;
  data.error = result.file.numbers(dataset_of<Study>(&Study::errors));
  data.time = result.file.numbers(dataset_of<Study>(&Study::times));
  data.revolutions = result.file.number_attribute(std::string(Study::group), "revolutions");
  data.reference_error = study.reference.error;
  data.unit =
      !result.model || result.model->contacts.empty() ? "sizes of the motion" : "clearances";
  data.title = result.title;
  data.subtitle = fmt::format("{}, one core, {}", figures::speed_text(result),
                              tolerance_range(data.tolerances));
  return {work_precision_figure(data)};
}

}  // namespace

FigureKind work_precision_kind() {
  return {
      .name = "work_precision",
      .title = "Speed against error",
      .summary = "speed against error of the integrators",
      .needs = {dataset_of<WorkPrecisionStudy>(&WorkPrecisionStudy::errors)},
      .make = work_precision_figures,
  };
}

}  // namespace whirl::inline io

#include "libdyn/studies/map.hpp"

#include <fmt/format.h>

#include "libio/results/grid_record.hpp"
#include "libio/text/terminal.hpp"
#include "libio/texts/map_text.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

namespace {

struct MapVerbOptions {
  AxesVerbOptions axes{};
  StepVerbOptions by{};
  StudyVerbOptions study{};
  auto fields() { return std::tie(axes, by, study); }
};

Report run_map(const Invocation& call, const MapVerbOptions& asked) {
  const StudyPoints points = study_points(call, asked.axes, asked.study.kept, 2, 3);
  const StudyModels models = points.models();
  points.first();
  ClassifyOptions classify = study_classify(asked.study);
  classify.rk4_steps = asked.by.rk4_steps();
  const MapOptions options{.grid = points.grid(),
                           .classify = classify,
                           .threads = study_threads(call),
                           .stripe = call.stripe()};
  const auto [result, outcome] = run_study<MapResult>(
      study_keeping(call, points.model(), asked.study.kept, "mapping", asked.by.notes()), points,
      options.grid.points(),
      [&](MapResult earlier, const auto& monitor) {
        return map(models, options, monitor, std::move(earlier));
      },
      [&](std::size_t i) { return points.describe(i); });

  Record record;
  if (call.wants_record()) {
    std::vector<MotionSummary> motions;
    for (const auto& p : result.points) motions.push_back(p ? summary_of(*p) : MotionSummary{});
    record.set("axes", columns::record_value(points.axes(), 1.0));
    record.merge(grid_record(motions, points.grid()));
  }
  const Model& model = points.model();
  const std::string title = "Map" + (model.title.empty() ? "" : ": " + shown_line(model.title));
  Report report = study_report(call, points, outcome, record,
                               fmt::format("{}; {} points\n\n{}", title, result.points.size(),
                                           text_of(result, points.axes())));
  report.add_notes(asked.by.notes());
  return report;
}

}  // namespace

Verb map_verb() {
  return {
      .name = "map",
      .group = "Contact",
      .summary = "a plane of two parameters, or several planes, every point classified",
      .example =
          "whirl map models/jeffcott_stator.toml --over operation.speed=130:160:2rad/s --over "
          "contact.ring.stiffness=10:150:10MN/m --out map.h5",
      .run = run_map,
      .shares_work = true,
  };
}

}  // namespace whirl::inline cli

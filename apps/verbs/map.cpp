#include "libdyn/studies/map.hpp"

#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/map_text.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/study.hpp"

namespace whirl::inline cli {

namespace {

using Entry = std::function<Record(const std::optional<ClassifiedMotion>&)>;

/// An entry of every point, in arrays as deep as there are axes.
Record nested(const MapResult& map, const std::vector<ParameterAxis>& axes, const Entry& entry,
              std::size_t axis = 0, std::size_t first = 0) {
  if (axis == axes.size()) return entry(map.points[first]);
  std::size_t stride = 1;
  for (std::size_t i = axis + 1; i < axes.size(); ++i) stride *= axes[i].values.size();
  Record list = Record::array();
  for (std::size_t i = 0; i < axes[axis].values.size(); ++i) {
    list.add(nested(map, axes, entry, axis + 1, first + i * stride));
  }
  return list;
}

void add_points(Record& record, const MapResult& map, const std::vector<ParameterAxis>& axes) {
  const auto add = [&](const char* key, const std::function<Record(const ClassifiedMotion&)>& of) {
    record.set(key, nested(map, axes, [&](const auto& point) {
                 return point && !point->has_failed() ? of(*point) : Record(nullptr);
               }));
  };
  add("motion", [](const auto& motion) { return Record(name_of(*motion.kind)); });
  add("period_revs", [](const auto& motion) {
    return motion.period > 0 ? Record(motion.period) : Record(nullptr);
  });
  add("regime", [](const auto& motion) { return Record(name_of(motion.regime())); });
  add("lyapunov_max", [](const auto& motion) { return Record(motion.largest_exponent()); });
}

Report run_map(const Invocation& call) {
  const StudySetup setup(call, 2, 3);
  const StudyModels models = setup.models();
  setup.first();
  const MapOptions options{
      .grid = setup.grid(), .classify = setup.classify(), .threads = setup.threads()};
  const auto [result, resumed] = run_study<MapResult>(
      call, setup, {"mapping", options.grid.points()}, [&](const auto& monitor, MapResult earlier) {
        return map(models, options, monitor, std::move(earlier));
      });
  const StudyOutcome outcome = study_outcome(motions_of(result.points), resumed,
                                             [&](std::size_t i) { return setup.describe(i); });

  Report report{.record = begin_record(call, setup.model()), .status = outcome.status};
  note_tables(call, setup.model(), report);
  report.record.set("axes", setup.axes_record());
  add_points(report.record, result, setup.axes());
  report.record.set("resumed", static_cast<long>(resumed));
  const std::string& title = setup.model().title;
  report.text = "Map" + (title.empty() ? "" : ": " + title) +
                fmt::format("; {} points\n\n", result.points.size()) +
                map_picture(result, setup.axes()) + "\n" + map_shares(result, setup.axes());
  add_outcome(call, outcome, report);
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
      .options = study_options({over_option, points_option}),
      .run = run_map,
  };
}

}  // namespace whirl::inline cli

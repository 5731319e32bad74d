#include "libdyn/studies/basins.hpp"

#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/basins_text.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/study.hpp"
#include "libbase/error.hpp"

namespace whirl::inline cli {

namespace {

BasinsOptions basins_options(const Invocation& call, const StudySetup& setup) {
  for (const ParameterAxis& axis : setup.axes()) {
    if (axis.path.starts_with("start.")) continue;
    throw ModelError({"--over " + axis.path}, "",
                     "basins vary the start only, such as start.displaced.1.x; `map` and `sweep` "
                     "vary anything");
  }
  BasinsOptions options{.grid = setup.grid(),
                        .size = call.number("size", ""),
                        .seed = static_cast<std::uint64_t>(call.integer("seed", 0)),
                        .classify = setup.classify(),
                        .threads = setup.threads()};
  if (options.is_random()) {
    options.starts = static_cast<std::size_t>(call.integer("starts"));
  } else if (call.has("starts")) {
    throw ModelError({"--starts " + call.text("starts")}, "",
                     "with --over the starts are those of its values");
  }
  return options;
}

Report run_basins(const Invocation& call) {
  const StudySetup setup(call, 0, 2);
  const StudyModels models = setup.models();
  const BasinsOptions options = basins_options(call, setup);
  setup.first();
  const auto [result, resumed] = run_study<BasinsResult>(
      call, setup, {"starting", options.points()}, [&](const auto& monitor, BasinsResult earlier) {
        return basins(models, options, monitor, std::move(earlier));
      });
  const StudyOutcome outcome = study_outcome(motions_of(result.points), resumed, [](std::size_t i) {
    return fmt::format("start {}", i + 1);
  });

  Report report{.record = begin_record(call, setup.model()), .status = outcome.status};
  note_tables(call, setup.model(), report);
  const auto starts = static_cast<long>(result.points.size());
  report.record.set("starts", starts).set("attractors", basins_entries(result));
  if (!setup.axes().empty()) report.record.set("axes", setup.axes_record());
  report.record.set("resumed", static_cast<long>(resumed));
  const std::string& title = setup.model().title;
  report.text = "Coexisting motions" + (title.empty() ? "" : ": " + title) +
                fmt::format("; {} starts\n\n", starts) + basins_table(result);
  add_outcome(call, outcome, report);
  return report;
}

}  // namespace

Verb basins_verb() {
  return {
      .name = "basins",
      .group = "Contact",
      .summary = "coexisting motions, and how much of the starts each attracts",
      .example =
          "whirl basins models/jeffcott_stator.toml --set contact.ring.stiffness=50e6 --starts 500",
      .options = study_options(
          {{"starts", "N", "starts: that of the model, the others random around it", "256"},
           seed_option,
           start_size_option,
           {"over", "PATH=A:B:STEP",
            "instead of random starts, values of the model's start: "
            "start.displaced.1.x=-1:1:0.1mm"},
           points_option}),
      .run = run_basins,
  };
}

}  // namespace whirl::inline cli

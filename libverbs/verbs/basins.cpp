#include "libdyn/studies/basins.hpp"

#include <fmt/format.h>

#include "libio/text/terminal.hpp"
#include "libio/texts/basins_text.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

namespace {

struct BasinsVerbOptions {
  Option<long> starts{"starts", "N", "starts: that of the model, the others random around it", 256,
                      start_range};
  Option<std::uint64_t> seed{"seed", "S", "of the random starts", 1, seed_range};
  Option<double> size = start_size_option();
  AxesVerbOptions axes{.over = {"over", "PATH=A:B:STEP",
                                "instead of random starts, values of the model's start: "
                                "start.displaced.1.x=-1:1:0.1mm"}};
  StudyVerbOptions study{};
  auto fields() { return std::tie(starts, seed, size, axes, study); }
};

BasinsOptions basins_options(const Invocation& call, const BasinsVerbOptions& asked,
                             const StudyPoints& points) {
  for (const ParameterAxis& axis : points.axes()) {
    if (axis.path.starts_with("start.")) continue;
    throw wrong_option("over", axis.path,
                       "basins vary the start only, such as start.displaced.1.x; `map` and `sweep` "
                       "vary anything");
  }
  BasinsOptions options{.grid = points.grid(),
                        .size = *asked.size,
                        .seed = *asked.seed,
                        .classify = study_classify(asked.study),
                        .threads = study_threads(call),
                        .stripe = call.stripe()};
  if (options.is_random()) {
    options.starts = static_cast<std::size_t>(*asked.starts);
  } else if (asked.starts.is_given) {
    throw asked.starts.wrong("with --over the starts are those of its values");
  }
  return options;
}

Report run_basins(const Invocation& call, const BasinsVerbOptions& asked) {
  const StudyPoints points = study_points(call, asked.axes, asked.study.kept, 0, 2);
  const StudyModels models = points.models();
  const BasinsOptions options = basins_options(call, asked, points);
  points.first();
  const auto [result, outcome] = run_study<BasinsResult>(
      study_keeping(call, points.model(), asked.study.kept, "starting"), points, options.points(),
      [&](BasinsResult earlier, const auto& monitor) {
        return basins(models, options, monitor, std::move(earlier));
      },
      [](std::size_t i) { return fmt::format("start {}", i + 1); });

  const BasinShares shares = basin_shares(result);
  Record record = record_of(shares);
  if (!points.axes().empty()) record.set("axes", columns::record_value(points.axes(), 1.0));
  const Model& model = points.model();
  const std::string title =
      "Coexisting motions" + (model.title.empty() ? "" : ": " + shown_line(model.title));
  return study_report(call, points, outcome, record,
                      fmt::format("{}; {} starts\n\n{}", title, shares.starts, text_of(shares)));
}

}  // namespace

Verb basins_verb() {
  return {
      .name = "basins",
      .group = "Contact",
      .summary = "coexisting motions, and how much of the starts each attracts",
      .example =
          "whirl basins models/jeffcott_stator.toml --set contact.ring.stiffness=50e6 --starts 500",
      .run = run_basins,
      .shares_work = true,
  };
}

}  // namespace whirl::inline cli

#include "libdyn/studies/sweep.hpp"

#include "libio/texts/sweep_text.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

namespace {

struct SweepVerbOptions {
  AxesVerbOptions axes{};
  Flag fresh{"fresh", "every value from the model's start, not from the one before"};
  Option<long> sections{"sections", "N", "Poincare sections kept of a motion", 64,
                        Whole{1, 10'000}};
  Option<long> spectra{"spectra", "N", "revolutions of a value's spectrum, 0: none", 32,
                       Whole{0, 10'000}};
  Option<std::string> stations{
      "stations", "NAME,...",
      "of sections and spectra: names, node numbers, all; left out: contacts, disks, bearings"};
  StudyVerbOptions study{};
  auto fields() { return std::tie(axes, fresh, sections, spectra, stations, study); }
};

SweepOptions sweep_options(const Invocation& call, const SweepVerbOptions& asked,
                           const StudyPoints& points) {
  SweepOptions options{.values = points.axes()[0].values,
                       .start = asked.fresh ? SweepStart::fresh : SweepStart::carried,
                       .classify = study_classify(asked.study),
                       .threads = study_threads(call),
                       .stripe = call.stripe()};
  if (!options.stripe.is_all() && !asked.fresh) {
    throw asked.study.part.wrong("a sweep that goes from value to value has no parts; --fresh has");
  }
  options.classify.sections = *asked.sections;
  const StudyMember first = points.first();
  options.portrait = {
      .stations = select_points(first.model, first.scene->assembler, asked.stations.value_or("")),
      .spectrum_revolutions = *asked.spectra};
  return options;
}

Report run_sweep(const Invocation& call, const SweepVerbOptions& asked) {
  const StudyPoints points = study_points(call, asked.axes, asked.study.kept, 1, 1);
  const ParameterAxis& axis = points.axes()[0];
  const StudyModels models = points.models();
  const SweepOptions options = sweep_options(call, asked, points);
  const std::size_t values = axis.values.size();
  const auto [result, outcome] = run_study<SweepResult>(
      study_keeping(call, points.model(), asked.study.kept, "sweeping"), points,
      asked.fresh ? values : 2 * values,
      [&](SweepResult earlier, const auto& monitor) {
        return sweep(models, options, monitor, std::move(earlier));
      },
      [&](std::size_t i) { return points.describe(i % values); });

  Record record = record_of(axis);
  if (call.wants_record()) {
    const auto entries = [&result = result, &axis](std::size_t way) {
      return columns::record_value(SweepWay{result, axis.values, way}.entries(), 1.0);
    };
    if (result.probes.size() > 0) {
      record.set("probes", columns::record_value(result.probes.list(), 1.0));
    }
    if (!result.leaves_out("support")) {
      Record supports = Record::array();
      for (const std::string& name : result.supports) supports.add(name);
      record.set("supports", std::move(supports));
    }
    record.set("up", entries(0)).set("down", asked.fresh ? Record::array() : entries(1));
  }
  return study_report(call, points, outcome, record,
                      headline("Sweep", points.model()) + text_of(result, axis));
}

}  // namespace

Verb sweep_verb() {
  return {
      .name = "sweep",
      .group = "Contact",
      .summary = "bifurcation diagram and spectra along one parameter, up and down",
      .example =
          "whirl sweep models/jeffcott_stator.toml --over operation.speed=130:140:0.5rad/s --out "
          "sweep.h5",
      .run = run_sweep,
      .shares_work = true,
  };
}

}  // namespace whirl::inline cli

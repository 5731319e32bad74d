#include "libio/texts/work_precision_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libio/text/format.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

constexpr double sensitive = 100.0;       ///< growth of deviations that is worth a line
constexpr double poor_reference = 1e-10;  ///< its own error

/// A number of a run by a format; "-" if it failed.
auto of_good_run(double (*number)(const TimedRun&), double divisor, const char* format) {
  return [=](const TimedRun& run) {
    return run.has_failed() ? "-" : texts::number_text(number(run) / divisor, format);
  };
}

std::string runs_table(const WorkPrecisionStudy& study) {
  const auto revolutions = static_cast<double>(study.options.revolutions);
  const auto steps = [](const TimedRun& run) { return static_cast<double>(run.steps()); };
  const auto evaluations = [](const TimedRun& run) {
    return static_cast<double>(run.evaluations());
  };
  return table_of(
      study.runs,
      {shown("method"),
       {"tolerance", [](const TimedRun& r) { return format_tolerance(r.tolerance); }},
       shown("error", "", ".1e"),
       {"ns/revolution", of_good_run([](const TimedRun& r) { return r.time; }, 1e-9, ".0f")},
       {"steps/rev", of_good_run(steps, revolutions, ".1f")},
       {"evaluations/rev", of_good_run(evaluations, revolutions, ".1f")}});
}

std::string failures_text(const WorkPrecisionStudy& study) {
  std::string text;
  for (const TimedRun& run : study.runs) {
    if (!run.has_failed()) continue;
    text += fmt::format("  {} at {} failed: {}\n", run.method, format_tolerance(run.tolerance),
                        run.failure().text());
  }
  return text.empty() ? "" : "\n" + text;
}

/// How a small deviation grows, where it grows much.
std::string growth_text(const WorkPrecisionStudy& study) {
  const ReferenceMotion& reference = study.reference;
  if (reference.growth <= sensitive) return "";
  const std::string size =
      reference.is_lost()
          ? "until it is as large as the motion"
          : fmt::format(
                "{:.2g} times, e times every {:.2g} revolutions", reference.growth,
                static_cast<double>(study.options.revolutions) / std::log(reference.growth));
  return fmt::format(
      "  over these revolutions a small deviation grows {}:\n"
      "  the motion is chaotic or unstable, and so grow the errors of steps; fewer --revolutions\n"
      "  show the methods alone\n",
      size);
}

}  // namespace

std::string text_of(const WorkPrecisionStudy& study, const Model& model) {
  if (study.runs.empty()) return "  stopped before the first run\n";
  const ReferenceMotion& reference = study.reference;
  std::string text = runs_table(study) + failures_text(study);
  text += fmt::format(
      "\n  error: the largest after {} revolution{}, displacements by {},\n"
      "  velocities by that times the speed, against {}, whose own error is about {:.0e}\n",
      study.options.revolutions, study.options.revolutions == 1 ? "" : "s",
      model.contacts.empty() ? "the size of the motion" : "the smallest clearance",
      reference.made_by, reference.error);
  text += growth_text(study);
  if (reference.error > poor_reference) {
    text += fmt::format(
        "  warning: the reference is no better than {:.0e}; errors near or below that say "
        "nothing\n",
        reference.error);
  }
  return text + (study.is_whole ? "" : "  stopped before the end\n");
}

}  // namespace whirl::inline io

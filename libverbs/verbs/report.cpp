#include <fmt/format.h>

#include <filesystem>

#include "libbase/error.hpp"
#include "libio/page/report_page.hpp"
#include "libio/results/replace_file.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/command/version.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/result_input.hpp"

namespace whirl::inline cli {

namespace {

struct ReportVerbOptions {
  Option<std::string> out =
      output_option("out", "FILE.html", "the page; left out: beside the result", ".html .htm");
  Option<std::string> frequency = frequency_option();
  auto fields() { return std::tie(out, frequency); }
};

Report run_report(const Invocation& call, const ReportVerbOptions& options) {
  require_result(call, "");
  std::vector<std::unique_ptr<ResultView>> results;
  results.push_back(std::make_unique<ResultView>(call.file));
  for (const std::string& file : call.words) results.push_back(std::make_unique<ResultView>(file));
  for (const auto& result : results) set_frequency_unit(options.frequency, *result);
  const std::string out =
      options.out.value_or(std::filesystem::path(call.file).replace_extension(".html").string());
  FileReplacement{out, call.picture_replaces()};  // a wrong place is said before the work
  const ReportPage page = report_page(results, version);
  if (page.figures == 0) {
    throw FileError(fmt::format("{} holds nothing that can be drawn", call.file));
  }
  replace_file(out, page.html, call.picture_replaces());
  Report report = begin_report(call);
  report.record.set("figures", page.figures);
  report.record.set("files", file_list({out}));
  report.text = fmt::format("  {}: {} figures, {:.1f} MB; open it in a browser\n", out,
                            page.figures, 1e-6 * static_cast<double>(page.html.size()));
  return report;
}

}  // namespace

Verb report_verb() {
  return {
      .name = "report",
      .group = "Results",
      .summary = "one HTML page with every figure of a result",
      .takes = "RESULT.h5",
      .takes_more = "OTHER.h5",
      .takes_more_help = "further results on the same page",
      .example = "whirl report run.h5 --out run.html",
      .run = run_report,
  };
}

}  // namespace whirl::inline cli

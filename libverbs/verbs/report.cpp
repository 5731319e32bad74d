#include <fmt/format.h>

#include <filesystem>

#include "libbase/error.hpp"
#include "libio/page/paper_report.hpp"
#include "libio/page/pdf_file.hpp"
#include "libio/page/report_page.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/encoding.hpp"
#include "libio/text/file_bytes.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/command/version.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/result_input.hpp"

namespace whirl::inline cli {

namespace {

struct ReportVerbOptions {
  Option<std::string> out =
      output_option("out", "FILE.html",
                    "the page, or a printed report: FILE.pdf; left out: a page beside the result",
                    ".html .htm .pdf");
  Option<std::string> paper =
      file_option("template", "FILE.html",
                  "a house's own page around a printed report, with places for its parts");
  ListOption cover{"cover", "KEY=VALUE",
                   "a word of the cover, instead of [report] of the model; may be given "
                   "several times"};
  Option<std::string> frequency = frequency_option();
  auto fields() { return std::tie(out, paper, cover, frequency); }
};

using Results = std::vector<std::unique_ptr<ResultView>>;

Results results_of(const Invocation& call, const ReportVerbOptions& options) {
  require_result(call, "");
  Results results;
  results.push_back(std::make_unique<ResultView>(call.file));
  for (const std::string& file : call.words) results.push_back(std::make_unique<ResultView>(file));
  call.adopt_units(results.front()->model ? results.front()->model->source : "");
  for (const auto& result : results) set_frequency_unit(options.frequency, *result);
  return results;
}

/// A report for paper.
void print_report(const Invocation& call, const ReportVerbOptions& options, const std::string& out,
                  Report& report) {
  const Results results = results_of(call, options);
  PaperTemplate around;
  if (options.paper) {
    const auto page = file_bytes(*options.paper, FileKind::stream, most_text_bytes);
    if (!page) throw FileError(fmt::format("{}: {}", *options.paper, page.problem));
    around = {*options.paper, *page};
  }
  const PaperReport paper =
      paper_report(results, cover_of(results, version, options.cover.values), around);
  write_pdf(paper.html, out, call.picture_replaces());
  report.record.set("figures", paper.figures);
  report.text = fmt::format("  {}: {} figures, {} tables\n", out, paper.figures, paper.tables);
}

/// A page for the screen.
void write_page(const Invocation& call, const ReportVerbOptions& options, const std::string& out,
                Report& report) {
  const Results results = results_of(call, options);
  const ReportPage page = report_page(results, cover_of(results, version, options.cover.values));
  if (page.figures == 0) {
    throw FileError(fmt::format("{} holds nothing that can be drawn", call.file));
  }
  replace_file(out, page.html, call.picture_replaces());
  report.record.set("figures", page.figures);
  report.text = fmt::format("  {}: {} figures, {:.1f} MB; open it in a browser\n", out,
                            page.figures, 1e-6 * static_cast<double>(page.html.size()));
}

Report run_report(const Invocation& call, const ReportVerbOptions& options) {
  const std::string out =
      options.out.value_or(std::filesystem::path(call.file).replace_extension(".html").string());
  const bool is_printed = lower_case(std::filesystem::path(out).extension().string()) == ".pdf";
  if (options.paper && !is_printed) {
    throw options.paper.wrong("is for a printed report: --out FILE.pdf");
  }
  FileReplacement{out, call.picture_replaces()};  // a wrong place is said before the work
  Report report = begin_report(call);
  (is_printed ? print_report : write_page)(call, options, out, report);
  report.record.set("files", file_list({out}));
  return report;
}

}  // namespace

Verb report_verb() {
  return {
      .name = "report",
      .group = "Results",
      .summary = "one HTML page with every figure of a result, or a printed report (PDF)",
      .takes = "RESULT.h5",
      .takes_more = "OTHER.h5",
      .takes_more_help = "further results on the same page",
      .example = "whirl report run.h5 --out run.html",
      .run = run_report,
  };
}

}  // namespace whirl::inline cli

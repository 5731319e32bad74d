#include "libbase/error.hpp"
#include "libio/results/columns.hpp"
#include "libio/texts/status_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

Report run_status(const Invocation& call) {
  if (call.output.out) throw ModelError({"--out"}, "", "there is nothing to write but --json");
  Report report = begin_report(call);
  Record studies = Record::array();
  std::vector<std::string> files{call.file};
  files.insert(files.end(), call.words.begin(), call.words.end());
  for (const std::string& file : files) {
    const StudyStatus status = study_status(file);
    studies.add(record_of(status));
    report.text += text_of(status);
  }
  report.record.set("studies", studies);
  return report;
}

}  // namespace

Verb status_verb() {
  return {
      .name = "status",
      .group = "Results",
      .summary = "how far studies are, running ones too",
      .takes = "RESULT.h5",
      .takes_more = "OTHER.h5",
      .takes_more_help = "further studies",
      .example = "whirl status map.h5",
      .run = run_status,
  };
}

}  // namespace whirl::inline cli

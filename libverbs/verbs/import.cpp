#include <fmt/format.h>

#include <filesystem>

#include "libio/import/import_file.hpp"
#include "libio/texts/import_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

struct ImportVerbOptions {
  Option<std::string> out =
      output_option("out", "MODEL.toml",
                    "where the model goes; left out: beside the file, with this ending", ".toml");
  auto fields() { return std::tie(out); }
};

Report run_import(const Invocation& call, const ImportVerbOptions& options) {
  if (!call.sets.empty()) throw ModelError({"--set"}, "", "is for models; set it in the model");
  const std::filesystem::path file = call.file;
  const std::filesystem::path place =
      options.out.value_or(std::filesystem::path(file).replace_extension("toml").string());
  const Imported imported = import_file(file, place, call.picture_replaces());
  Report report = begin_report(call, imported.model);
  report.record.merge(record_of(imported));
  report.text = text_of(imported);
  return report;
}

}  // namespace

Verb import_verb() {
  return {
      .name = "import",
      .group = "The model",
      .summary = "a rotor saved by ROSS as a model",
      .takes = "FILE",
      .example = "whirl import models/layered_ross.json --out rotor.toml",
      .run = run_import,
  };
}

}  // namespace whirl::inline cli

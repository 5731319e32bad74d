#include "apps/invocation.hpp"

#include <filesystem>

#include "apps/program.hpp"
#include "apps/verb.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline cli {

std::string Invocation::text(const std::string& option) const {
  if (has(option)) return given.at(option);
  const auto spec = option_named(*verb_named(verb), option);
  return spec ? std::string(spec->otherwise) : "";
}

std::string Invocation::text_or(const std::string& option, const std::string& otherwise) const {
  return has(option) ? given.at(option) : otherwise;
}

ModelError Invocation::wrong(const std::string& option, std::string problem) const {
  return wrong_option(option, text(option), std::move(problem));
}

long Invocation::integer(const std::string& option, long least) const {
  return parsed(option, [&](const std::string& value) { return parse_whole(value, least); });
}

long Invocation::integer_or(const std::string& option, long otherwise, long least) const {
  return has(option) ? integer(option, least) : otherwise;
}

double Invocation::number(const std::string& option, std::string_view unit) const {
  return parsed(option, [&](const std::string& value) { return parse_as(value, unit); });
}

std::vector<double> Invocation::speeds(const Model& model) const {
  return has("speeds") ? parsed("speeds", parse_speeds) : usual_speeds(model.speed);
}

Model Invocation::model() const {
  if (model_text.empty()) return read_model(file, sets);
  return parse_model(model_text, file, sets, std::filesystem::path(file).parent_path());
}

Call Invocation::parts() const {
  Call parts{.verb = verb, .file = file, .words = words, .sets = sets_before};
  parts.sets.insert(parts.sets.end(), sets.begin(), sets.end());
  for (const std::string& values : over) parts.options.push_back("--over=" + values);
  for (const auto& [name, value] : given) {
    const bool is_flag = option_named(*verb_named(verb), name)->is_flag();
    parts.options.push_back(is_flag ? "--" + name : "--" + name + "=" + value);
  }
  return parts;
}

Replaces Invocation::result_replaces() const {
  return has("force") ? Replaces::anything : Replaces::own_results;
}

Replaces Invocation::picture_replaces() const {
  return has("force") ? Replaces::anything : Replaces::own_pictures;
}

CommandFiles Invocation::files(const std::string& json) const {
  const std::string_view kind = option_named(*verb_named(verb), "out")->value;
  return {.input = model_text.empty() ? file : "",  // a stored model needs no file
          .others = words,
          .from = text("from"),
          .out = text("out"),
          .out_kind = kind == "FILE.h5" ? OutKind::result
                      : kind == "NAME"  ? OutKind::stem
                                        : OutKind::picture,
          .svg = has("svg") ? std::optional(text("svg")) : std::nullopt,
          .json = json == "-" ? "" : json,
          .is_forced = has("force")};
}

std::unique_ptr<ResultWriter> Invocation::result_file(const Model& model) const {
  if (!has("out")) return nullptr;
  auto writer = std::make_unique<ResultWriter>(given.at("out"), result_replaces());
  write_origin(*writer, {parts(), line, version}, model);
  return writer;
}

}  // namespace whirl::inline cli

#include "libverbs/command/invocation.hpp"

#include <filesystem>

#include "libio/model/model_file.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/interrupt.hpp"
#include "libverbs/command/arithmetic.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/command/version.hpp"

namespace whirl::inline cli {

std::vector<std::string> Invocation::values(std::string_view option) const {
  const auto found = given.find(option);
  return found == given.end() ? std::vector<std::string>{} : found->second;
}

std::string Invocation::text(std::string_view option) const {
  const std::vector<std::string> all = values(option);
  return all.empty() ? "" : all.back();
}

Model Invocation::model() const {
  const auto stored = NamedFiles::of_sets_in(std::filesystem::path(file).parent_path());
  if (made) return *made;
  if (ranks && !ranks->leads()) return parse_model(ranks->share({}), file, {}, stored);
  Model model =
      model_text.empty() ? read_model(file, sets) : parse_model(model_text, file, sets, stored);
  if (ranks) ranks->share([&] { return model.source; });
  return model;
}

Call Invocation::parts() const {
  Call parts{.verb = verb, .file = file, .words = words, .sets = sets_before};
  parts.sets.insert(parts.sets.end(), sets.begin(), sets.end());
  std::vector<std::string> lists, others;
  for (const auto& [name, values] : given) {
    const OptionSpec option = option_named(*verb_named(verb), name).value();
    for (const std::string& value : values) {
      (option.is_list ? lists : others)
          .push_back(option.is_flag() ? "--" + name : "--" + name + "=" + value);
    }
  }
  lists.insert(lists.end(), others.begin(), others.end());
  // what is set has its place, and how a call is told is no part of its result
  parts.options = options_without(lists, {"set", "speed", "json", "quiet"});
  return parts;
}

Stripe Invocation::stripe() const {
  return stripe_named(text("part"));
}

std::string Invocation::out_file() const {
  return output.out ? part_place(*output.out, stripe()).string() : "";
}

Replaces Invocation::result_replaces() const {
  return output.force ? Replaces::anything : Replaces::own_results;
}

Replaces Invocation::picture_replaces() const {
  return output.force ? Replaces::anything : Replaces::own_pictures;
}

CommandFiles Invocation::files() const {
  const std::string json = output.json.value_or("");
  const std::string_view kind = option_named(*verb_named(verb), "out")->value;
  return {.input = model_text.empty() ? file : "",  // a stored model needs no file
          .others = words,
          .from = text("from"),
          .out = out_file(),
          .out_kind = kind == "FILE.h5" ? OutKind::result
                      : kind == "NAME"  ? OutKind::stem
                                        : OutKind::picture,
          .svg = given.contains("svg") ? std::optional(text("svg")) : std::nullopt,
          .json = json == "-" ? "" : json,
          .is_forced = output.force};
}

std::unique_ptr<ResultWriter> Invocation::begun(std::unique_ptr<ResultWriter> to,
                                                const Model& model) const {
  write_origin(*to, {parts(), line, version}, model);
  return to;
}

std::unique_ptr<ResultWriter> Invocation::result_file(const Model& model) const {
  if (!output.out) return kept_file(model);
  return begun(std::make_unique<ResultWriter>(out_file(), result_replaces(), kept), model);
}

std::unique_ptr<ResultWriter> Invocation::kept_file(const Model& model) const {
  return kept ? begun(std::make_unique<ResultWriter>(*kept), model) : nullptr;
}

std::unique_ptr<ResultWriter> Invocation::saved_file(const Model& model) const {
  if (!output.out) return nullptr;
  return begun(std::make_unique<ResultWriter>(out_file(), result_replaces()), model);
}

void Invocation::prepare() {
  output = read_options<OutputOptions>(given);
  if (!ranks) adopt_arithmetic(text("isa"));  // ranks have agreed on one
  require_free_places(files());
}

std::function<bool()> Invocation::stop_asked() const {
  if (is_stopped) return is_stopped;
  install_interrupt_handler();
  return is_interrupted;
}

}  // namespace whirl::inline cli

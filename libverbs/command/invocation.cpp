#include "libverbs/command/invocation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "libio/measured/law_file.hpp"
#include "libio/model/model_file.hpp"
#include "libio/model/report_words.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/output_lock.hpp"
#include "libio/text/files_in_use.hpp"
#include "libio/text/interrupt.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/text/shown_units.hpp"
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

void Invocation::adopt_units(const std::string& model) const {
  const char* usual = std::getenv("WHIRL_UNITS");
  std::string list = usual ? usual : "";
  const bool has_table = model.find("[report]") != std::string::npos;
  const std::string of_model = has_table ? report_words(model).units : "";
  if (!of_model.empty()) list = of_model;
  if (output.units) list = *output.units;
  const auto units = ShownUnits::named(list, model);
  if (!units && output.units) throw output.units.wrong(units.problem);
  if (!units) {
    throw ModelError({of_model.empty() ? "WHIRL_UNITS=" + list : file}, "units", units.problem);
  }
  show_in(*units);
}

Model Invocation::model() const {
  const auto stored =
      NamedFiles::of_sets_in(std::filesystem::path(file).parent_path()).with(law_table);
  if (made) return *made;
  if (ranks && !ranks->leads()) return parse_model(ranks->share({}), file, {}, stored);
  Model model = model_text.empty() ? read_model(file, sets, law_table)
                                   : parse_model(model_text, file, sets, stored);
  require_said_start(model);
  adopt_units(model.source);
  if (ranks) ranks->share([&] { return model.source; });
  return model;
}

Model Invocation::variant(const std::vector<std::string>& more) const {
  const auto stored =
      NamedFiles::of_sets_in(std::filesystem::path(file).parent_path()).with(law_table);
  if (made) return parse_model(made->source, file, more, stored);
  std::vector<std::string> all = sets;
  all.insert(all.end(), more.begin(), more.end());
  return model_text.empty() ? read_model(file, all, law_table)
                            : parse_model(model_text, file, all, stored);
}

void Invocation::require_said_start(const Model& model) const {
  const auto is_start = [](const std::string& set) { return set.starts_with("start.file="); };
  if (joins || model_text.empty() || model.start.from != StartFrom::file ||
      given.contains("from") || !option_named(*verb_named(verb), "from") ||
      std::any_of(sets.begin(), sets.end(), is_start)) {
    return;
  }
  throw FileError(fmt::format(
      "the stored model starts from another file, {}, and a result does not say what is "
      "opened: add --from with its name",
      model.start.file));
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
  if (!output.out) return "";
  return joins ? *output.out : part_place(*output.out, stripe()).string();
}

Replaces Invocation::result_replaces() const {
  return output.force ? Replaces::anything : Replaces::own_results;
}

Replaces Invocation::picture_replaces() const {
  return output.force ? Replaces::anything : Replaces::own_pictures;
}

void Invocation::note_read_files() const {
  const Verb& called = *verb_named(verb);
  const auto take_down = [](const std::string& place, const std::string& by) {
    const std::string problem = problem_of_reading(place, by);
    if (!problem.empty()) throw FileError(fmt::format("cannot read {}: {}", place, problem));
  };
  if (model_text.empty() && !made) take_down(file, "it is the input of this command");
  if (called.takes_more.ends_with(".h5")) {
    for (const std::string& word : words) take_down(word, "this command reads it");
  }
  for (const OptionSpec& option : options_of(called)) {
    if (option.use != FileUse::read) continue;
    const std::string given_file = text(option.name);
    const bool is_several = option.value.ends_with(",...");
    for (const std::string& name : is_several ? split(given_file, ',') : std::vector{given_file}) {
      take_down(name, fmt::format("--{} reads it", option.name));
    }
  }
}

void Invocation::note_written_files() {
  std::vector<std::string> places;
  for (const OptionSpec& option : options_of(*verb_named(verb))) {
    const bool is_last = option.name == "json", is_out = option.name == "out";
    if (!option.writes() || !given.contains(option.name)) continue;
    const std::string named = text(option.name);
    const bool is_printed = is_last && named == "-";
    const std::string place = is_out ? out_file() : named;
    if (option.use == FileUse::written && !is_printed) {
      const std::string problem =
          problem_of_output(place, "--" + std::string(option.name), is_last);
      if (!problem.empty()) throw FileError(fmt::format("cannot write {}: {}", place, problem));
    }
    const std::string problem = ending_problem(named, option.endings);
    if (!problem.empty()) throw wrong_option(std::string(option.name), named, problem);
    if (option.use != FileUse::written || is_printed) continue;
    // what replaces files of its own kind looks at them itself
    const bool is_result = is_out && option.value == "FILE.h5";
    const bool is_picture = is_last || option.name == "svg";
    require_place(place, is_result    ? result_replaces()
                         : is_picture ? picture_replaces()
                                      : Replaces::anything);
    places.push_back(place);
  }
  // not before all are known to be right; whoever comes second is refused before it does anything
  for (const std::string& place : places) locks_.push_back(std::make_shared<OutputLock>(place));
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
  adopt_units("");
  if (!ranks) adopt_arithmetic(text("isa"));  // ranks have agreed on one
  note_read_files();
  note_written_files();
}

std::function<bool()> Invocation::stop_asked() const {
  if (is_stopped) return is_stopped;
  install_interrupt_handler();
  if (ranks) is_interrupted();  // whoever serves others is not to end before them
  return is_interrupted;
}

}  // namespace whirl::inline cli

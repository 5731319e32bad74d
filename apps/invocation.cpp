#include "apps/invocation.hpp"

#include <fmt/format.h>

#include <cassert>
#include <charconv>
#include <filesystem>

#include "apps/verb.hpp"
#include "apps/version.hpp"
#include "libbase/constants.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/units.hpp"
#include "libio/text/value_range.hpp"

namespace whirl::inline cli {

namespace {

constexpr int default_speeds = 101;

ModelError option_error(const std::string& option, const std::string& value, std::string message) {
  return ModelError({fmt::format("--{} {}", option, value)}, "", std::move(message));
}

}  // namespace

std::string Invocation::text(const std::string& option) const {
  if (has(option)) return given.at(option);
  const auto spec = option_named(*verb_named(verb), option);
  return spec ? std::string(spec->otherwise) : "";
}

std::string Invocation::text_or(const std::string& option, const std::string& otherwise) const {
  return has(option) ? given.at(option) : otherwise;
}

long Invocation::integer(const std::string& option, long least) const {
  const std::string value = text(option);
  assert(has(option) || !value.empty());
  long number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  constexpr long most = 1'000'000'000;
  if (error != std::errc{} || end != value.data() + value.size() || number < least ||
      number > most) {
    throw option_error(option, value, fmt::format("expected a whole number of {} or more", least));
  }
  return number;
}

long Invocation::integer_or(const std::string& option, long otherwise, long least) const {
  return has(option) ? integer(option, least) : otherwise;
}

double Invocation::number(const std::string& option, std::string_view unit) const {
  const std::string given_or_default = text(option);
  assert(has(option) || !given_or_default.empty());
  const auto value = parse_as(given_or_default, unit);
  if (!value) throw option_error(option, given_or_default, value.problem);
  return *value;
}

std::vector<double> Invocation::speeds(const Model& model) const {
  if (has("speeds")) {
    const auto range = parse_range(given.at("speeds"), "rad/s");
    if (!range) throw option_error("speeds", given.at("speeds"), range.problem);
    if (range->first < 0.0)
      throw option_error("speeds", given.at("speeds"), "expected speeds of zero or more");
    return range->step ? values(*range) : values(*range, default_speeds);
  }
  const double last = model.speed > 0.0 ? 1.5 * model.speed : 10'000.0 * rpm;
  return values(ValueRange{0.0, last, {}}, default_speeds);
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

void Invocation::require_free_places(const std::string& json) const {
  const auto refuse = [](const std::string& place, std::string_view reason) {
    throw FileError(fmt::format("cannot write {}: {}", place, reason));
  };
  const std::string out = text("out");
  // what is read is not to be lost, whether --force is given or not; a stored model needs no file
  const auto require_no_input = [&](const std::string& place) {
    if (model_text.empty() && is_same_file(place, file)) {
      refuse(place, "it is the input of this command");
    }
    for (const std::string& other : words) {
      if (is_same_file(place, other)) refuse(place, "this command reads it");
    }
  };
  const std::string_view kind = option_named(*verb_named(verb), "out")->value;
  if (!out.empty() && kind == "FILE.h5") {
    FileReplacement{out, result_replaces()};  // what is wrong with it is said before the work
  }
  const bool is_stem = kind == "NAME";
  if (!out.empty() && !is_stem) require_no_input(out);
  if (has("svg")) {
    require_no_input(text("svg"));
    FileReplacement{text("svg"), picture_replaces()};
  }
  if (json.empty() || json == "-") return;
  require_no_input(json);
  if (has("from") && is_same_file(json, text("from"))) refuse(json, "--from reads it");
  if (!out.empty() && is_same_file(json, out)) refuse(json, "--out and --json name the same file");
  FileReplacement{json, picture_replaces()};
}

std::unique_ptr<ResultWriter> Invocation::result_file(const Model& model) const {
  if (!has("out")) return nullptr;
  auto writer = std::make_unique<ResultWriter>(given.at("out"), result_replaces());
  write_origin(*writer, {parts(), line, version}, model);
  return writer;
}

}  // namespace whirl::inline cli

#include "libio/model/free_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"
#include "libio/model/config.hpp"
#include "libio/model/model_keys.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline io {

namespace {

/// A part of --free.
struct AskedParameter {
  std::string text, path, bounds;  ///< "a.b=1:2", "a.b", "1:2"
};

std::vector<AskedParameter> asked_parameters(const std::string& list) {
  std::vector<AskedParameter> asked;
  for (const std::string& text : split(list, ',')) {
    const std::size_t equals = std::min(text.find('='), text.size());
    AskedParameter one{text, text.substr(0, equals),
                       equals < text.size() ? text.substr(equals + 1) : ""};
    if (one.path.empty() || (one.bounds.empty() && equals < text.size())) {
      throw wrong_option("free", text,
                         "expected PATH or PATH=LOW:HIGH, such as "
                         "contact.seal.friction=0.05:0.4");
    }
    for (const AskedParameter& other : asked) {
      if (other.path == one.path) throw wrong_option("free", list, one.path + " is there twice");
    }
    asked.push_back(std::move(one));
  }
  return asked;
}

/// The value of a model as it stands in its file; null: there is none.
const ConfigNode* written_value(ConfigNode& root, const std::string& path) {
  try {
    return &value_at(root, path);
  } catch (const ModelError&) {
    return nullptr;
  }
}

ParameterAxis axis_of(const AskedParameter& asked, const ConfigNode& value) {
  using enum ConfigNode::Kind;
  const bool is_number = value.kind == integer || value.kind == real;
  if (is_number || value.kind == string) {
    const std::string text = is_number ? fmt::format("{:.17g}", value.number) : value.text;
    const auto axis = parse_axis(asked.path + "=" + text, 0);
    if (axis && axis->values.size() == 1) return *axis;
  }
  throw wrong_option("free", asked.text,
                     fmt::format("expected a number of the model, found {}", value.as_written()));
}

ParameterAxis bounds_of(const AskedParameter& asked) {
  const auto bounds = parse_axis(asked.path + "=" + asked.bounds, 2);
  if (asked.bounds.find(':') == std::string::npos || !bounds || bounds->values.size() != 2 ||
      !(bounds->values[0] < bounds->values[1])) {
    throw wrong_option("free", asked.text,
                       "expected bounds, the lower one first, such as PATH=0.05:0.4");
  }
  return *bounds;
}

/// What the reader of models asks for at a path; null: no quantity.
const AskedKey* quantity_at(const std::string& path) {
  static const Key root = model_keys();
  const Key* key = &root;
  for (const std::string& part : split(path, '.')) {
    const auto named = [&](const std::string& name) -> const Key* {
      for (const Key::Entry& e : key->entries) {
        if (e.name == name) return &e.key;
      }
      return nullptr;
    };
    const Key* next = named(part);
    if (!next) next = named("[]");
    if (!next) next = named("*");
    if (!next) return nullptr;
    key = next;
  }
  return key->find(AskedKey::Form::quantity);
}

/// The least value of a range; of positive ones next to nothing beside where a search begins.
double least_of(Range range, double start) {
  constexpr double next_to_nothing = 1e-6;
  switch (range) {
    case Range::nonnegative:
      return 0.0;
    case Range::positive:
      return next_to_nothing * start;
    default:
      return -std::numeric_limits<double>::infinity();
  }
}

/// @throws ModelError  as free_parameters
void add(const AskedParameter& asked, const ConfigNode* value, FreeParameters& found) {
  FreeParameter p{.path = asked.path};
  std::optional<ParameterAxis> own, bounds;
  if (value) own = axis_of(asked, *value);
  if (!asked.bounds.empty()) bounds = bounds_of(asked);
  if (own && bounds && !own->unit.empty() && !bounds->unit.empty() && own->unit != bounds->unit) {
    throw wrong_option(
        "free", asked.text,
        fmt::format("the bounds are in {}, the value in the model in {}", bounds->unit, own->unit));
  }
  if (bounds) {
    p.lower = bounds->values[0];
    p.upper = bounds->values[1];
  }
  ParameterAxis axis = own && (!own->unit.empty() || !bounds) ? *own : *bounds;
  const AskedKey* quantity = quantity_at(asked.path);
  p.unit = axis.unit.empty() && quantity ? quantity->unit : axis.unit;
  const double start = own ? own->values[0] : 0.0;
  const bool is_in_middle = start == 0.0 && bounds;
  p.start = is_in_middle ? 0.5 * (p.lower + p.upper) : start;
  if (!bounds && quantity) {
    p.lower = least_of(quantity->range, p.start);
    p.is_lower_general = true;
  }
  p.size = p.start != 0.0 ? std::abs(p.start) : bounds ? p.upper - p.lower : 0.0;
  found.parameters.push_back(std::move(p));
  found.axes.push_back(std::move(axis));
}

}  // namespace

std::vector<FreeParameters> free_parameters(const std::vector<Model>& models,
                                            const std::string& list) {
  std::vector<FreeParameters> all;
  const std::vector<AskedParameter> asked = asked_parameters(list);
  std::vector<bool> is_known(asked.size(), false);
  for (const Model& model : models) {
    ConfigNode root = parse_toml(model.source, model.path);
    FreeParameters& found = all.emplace_back();
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const ConfigNode* value = written_value(root, asked[i].path);
      const bool is_new = models.size() == 1 && !asked[i].bounds.empty();
      if (value || is_new) add(asked[i], value, found);
      is_known[i] = is_known[i] || value || is_new;
    }
  }
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (is_known[i]) continue;
    ConfigNode root = parse_toml(models.front().source, models.front().path);
    value_at(root, asked[i].path);  // throws, and says what there is instead
  }
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (all[m].empty()) throw wrong_option("free", list, models[m].path + " has none of these");
  }
  return all;
}

}  // namespace whirl::inline io

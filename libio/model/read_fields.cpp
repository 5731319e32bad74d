#include "libio/model/read_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

TableReader::TableReader(const ConfigNode* table, std::string path, std::vector<Problem>& problems,
                         std::vector<AskedKey>* asked)
    : table_(table), path_(std::move(path)), problems_(problems), asked_(asked) {
  if (asked_) asked_->push_back({.form = AskedKey::Form::table, .path = path_});
  if (table_ && table_->kind != ConfigNode::Kind::table) {
    const bool is_top = path_.find('.') == std::string::npos;
    const bool is_array = table_->kind == ConfigNode::Kind::array;
    problems_.push_back({table_->where, path_,
                         fmt::format("found {}, expected a table{}", table_->as_written(),
                                     is_top && is_array ? ": write [" + path_ + "]" : "")});
    table_ = nullptr;
    is_malformed_ = true;
  }
}

std::string TableReader::path(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

Where TableReader::where(std::string_view key) const {
  const ConfigNode* value = table_ ? table_->find(key) : nullptr;
  return value ? value->where : where();
}

const ConfigNode* TableReader::node(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  note(key, {.form = AskedKey::Form::known});
  return table_ ? table_->find(key) : nullptr;
}

void TableReader::problem(std::string_view key, std::string message) {
  if (is_malformed_) return;
  problems_.push_back({where(key), path(key), std::move(message)});
}

void TableReader::missing(std::string_view key, std::string_view expected,
                          std::vector<std::string> alternatives) {
  if (is_malformed_) return;
  alternatives.emplace_back(key);
  note(key, {.form = AskedKey::Form::missing, .names = alternatives});
  missing_.push_back({std::move(alternatives),
                      {where(), path(key), fmt::format("missing, expected {}", expected)}});
}

void TableReader::unknown_choice(std::string_view key, const std::string& found,
                                 const std::vector<std::string>& known) {
  const auto near = nearest(found, known);
  problem(key, fmt::format("found {}, expected {}{}{}", in_quotes(found),
                           known.size() > 1 ? "one of " : "", fmt::join(known, ", "),
                           near ? fmt::format("; did you mean \"{}\"?", *near) : ""));
}

bool TableReader::in_range(const ConfigNode& value, const std::string& at, double number,
                           Range range, const std::string& expected) {
  const bool is_good = range == Range::any || (range == Range::positive && number > 0.0) ||
                       (range == Range::nonnegative && number >= 0.0);
  if (is_good) return true;
  problems_.push_back({value.where, at,
                       fmt::format("found {}, expected {} {}", value.as_written(), expected,
                                   range == Range::positive ? "above zero" : "of zero or more")});
  return false;
}

std::optional<double> TableReader::quantity(const ConfigNode& value, const std::string& at,
                                            std::string_view unit, Range range) {
  const auto report = [&](std::string message) {
    problems_.push_back({value.where, at, std::move(message)});
  };
  double number = value.number;
  switch (value.kind) {
    case ConfigNode::Kind::integer:
    case ConfigNode::Kind::real:
      break;
    case ConfigNode::Kind::string: {
      const auto parsed = parse_as(value.text, unit);
      if (!parsed) {
        const std::string hint = vendor_hint(value.text, unit);
        report(hint.empty() ? parsed.problem
                            : fmt::format("found {}, expected {}{}", value.as_written(),
                                          expected_quantity(unit), hint));
        return std::nullopt;
      }
      number = *parsed;
      break;
    }
    default:
      report(fmt::format("found {}, expected {}", value.as_written(), expected_quantity(unit)));
      return std::nullopt;
  }
  if (!std::isfinite(number)) {
    report(fmt::format("found {}, expected {}", value.as_written(), expected_quantity(unit)));
    return std::nullopt;
  }
  if (!in_range(value, at, number, range, expected_quantity(unit))) return std::nullopt;
  return number;
}

std::optional<double> TableReader::quantity(std::string_view key, std::string_view unit,
                                            Range range, bool is_required) {
  const ConfigNode* value = node(key);
  note(key, {.form = AskedKey::Form::quantity, .unit = std::string(unit), .range = range});
  if (value) return quantity(*value, path(key), unit, range);
  if (is_required) missing(key, expected_quantity(unit));
  return std::nullopt;
}

std::optional<std::array<double, 2>> TableReader::pair(std::string_view key, std::string_view unit,
                                                       Range range, std::string_view expected) {
  const ConfigNode* value = node(key);
  note(key, {.form = AskedKey::Form::pair, .unit = std::string(unit), .range = range});
  if (!value) return std::nullopt;
  const bool is_list = value->kind == ConfigNode::Kind::array;
  if (!is_list || value->items.size() != 2) {
    const std::string found =
        is_list ? fmt::format("a list of {}", value->items.size()) : value->as_written();
    problem(key, fmt::format("found {}, expected {}", found, expected));
    return std::nullopt;
  }
  const auto first = quantity(value->items[0], path(key), unit, range);
  const auto second = quantity(value->items[1], path(key), unit, range);
  if (!first || !second) return std::nullopt;
  return std::array{*first, *second};
}

std::vector<double> TableReader::list(std::string_view key, std::string_view unit, Range range) {
  const ConfigNode* value = node(key);
  note(key, {.form = AskedKey::Form::list, .unit = std::string(unit), .range = range});
  std::vector<double> numbers;
  if (!value) return numbers;
  if (value->kind != ConfigNode::Kind::array || value->items.empty()) {
    problem(key, fmt::format("found {}, expected a list of one or more",
                             value->items.empty() && value->kind == ConfigNode::Kind::array
                                 ? "an empty list"
                                 : value->as_written()));
    return numbers;
  }
  for (const ConfigNode& item : value->items) {
    if (const auto number = quantity(item, path(key), unit, range)) numbers.push_back(*number);
  }
  return numbers;
}

std::optional<Mat> TableReader::rows(std::string_view key, std::string_view unit) {
  const ConfigNode* value = node(key);
  note(key, {.form = AskedKey::Form::rows, .unit = std::string(unit)});
  if (!value) return std::nullopt;
  const auto is_list = [](const ConfigNode& v) {
    return v.kind == ConfigNode::Kind::array && !v.items.empty();
  };
  const bool is_one_row = is_list(*value) && !is_list(value->items.front());
  const auto count = is_list(*value) && !is_one_row ? value->items.size() : 1;
  const std::size_t length = is_one_row        ? value->items.size()
                             : is_list(*value) ? value->items.front().items.size()
                                               : 0;
  Mat matrix(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(length));
  for (std::size_t i = 0; i < count; ++i) {
    const ConfigNode& row = is_one_row || !is_list(*value) ? *value : value->items[i];
    if (!is_list(row) || row.items.size() != length) {
      problem(key, fmt::format("found {}, expected rows of numbers, all of one length: "
                               "[[1, 2], [3, 4]]",
                               row.as_written()));
      return std::nullopt;
    }
    for (std::size_t j = 0; j < length; ++j) {
      const auto number = quantity(row.items[j], path(key), unit, Range::any);
      if (!number) return std::nullopt;
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = *number;
    }
  }
  return matrix;
}

std::optional<Mat2> TableReader::matrix(std::string_view key, std::string_view unit, Range range) {
  const auto entries = [&](const ConfigNode* of) {
    TableReader table(of, path(key), problems_, asked_);
    Mat2 m = Mat2::Zero();
    for (const int i : {0, 1}) {
      for (const int j : {0, 1}) {
        const std::string name{"xy"[i], "xy"[j]};
        if (const auto v = table.quantity(name, unit, Range::any, i == j)) m(i, j) = *v;
      }
    }
    if (of) table.finish();
    return m;
  };
  const ConfigNode* value = node(key);
  if (value && value->kind == ConfigNode::Kind::table) return entries(value);
  if (asked_) entries(nullptr);  // the schema has both forms
  const auto both = quantity(key, unit, range);
  if (!both) return std::nullopt;
  return Mat2(Mat2::Identity() * *both);
}

std::optional<long> TableReader::integer(std::string_view key, Range range, bool is_required) {
  const ConfigNode* value = node(key);
  note(key, {.form = AskedKey::Form::integer, .range = range});
  if (!value) {
    if (is_required) missing(key, "a whole number");
    return std::nullopt;
  }
  if (value->kind != ConfigNode::Kind::integer) {
    problem(key, fmt::format("found {}, expected a whole number", value->as_written()));
    return std::nullopt;
  }
  constexpr double largest = 1e9;
  if (!in_range(*value, path(key), value->number, range, "a whole number")) return std::nullopt;
  if (std::abs(value->number) > largest) {
    problem(key,
            fmt::format("found {}, expected a number up to {:.0f}", value->as_written(), largest));
    return std::nullopt;
  }
  return static_cast<long>(value->number);
}

void TableReader::at_most(std::string_view key, long value, long most) {
  note(key, {.form = AskedKey::Form::limit, .most = most});
  if (value <= most) return;
  problem(key, fmt::format("found {}, expected a number up to {}", value, most));
}

std::optional<bool> TableReader::boolean(std::string_view key) {
  const ConfigNode* value = node(key);
  note(key, {.form = AskedKey::Form::boolean});
  if (!value) return std::nullopt;
  if (value->kind == ConfigNode::Kind::boolean) return value->boolean;
  problem(key, fmt::format("found {}, expected true or false", value->as_written()));
  return std::nullopt;
}

std::optional<std::string> TableReader::choice(std::string_view key,
                                               const std::vector<std::string>& known) {
  note(key, {.form = AskedKey::Form::choice, .names = known});
  const auto name = text(key, false);
  if (!name) return std::nullopt;
  if (std::find(known.begin(), known.end(), *name) != known.end()) return name;
  unknown_choice(key, *name, known);
  return std::nullopt;
}

std::optional<std::string> TableReader::string(std::string_view key, bool is_required) {
  note(key, {.form = AskedKey::Form::text});
  return text(key, is_required);
}

std::optional<std::string> TableReader::text(std::string_view key, bool is_required) {
  const ConfigNode* value = node(key);
  if (!value) {
    if (is_required) missing(key, "a text");
    return std::nullopt;
  }
  if (value->kind == ConfigNode::Kind::string) return value->text;
  problem(key, fmt::format("found {}, expected a text in quotation marks", value->as_written()));
  return std::nullopt;
}

void TableReader::note(std::string_view key, AskedKey what) {
  if (!asked_) return;
  what.path = path(key);
  asked_->push_back(std::move(what));
}

void TableReader::note_field(std::string_view key, std::string_view meaning,
                             std::string otherwise) {
  note(key, {.form = AskedKey::Form::field,
             .meaning = std::string(meaning),
             .otherwise = std::move(otherwise)});
}

void TableReader::finish() {
  const auto report_missing = [&] {
    for (Missing& m : missing_) problems_.push_back(std::move(m.problem));
    missing_.clear();
  };
  if (!table_) return report_missing();
  for (const auto& [key, value] : table_->entries) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const auto near = nearest(key, known_);
    if (near) {
      std::erase_if(missing_, [&](const Missing& m) {
        return std::find(m.keys.begin(), m.keys.end(), *near) != m.keys.end();
      });
    }
    problems_.push_back(
        {value.key_where, path(key),
         near ? fmt::format("unknown key, did you mean \"{}\"?", *near)
              : fmt::format("unknown key, known here: {}", fmt::join(known_, ", "))});
  }
  report_missing();
}

}  // namespace whirl::inline io

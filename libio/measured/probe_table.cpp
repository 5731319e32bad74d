#include "libio/measured/probe_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libio/model/delimited_table.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

const std::vector<ColumnKind>& probe_columns() {
  static const std::vector<ColumnKind> columns = [] {
    std::vector<ColumnKind> all{{"position", "m"}, {"angle", "rad"}};
    for (const char* words : {"probe", "name", "station", "channel", "unit"}) {
      all.push_back({.name = words, .is_text = true});
    }
    for (const char* numbers : {"gain", "full_scale"}) {
      all.push_back({.name = numbers, .is_text = true, .keeps_unit = true});
    }
    return all;
  }();
  return columns;
}

bool is_key_phasor(const std::string& name) {
  static constexpr std::string_view names[] = {"keyphasor", "keyphase",   "key",    "kph",
                                               "kp",        "phasor",     "tacho",  "tach",
                                               "trigger",   "tachometer", "keyway", "pulse"};
  return std::ranges::find(names, plain_name(name)) != std::end(names);
}

/// A row as a table of a file of probes.
class RowTable {
 public:
  RowTable(const DelimitedRow& row, const std::string& file) : row_(row), file_(file) {
    table_.where = where("");
  }

  bool has(std::string_view column) const {
    return row_.texts.contains(column) || row_.numbers.contains(column);
  }
  void add_text(std::string_view column, std::string_view key) {
    if (!row_.texts.contains(column)) return;
    ConfigNode node;
    node.kind = ConfigNode::Kind::string;
    node.text = row_.text(column);
    add(std::move(node), column, key);
  }
  void add_number(std::string_view column, std::string_view key) {
    const auto number = row_.number(column);
    if (number) add_real(*number, ConfigNode::Kind::real, column, key);
  }
  /// The number of a node, or the name of a body; of a channel likewise.
  void add_text_or_number(std::string_view column, std::string_view key_of_number,
                          std::string_view key_of_text) {
    const std::string text = row_.text(column);
    long number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size()) {
      return add_text(column, key_of_text);
    }
    add_real(static_cast<double>(number), ConfigNode::Kind::integer, column, key_of_number);
  }

  ConfigNode take() { return std::move(table_); }

 private:
  Where where(std::string_view column) const {
    return {file_, row_.line, column.empty() ? 1 : row_.place(column)};
  }
  void add_real(double number, ConfigNode::Kind kind, std::string_view column,
                std::string_view key) {
    ConfigNode node;
    node.kind = kind;
    node.number = number;
    add(std::move(node), column, key);
  }
  void add(ConfigNode node, std::string_view column, std::string_view key) {
    node.where = node.key_where = where(column);
    table_.entries.push_back({std::string(key), std::move(node)});
  }

  const DelimitedRow& row_;
  const std::string& file_;
  ConfigNode table_{};
};

}  // namespace

std::size_t probe_columns_named_in(const std::string& line) {
  return columns_named_in(line, probe_columns());
}

ConfigNode probe_table(const std::string& text, const std::string& file) {
  std::vector<Problem> problems;
  const DelimitedTable table = parse_delimited(text, file, probe_columns(), problems);
  if (problems.empty() && table.rows.empty()) {
    problems.push_back({{file},
                        "",
                        "expected a line of column names, such as probe, position, angle, channel, "
                        "and a row for each probe"});
  }
  if (!problems.empty()) throw ModelError(std::move(problems));
  ConfigNode root, list;
  list.kind = ConfigNode::Kind::array;
  list.where = list.key_where = root.where = {file, table.header, 1};
  for (const DelimitedRow& row : table.rows) {
    RowTable of(row, file);
    if (std::abs(row.number("angle").value_or(0.0)) > turn) {
      problems.push_back(
          {{file, row.line, row.place("angle")},
           "angle",
           "found more than a turn; if the column is in degrees, name it angle [deg]"});
    }
    const std::string_view name = of.has("probe") ? "probe" : "name";
    const bool has_place = of.has("position") || of.has("station");
    const bool is_key = !has_place && is_key_phasor(row.text(name));
    if (!is_key) {
      of.add_text(name, "name");
      of.add_number("position", "at");
      if (!of.has("position")) of.add_text_or_number("station", "node", "body");
      of.add_number("angle", "angle");
      of.add_text("unit", "unit");
      of.add_text("gain", "gain");
    }
    // the record has the channel of a probe by its name, where no column says another one
    of.add_text_or_number(is_key && !of.has("channel") ? name : "channel", "channel", "channel");
    of.add_text("full_scale", "full_scale");
    if (is_key) {
      root.entries.push_back({"keyphasor", of.take()});
    } else {
      list.items.push_back(of.take());
    }
  }
  if (!problems.empty()) {
    tell_once(problems, 0);
    throw ModelError(std::move(problems));
  }
  if (!list.items.empty()) root.entries.push_back({"probe", std::move(list)});
  return root;
}

}  // namespace whirl::inline io

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "libio/model/bearing_table.hpp"
#include "libio/model/model_builder.hpp"

namespace whirl {

std::optional<Mat2> ModelBuilder::matrix(TableReader& table, std::string_view key,
                                         std::string_view unit) {
  const ConfigNode* node = table.node(key);
  if (!node) return std::nullopt;
  if (node->kind != ConfigNode::Kind::table) {
    const auto value = table.quantity(key, unit, Range::nonnegative);
    if (!value) return std::nullopt;
    return Mat2(Mat2::Identity() * *value);
  }
  TableReader entries(node, table.path(key), problems_, asked_);
  Mat2 m = Mat2::Zero();
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      const std::string name{"xy"[i], "xy"[j]};
      if (const auto v = entries.quantity(name, unit, Range::any, i == j)) m(i, j) = *v;
    }
  }
  entries.finish();
  return m;
}

bool ModelBuilder::read_coefficients(TableReader& table, BearingCoefficients& to) {
  bool any = false;
  const std::tuple<const char*, const char*, Mat2*> parts[] = {
      {"stiffness", "N/m", &to.K},
      {"damping", "N.s/m", &to.C},
      {"tilt_stiffness", "N.m/rad", &to.Kt},
      {"tilt_damping", "N.m.s/rad", &to.Ct}};
  for (const auto& [key, unit, part] : parts) {
    any = any || table.has(key);
    if (const auto m = matrix(table, key, unit)) *part = *m;
  }
  return any;
}

void ModelBuilder::read_bearings() {
  for_each("bearing", [&](TableReader& table, std::size_t i) {
    Connection c;
    c.where = table.where();
    c.name = table.string("name").value_or(fmt::format("bearing {}", i + 1));
    if (const auto at = station(table)) c.from = *at;
    if (const auto to = table.string("to")) {
      if (const auto s = named_station(*to, table, "to")) c.to = *s;
    }
    BearingCoefficients value;
    const bool has_values = read_coefficients(table, value);
    c.coefficients = ConstantBearing{value};
    c.is_clamped = table.boolean("clamped").value_or(false);
    c.is_rigid = table.boolean("rigid").value_or(false) || c.is_clamped;

    if (table.node("table")) {
      // a file's name, or its text: results keep the text, so that they can be run again
      if (const auto name = table.string("table")) {
        std::string text = *name;
        const bool is_file = text.find('\n') == std::string::npos;
        if (is_file) {
          std::ifstream file(directory_ / text);
          std::error_code ignored;
          if (!file || std::filesystem::is_directory(directory_ / text, ignored)) {
            table.problem("table",
                          fmt::format("cannot read the file \"{}\"", (directory_ / text).string()));
          } else {
            std::ostringstream content;
            content << file.rdbuf();
            text = content.str();
          }
        }
        if (!is_file || text != *name) {
          std::vector<Problem> wrong;
          c.coefficients = parse_bearing_table(
              text, is_file ? (directory_ / *name).string() : table.path("table"), wrong);
          problems_.insert(problems_.end(), wrong.begin(), wrong.end());
          tables_.push_back({i, text});
        }
      }
      if (has_values)
        table.problem("table", "found a table and coefficients, expected one of them");
      if (c.is_rigid)
        table.problem("table",
                      "a rigid bearing has no coefficients of its own; leave out the table");
    } else if (c.is_rigid && has_values) {
      table.problem("rigid",
                    "a rigid bearing has no stiffness or damping of its own; leave them out");
    } else if (!c.is_rigid && !has_values) {
      table.missing("stiffness",
                    "a stiffness (N/m), damping, rigid = true, clamped = true, or a table",
                    {"damping", "tilt_stiffness", "tilt_damping", "rigid", "clamped", "table"});
    }
    model_.structure.bearings.push_back(c);
  });
}

void ModelBuilder::read_links() {
  for_each("link", [&](TableReader& table, std::size_t i) {
    Connection c;
    c.where = table.where();
    c.name = table.string("name").value_or(fmt::format("link {}", i + 1));
    for (const auto& [key, end] : {std::pair("from", &c.from), std::pair("to", &c.to)}) {
      const ConfigNode* node = table.node(key);
      if (!node) {
        table.missing(key, "a body's name, \"ground\", { at = position } or { node = number }");
      } else if (node->kind == ConfigNode::Kind::table) {
        TableReader inner(node, table.path(key), problems_, asked_);
        if (const auto s = station(inner)) *end = *s;
        inner.finish();
      } else if (const auto name = table.string(key)) {
        if (const auto s = named_station(*name, table, key)) *end = *s;
      }
    }
    BearingCoefficients value;
    const bool has_values = read_coefficients(table, value);
    c.is_clamped = table.boolean("clamped").value_or(false);
    c.is_rigid = table.boolean("rigid").value_or(false) || c.is_clamped;
    if (!has_values && !c.is_rigid) {
      table.missing("stiffness", "a stiffness (N/m), damping, rigid = true or clamped = true",
                    {"damping", "tilt_stiffness", "tilt_damping", "rigid", "clamped"});
    }
    if (has_values && c.is_rigid) {
      table.problem("rigid", "a rigid link has no stiffness or damping of its own; leave them out");
    }
    c.coefficients = ConstantBearing{value};
    model_.structure.links.push_back(c);
  });
}

}  // namespace whirl

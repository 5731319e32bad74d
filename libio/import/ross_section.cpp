#include "libio/import/ross_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::inline io {

RossSection::RossSection(const ConfigNode::Entry& entry, std::vector<Problem>& problems)
    : key_(entry.key), table_(entry.value), problems_(problems) {}

RossSection::RossSection(const RossSection& outer, std::string_view key, const ConfigNode& table)
    : key_(outer.key_), below_(std::string(key) + "."), table_(table), problems_(outer.problems_) {}

std::string RossSection::tag() const {
  const ConfigNode* given = table_.find("tag");
  if (given && given->kind == ConfigNode::Kind::string && !given->text.empty()) {
    return given->text;
  }
  return key_.substr(std::min(key_.size(), key_.find('_') + 1));
}

bool RossSection::has(std::string_view key) const {
  const ConfigNode* value = table_.find(key);
  return value && value->kind != ConfigNode::Kind::other;
}

const ConfigNode* RossSection::find(std::string_view key) const {
  read_.insert(std::string(key));
  return has(key) ? table_.find(key) : nullptr;
}

void RossSection::add_unread(UnreadKeys& unread) const {
  for (const ConfigNode::Entry& entry : table_.entries) {
    if (entry.value.kind == ConfigNode::Kind::other || read_.contains(entry.key)) continue;
    unread.tags[{class_name(), below_ + entry.key}].push_back(tag());
  }
}

double RossSection::number(std::string_view key) const {
  if (const ConfigNode* value = find(key)) return number_of(*value, key);
  problem(where(), key, "is missing, expected a number");
  return 0.0;
}

double RossSection::number_or(std::string_view key, double otherwise) const {
  const ConfigNode* value = find(key);
  return value ? number_of(*value, key) : otherwise;
}

int RossSection::node(std::string_view key) const {
  const double value = number(key);
  if (value != std::floor(value) || value < 0.0 || value > 1e6) {
    problem(find(key) ? find(key)->where : where(), key, "expected a node, a number from 0");
    return 0;
  }
  return static_cast<int>(value);
}

bool RossSection::flag(std::string_view key) const {
  const ConfigNode* value = find(key);
  if (!value) return true;
  if (value->kind != ConfigNode::Kind::boolean) {
    problem(value->where, key,
            fmt::format("found {}, expected true or false", value->as_written()));
  }
  return value->boolean;
}

double RossSection::number_of(const ConfigNode& value, std::string_view key) const {
  const bool is_number =
      value.kind == ConfigNode::Kind::integer || value.kind == ConfigNode::Kind::real;
  if (!is_number || !std::isfinite(value.number)) {
    problem(value.where, key, fmt::format("found {}, expected a number", value.as_written()));
  }
  return is_number && std::isfinite(value.number) ? value.number : 0.0;
}

std::vector<double> RossSection::numbers(std::string_view key) const {
  std::vector<double> list;
  const ConfigNode* value = find(key);
  if (!value) return list;
  if (value->kind != ConfigNode::Kind::array) return {number_of(*value, key)};
  for (const ConfigNode& item : value->items) list.push_back(number_of(item, key));
  return list;
}

void RossSection::problem(const Where& at, std::string_view key, std::string message) const {
  problems_.push_back({at, fmt::format("{}.{}{}", key_, below_, key), std::move(message)});
}

}  // namespace whirl::inline io

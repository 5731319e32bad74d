#include <algorithm>
#include <map>

#include "libio/results/columns.hpp"

namespace whirl::inline io::columns {

namespace {

/// Sets of entries as they grow.
class Sets {
 public:
  explicit Sets(std::string_view group) : group_(group) {}

  void add(const AnyColumn& c) {
    Facts facts = facts_of(c.info);
    const bool is_attribute = c.rank == 0;
    std::size_t set = 0;
    if (facts.is_optional && !is_attribute) {
      set = along(dimension_names(c.info.dimensions).at(0));
      facts.is_optional = false;
    }
    add(set, facts, c.kind, is_attribute);
  }

  void add_rows(const AnyColumn& list) {
    if (list.rows.is_optional) sets_.push_back({});
    const std::size_t set = list.rows.is_optional ? sets_.size() - 1 : 0;
    if (!list.rows.number.empty()) {
      add(set, number_facts(list.rows), ObjectKind::integer, false);
    }
    for (const AnyColumn& c : list.of_row) {
      if (!c.is_in_rows()) continue;
      Facts facts = facts_of(c.info, list.rows.dimension, list.rows.prefix);
      if (facts.is_optional && !c.info.dimensions.empty() && !facts.is_axis) {
        facts.is_optional = false;
        add_optional(facts, c.kind);
      } else {
        add(set, facts, c.kind, false);
      }
    }
  }

  std::vector<ResultSet> finish() &&;

 private:
  void add(std::size_t set, const Facts& f, ObjectKind kind, bool is_attribute) {
    const std::string path = group_ + (is_attribute ? "@" : "/") + f.name;
    sets_[set].entries.push_back(entry_of(path, f, kind));
    if (f.is_axis) axes_[dimension_names(f.dimensions).at(0)] = path;
  }

  /// A dataset of rows that may be missing, with all others along the same dimensions.
  void add_optional(const Facts& f, ObjectKind kind) {
    const std::size_t set = along(f.dimensions);
    add(set, f, kind, false);
    if (sets_[set].entries.size() > 1) return;
    for (const std::string& name : dimension_names(f.dimensions)) {
      if (axes_.contains(name)) sets_[set].needs.push_back(axes_.at(name));
    }
  }

  /// The set of what may be missing along dimensions.
  std::size_t along(const std::string& dimensions) {
    const auto [known, is_new] = optional_.try_emplace(dimensions, sets_.size());
    if (is_new) sets_.push_back({});
    return known->second;
  }

  std::string group_;
  std::vector<ResultSet> sets_ = std::vector<ResultSet>(1);
  std::map<std::string, std::size_t> optional_;  ///< by their first dimension; of rows by all
  std::map<std::string, std::string> axes_;      ///< by their dimension
};

std::vector<ResultSet> Sets::finish() && {
  if (sets_.front().entries.empty()) {
    sets_.erase(sets_.begin());
    return std::move(sets_);
  }
  // the first entry says whether a set is there: it is never missing
  std::stable_partition(sets_.front().entries.begin(), sets_.front().entries.end(),
                        [](const ResultEntry& e) { return !e.is_optional; });
  for (std::size_t i = 1; i < sets_.size(); ++i) {
    sets_[i].needs.push_back(sets_.front().entries.front().path);
  }
  return std::move(sets_);
}

}  // namespace

std::vector<ResultSet> schema_of_columns(std::string_view group, Columns columns) {
  Sets sets(group);
  for (const AnyColumn& c : columns) {
    if (c.is_rows && c.rows.written != Written::in_json) sets.add_rows(c);
    if (c.is_in_files()) sets.add(c);
  }
  return std::move(sets).finish();
}

}  // namespace whirl::inline io::columns

#pragma once
/// A table of a file of ROSS, which knows what of it was read.

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libio/model/config.hpp"

namespace whirl::inline io {

/// Keys that nobody read, and how often: of a class of elements, or of the materials in it.
struct UnreadKeys {
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> tags;
  std::set<std::string> computed;  ///< classes whose keys say what their coefficients come from
};

/// An element of ROSS: a table "CLASS_tag" of the file. It knows which of its keys were read.
class RossSection {
 public:
  RossSection(const ConfigNode::Entry& entry, std::vector<Problem>& problems);
  /// A table in the element.
  RossSection(const RossSection& outer, std::string_view key, const ConfigNode& table);

  std::string class_name() const { return key_.substr(0, key_.find('_')); }
  std::string tag() const;
  const Where& where() const { return table_.key_where; }

  /// Whether there is a value, which is not read by asking.
  bool has(std::string_view key) const;
  /// A value of a key; null: it is not there, or null.
  const ConfigNode* find(std::string_view key) const;
  /// Adds the keys with values that nobody asked for.
  void add_unread(UnreadKeys& unread) const;

  double number(std::string_view key) const;
  double number_or(std::string_view key, double otherwise) const;
  int node(std::string_view key) const;
  /// True where it is left out.
  bool flag(std::string_view key) const;
  double number_of(const ConfigNode& value, std::string_view key) const;
  /// Numbers of a list, or one alone; none where the key is left out.
  std::vector<double> numbers(std::string_view key) const;
  void problem(const Where& at, std::string_view key, std::string message) const;

 private:
  const std::string& key_;
  std::string below_;
  const ConfigNode& table_;
  std::vector<Problem>& problems_;
  mutable std::set<std::string, std::less<>> read_{"tag"};
};

}  // namespace whirl::inline io

#pragma once
/// A model while it is read: what the readers of its tables share.

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libio/model/config.hpp"
#include "libio/model/named_files.hpp"
#include "libio/model/named_places.hpp"
#include "libio/model/read_fields.hpp"
#include "libio/model/response_table.hpp"
#include "libio/text/table_file.hpp"

namespace whirl::inline io {

/// Text of a table of a model that came from a file of its own.
struct FileTable {
  std::string owner;     ///< table that names the file: "bearing", "seal", "shaft", "bow"
  std::size_t item = 0;  ///< of an array of owners, from 0
  std::string key;       ///< which names the file
  std::string text;
  std::optional<FittedLaw> fitted{};  ///< of a response: the law that was made of it
};

/// The first shaft, where the shaft of a rotor is named.
inline constexpr const char* first_shaft_name = "shaft";

/// A station that was given by position and by node number: both must be the same place.
struct DoubleStation {
  Station position;
  int node = 0;
};

/// The tree of a model file, and what has been read of it so far.
class ModelReading {
 public:
  /// @param to  receives every key that is asked for; null: not wanted
  ModelReading(const ConfigNode& tree, NamedFiles named, std::vector<AskedKey>* to = nullptr)
      : root(tree), files(std::move(named)), asked(to) {}

  const ConfigNode& root;
  NamedFiles files;
  std::vector<AskedKey>* asked;
  Model model;
  std::map<std::string, Material> materials;
  std::vector<Problem> problems;
  std::vector<Problem> doubts;         ///< what is right in tables of files and seldom meant
  std::vector<FileTable> file_tables;  ///< a model that is stored has them in it

  std::vector<DoubleStation> double_stations;
  /// A contact whose radius is that of the shaft at its station.
  struct MissingRadius {
    std::size_t contact = 0;
    Where where;
    std::string key;
  };
  std::vector<MissingRadius> missing_radii;
  std::vector<NamedPlace> named_places;  ///< parts that tables of stations name

  void add_problems(const std::vector<Problem>& found) {
    problems.insert(problems.end(), found.begin(), found.end());
  }
  /// Reader of a table of which there is one.
  TableReader table(const char* name) { return {root.find(name), name, problems, asked}; }
  /// Reader of a table at a key of another one.
  TableReader inner(TableReader& outer, std::string_view key) {
    return {outer.node(key), outer.path(key), problems, asked};
  }
  /// Calls f(reader, number from 0) for every element of an array of tables, by name if it has one.
  template <class F>
  void for_each(const char* array, F f);
  /// Calls f(reader) for every element of an array in a table.
  template <class F>
  void for_each_item(TableReader& table, const char* key, const char* expected, F f);

  /// The keys at (with rotor), node and body: a place of the rotor or a stator.
  /// @param instead  keys that do as well as a station
  /// @return  nothing: it is missing or wrong, which is reported
  std::optional<Station> station(TableReader& table, const std::vector<std::string>& instead = {});
  /// A body, the ground, or the place of a rotor beside another station, by its name at a key.
  /// @param beside  station at the other side; nothing: a rotor is no answer
  std::optional<Station> named_station(const std::string& name, TableReader& table,
                                       std::string_view key, bool may_be_ground = true,
                                       const std::optional<Station>& beside = {});
  /// The name of a rotor at a key; empty: the first shaft, or it is wrong, which is reported.
  std::string rotor_at(TableReader& table, std::string_view key);
  /// The body of a station; null: it is on none that is known.
  const Body* body_at(const Station& station) const;
  /// The material that a table names.
  std::optional<Material> material(TableReader& table);
  std::vector<std::string> material_names() const;

  /// A text that a key names by its file, or that stands at the key itself.
  /// @param owner, item  of the table, as in FileTable
  /// @param columns_in  how many columns of this kind of table a line names
  /// @param foreign  what a file of another program is made to; null: such a file is none
  std::optional<NamedText> text_of(TableReader& table, std::string_view key, const char* owner,
                                   std::size_t item,
                                   const std::function<std::size_t(const std::string&)>& columns_in,
                                   const ForeignTable* foreign = nullptr);
};

template <class F>
void ModelReading::for_each(const char* array, F f) {
  const ConfigNode* list = root.find(array);
  if (!list) return;
  if (list->kind != ConfigNode::Kind::array) {
    problems.push_back({list->key_where, array,
                        std::string("expected an array of tables: write [[") + array + "]]"});
    return;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const ConfigNode* name = list->items[i].find("name");
    const bool has_name = name && name->kind == ConfigNode::Kind::string;
    const std::string label = has_name ? name->text : std::to_string(i + 1);
    TableReader table(&list->items[i], std::string(array) + "." + label, problems, asked);
    if (has_name && std::find(names.begin(), names.end(), label) != names.end()) {
      table.problem("name", "another " + std::string(array) + " has this name already");
    }
    names.push_back(label);
    f(table, i);
    table.finish();
  }
}

template <class F>
void ModelReading::for_each_item(TableReader& table, const char* key, const char* expected, F f) {
  const ConfigNode* list = table.node(key);
  if (!list) return;
  if (list->kind != ConfigNode::Kind::array) {
    table.problem(key, "found " + list->as_written() + ", expected " + expected);
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    TableReader item(&list->items[i], table.path(key) + "." + std::to_string(i + 1), problems,
                     asked);
    f(item);
    item.finish();
  }
}

}  // namespace whirl::inline io

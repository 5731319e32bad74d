#pragma once
/// Reading the parts of a model file, one function per kind of table.

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libio/model/config.hpp"
#include "libio/model/named_files.hpp"
#include "libio/model/read_fields.hpp"

namespace whirl::inline fe {
struct Mesh;
}

namespace whirl::inline io {

/// Builds a model from the tree of a file, collecting all problems.
class ModelBuilder {
 public:
  /// @param asked  receives every key that is asked for; null: not wanted
  ModelBuilder(const ConfigNode& root, NamedFiles files, std::vector<AskedKey>* asked = nullptr);

  /// @throws ModelError  with every problem found
  Model build();
  /// The model again, without reading the rotor again: since `base` only contacts, the speed and
  /// the start may have been changed in the tree, and no contact may have moved.
  ///
  /// @throws ModelError  likewise
  Model rebuild(const Model& base);

  /// Text of a table that came from a file of its own.
  struct Table {
    std::string owner;     ///< "bearing", "seal", "shaft", "bow"
    std::size_t item = 0;  ///< of an array of owners, from 0
    std::string key;       ///< which named the file
    std::string text;
  };
  /// The tables that build() read; a model that is stored has them in it.
  const std::vector<Table>& tables() const { return tables_; }
  /// What in these tables is right and seldom meant.
  const std::vector<Problem>& doubts() const { return doubts_; }

 private:
  // model_builder.cpp
  void throw_problems();
  void read_top();
  void read_settings();
  void read_modal_damping(TableReader& table);
  void read_start();
  template <class F>
  void each_item(TableReader& table, const char* key, const char* expected, F f);
  void check_places();
  void check_stations(const Mesh& mesh);
  void set_radii(const Mesh& mesh);
  void check_movable();
  /// @param instead  keys that do as well as a station
  std::optional<Station> station(TableReader& table, const std::vector<std::string>& instead = {});
  std::optional<Station> named_station(const std::string& name, TableReader& table,
                                       std::string_view key, bool may_be_ground = true);
  /// A text that a key names by its file, or that stands at the key itself.
  struct NamedText {
    std::string name;  ///< for messages
    std::string text;
  };
  std::optional<NamedText> table_text(TableReader& table, std::string_view key, const char* owner,
                                      std::size_t item);
  // model_shaft.cpp
  void read_shaft();
  void add_shaft_table(TableReader& table, const Segment& common, std::size_t number);
  void read_layers();
  void read_bow();
  std::optional<Station> place_on_shaft(TableReader& table, std::string_view key);
  void read_diameters(TableReader& table, Section& left, Section& right,
                      const std::vector<std::string>& instead, bool needs_inner);
  std::optional<std::pair<double, double>> diameters(TableReader& table, std::string_view key,
                                                     Range range);
  void read_machine_speeds(TableReader& table);
  void read_rayleigh(TableReader& table, Rayleigh& to);
  // model_rotor.cpp
  void read_materials();
  void read_disks();
  void read_bodies();
  void read_unbalances();
  void read_forces();
  void read_probes();
  std::optional<Material> material(TableReader& table);
  std::vector<std::string> material_names() const;
  std::optional<Unbalance> unbalance(TableReader& table, const Station& at,
                                     std::optional<double> mass);
  /// Reports a key that needs the tilts of its station, if the station is a body without tilts.
  void need_tilts(TableReader& table, const char* key, const Station& at) const;
  // model_contacts.cpp
  void read_contacts();
  // model_films.cpp
  void read_films();
  static Vec2 center(TableReader& table);
  // model_connections.cpp
  void read_supports(const char* array, std::vector<Connection>& to);
  void read_links();
  bool read_kind(TableReader& table, AnyBearing& to);
  std::optional<CoefficientTable> coefficient_table(TableReader& table, std::string_view key);

  /// Calls f(reader, number from 0) for every element of an array of tables, by name if it has one.
  template <class F>
  void for_each(const char* array, F f);

  /// A station that was given by position and by node number: both must be the same place.
  struct DoubleStation {
    Station position;
    int node = 0;
  };
  /// A contact whose radius is that of the shaft at its station.
  struct MissingRadius {
    std::size_t contact = 0;
    Where where;
    std::string key;
  };

  const ConfigNode& root_;
  NamedFiles files_;
  std::vector<Problem> problems_;
  std::vector<Problem> doubts_;
  std::vector<AskedKey>* asked_;
  Model model_;
  std::map<std::string, Material> materials_;
  std::vector<DoubleStation> double_stations_;
  std::vector<MissingRadius> missing_radii_;
  std::vector<Table> tables_;
};

template <class F>
void ModelBuilder::for_each(const char* array, F f) {
  const ConfigNode* list = root_.find(array);
  if (!list) return;
  if (list->kind != ConfigNode::Kind::array) {
    problems_.push_back({list->key_where, array,
                         std::string("expected an array of tables: write [[") + array + "]]"});
    return;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const ConfigNode* name = list->items[i].find("name");
    const bool has_name = name && name->kind == ConfigNode::Kind::string;
    const std::string label = has_name ? name->text : std::to_string(i + 1);
    TableReader table(&list->items[i], std::string(array) + "." + label, problems_, asked_);
    if (has_name && std::find(names.begin(), names.end(), label) != names.end()) {
      table.problem("name", "another " + std::string(array) + " has this name already");
    }
    names.push_back(label);
    f(table, i);
    table.finish();
  }
}

}  // namespace whirl::inline io

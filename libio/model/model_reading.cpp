#include "libio/model/model_reading.hpp"

#include <fmt/format.h>

#include "libio/text/nearest.hpp"
#include "libio/text/table_file.hpp"

namespace whirl::inline io {

namespace {

/// The table that a file of another program becomes, or what is wrong with it.
Parsed<NamedText> converted(ModelReading& reading, TableReader& table, std::string_view key,
                            const ForeignName& name, const ForeignTable& wanted) {
  const NamedFiles& files = reading.files;
  if (!files.convert) {
    return Parsed<NamedText>::failed(fmt::format(
        "cannot read the file {}: files of MATLAB, HDF5 and universal files need a program that "
        "has their libraries",
        in_quotes(name.file)));
  }
  auto found = files.convert(files.folder / name.file, name.part, wanted);
  if (!found) return Parsed<NamedText>::failed(found.problem);
  for (const std::string& doubt : found->doubts) {
    reading.doubts.push_back({table.where(key), table.path(key), doubt});
  }
  return std::move(found.value->table);
}

}  // namespace

/// Results keep the text, so that they can be run again: it may stand at the key itself.
std::optional<NamedText> ModelReading::text_of(
    TableReader& table, std::string_view key, const char* owner, std::size_t item,
    const std::function<std::size_t(const std::string&)>& columns_in, const ForeignTable* foreign) {
  const auto name = table.string(key);
  if (!name) return std::nullopt;
  const Where at = table.where(key);
  const std::string line = at.line > 0 ? fmt::format(":{}", at.line) : "";
  NamedText result{
      at.file.empty() ? table.path(key) : fmt::format("{}{}: {}", at.file, line, table.path(key)),
      *name};
  if (name->find('\n') == std::string::npos) {
    if (!(at.set.empty() ? files.of_text : files.of_sets)) {
      table.problem(key, fmt::format("found {}, expected the lines of the table: a model that is "
                                     "stored has its tables in it, and no file is opened for it",
                                     in_quotes(*name)));
      return std::nullopt;
    }
    const auto of_others = foreign ? foreign_name(*name) : std::nullopt;
    auto file = of_others ? converted(*this, table, key, *of_others, *foreign)
                          : table_file(files.folder, *name, FileKind::regular, columns_in);
    if (!file) {
      table.problem(key, file.problem);
      return std::nullopt;
    }
    result = std::move(*file.value);
  }
  file_tables.push_back({owner, item, std::string(key), result.text});
  return result;
}

std::optional<Station> ModelReading::station(TableReader& table,
                                             const std::vector<std::string>& instead) {
  const bool has_at = table.has("at"), has_node = table.has("node"), has_body = table.has("body");
  Station s{.where = table.where(), .key = table.path("at")};
  const auto at = table.quantity("at", "m", Range::any);
  const auto node = table.integer("node", Range::positive);
  const auto body = table.string("body");
  const std::string rotor = rotor_at(table, "rotor");
  if (table.has("rotor") && !has_at) {
    table.problem("rotor", "goes with at = position, along the axis of the first shaft");
  }
  const bool has_place = has_at || has_node || has_body;
  if (const auto* named = has_place ? nullptr : take_place(named_places, table.path("at"))) {
    return named->at;
  }
  if (!has_place) {
    std::vector<std::string> others{"node", "body"};
    others.insert(others.end(), instead.begin(), instead.end());
    table.missing("at", "a station: at = position, node = number, or body = name", others);
    return std::nullopt;
  }
  if (has_body && (has_at || has_node)) {
    table.problem("body", "found a body and a place on the shaft, expected one of them");
    return std::nullopt;
  }
  if (has_body) return body ? named_station(*body, table, "body", false) : std::nullopt;
  s.where = table.where(has_at ? "at" : "node");
  s.key = table.path(has_at ? "at" : "node");
  if (has_at) {
    if (!at || (has_node && !node)) return std::nullopt;
    s.kind = Station::Kind::position;
    s.z = *at;
    s.rotor = rotor;
    if (has_node) double_stations.push_back({s, static_cast<int>(*node)});
    return s;
  }
  if (!node) return std::nullopt;
  s.kind = Station::Kind::node;
  s.node = static_cast<int>(*node);
  return s;
}

std::optional<Station> ModelReading::named_station(const std::string& name, TableReader& table,
                                                   std::string_view key, bool may_be_ground,
                                                   const std::optional<Station>& beside) {
  Station s{.where = table.where(key), .key = table.path(key)};
  if (may_be_ground && name == "ground") return s;
  const auto& rotors = model.structure.rotors;
  const bool is_first = name == first_shaft_name && !rotors.empty();
  if (beside && (is_first || std::ranges::find(rotors, name, &Rotor::name) != rotors.end())) {
    s.rotor = is_first ? "" : name;
    if (beside->rotor == s.rotor && beside->kind != Station::Kind::body) {
      table.problem(key, fmt::format("{} is the shaft that the part is on, expected another one",
                                     in_quotes(name)));
      return std::nullopt;
    }
    if (beside->kind != Station::Kind::position) {
      table.problem(key, fmt::format("{} is another shaft: the part needs at = position on the "
                                     "shaft beside it, and lies at the same position of both",
                                     in_quotes(name)));
      return std::nullopt;
    }
    s.kind = Station::Kind::position;
    s.z = beside->z;
    return s;
  }
  const auto& bodies = model.structure.bodies;
  const auto is_it = [&](const Body& body) { return !name.empty() && body.name == name; };
  if (std::none_of(bodies.begin(), bodies.end(), is_it)) {
    std::vector<std::string> known;
    if (may_be_ground) known.push_back("ground");
    for (const Body& body : bodies) {
      if (!body.name.empty()) known.push_back(body.name);
    }
    if (beside && !rotors.empty()) known.emplace_back(first_shaft_name);
    for (const Rotor& rotor : rotors) {
      if (beside) known.push_back(rotor.name);
    }
    if (known.empty()) {
      table.problem(key, fmt::format("found {}, but the model has no [[body]]", in_quotes(name)));
    } else {
      table.unknown_choice(key, name, known);
    }
    return std::nullopt;
  }
  s.kind = Station::Kind::body;
  s.body = name;
  return s;
}

std::string ModelReading::rotor_at(TableReader& table, std::string_view key) {
  const auto name = table.string(key);
  if (!name || *name == first_shaft_name) return "";
  std::vector<std::string> known{first_shaft_name};
  for (const Rotor& rotor : model.structure.rotors) known.push_back(rotor.name);
  if (std::ranges::find(known, *name) != known.end()) return *name;
  table.unknown_choice(key, *name, known);
  return "";
}

const Body* ModelReading::body_at(const Station& station) const {
  if (station.kind != Station::Kind::body) return nullptr;
  for (const Body& body : model.structure.bodies) {
    if (body.name == station.body) return &body;
  }
  return nullptr;
}

std::optional<Material> ModelReading::material(TableReader& table) {
  const auto name = table.string("material", true);
  if (!name) return std::nullopt;
  const auto found = materials.find(*name);
  if (found != materials.end()) return found->second;
  if (materials.empty()) {
    table.problem("material", fmt::format("there is no [material.{}]", *name));
  } else {
    table.unknown_choice("material", *name, material_names());
  }
  return std::nullopt;
}

std::vector<std::string> ModelReading::material_names() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : materials) names.push_back(name);
  return names;
}

}  // namespace whirl::inline io

#include "libio/model/model_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfe/assembly/assemble.hpp"
#include "libio/text/encoding.hpp"
#include "libio/text/file_bytes.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// Whether anything has a mass.
bool has_any_mass(const Structure& s) {
  const auto any = [](const auto& parts, auto mass) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const auto& part) { return mass(part) > 0.0; });
  };
  const auto of_layer = [](const Layer& layer) {
    return layer.carries == Carries::stiffness ? 0.0 : layer.material.rho;
  };
  return any(s.shaft, [](const Segment& segment) { return segment.material.rho; }) ||
         any(s.layers, of_layer) || any(s.disks, [](const Disk& disk) { return disk.m; }) ||
         any(s.bodies, [](const Body& body) { return std::max(body.m.x, body.m.y); });
}

}  // namespace

ModelBuilder::ModelBuilder(const ConfigNode& root, NamedFiles files, std::vector<AskedKey>* asked)
    : root_(root), files_(std::move(files)), asked_(asked) {}

Model ModelBuilder::build() {
  read_top();
  read_materials();
  read_bodies();
  read_shaft();
  read_layers();
  read_disks();
  read_supports("bearing", model_.structure.bearings);
  read_supports("seal", model_.structure.seals);
  read_links();
  read_unbalances();
  read_forces();
  read_probes();
  read_contacts();
  read_films();
  read_bow();
  read_settings();
  check_places();
  throw_problems();
  return std::move(model_);
}

Model ModelBuilder::rebuild(const Model& base) {
  model_ = base;
  model_.contacts.clear();
  model_.start = {};
  read_contacts();
  read_settings();
  throw_problems();
  model_.structure.stations = base.structure.stations;
  for (const MissingRadius& m : missing_radii_) {
    model_.contacts[m.contact].friction.radius = base.contacts[m.contact].friction.radius;
  }
  return std::move(model_);
}

void ModelBuilder::throw_problems() {
  if (problems_.empty()) return;
  // in the order of the file; what is in other files (tables) comes behind
  const auto place = [&](const Problem& p) {
    const bool is_elsewhere = p.where.line > 0 && p.where.file != root_.where.file;
    return std::tuple(is_elsewhere, p.where.line, p.where.column);
  };
  std::stable_sort(problems_.begin(), problems_.end(),
                   [&](const Problem& a, const Problem& b) { return place(a) < place(b); });
  // a station that is used twice is wrong once
  const auto last =
      std::unique(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {
        return a.where == b.where && a.key == b.key && a.message == b.message;
      });
  problems_.erase(last, problems_.end());
  throw ModelError(problems_);
}

void ModelBuilder::read_top() {
  TableReader top(&root_, "", problems_, asked_);
  const auto format = top.integer("format", Range::any, true);
  if (format && *format != 1) {
    top.problem("format", fmt::format("found {}, expected 1, the only format so far", *format));
  }
  if (const auto title = top.string("title")) model_.title = *title;
  if (const auto g = top.quantity("gravity", "m/s^2", Range::nonnegative))
    model_.structure.gravity = *g;
  for (const char* table : {"operation", "material", "shaft", "layer", "disk", "unbalance", "force",
                            "probe", "bow", "body", "bearing", "seal", "link", "oil_film",
                            "contact", "damping", "reduction", "start"}) {
    top.node(table);
  }
  top.finish();
}

/// Results keep the text, so that they can be run again: it may stand at the key itself.
std::optional<ModelBuilder::NamedText> ModelBuilder::table_text(TableReader& table,
                                                                std::string_view key,
                                                                const char* owner,
                                                                std::size_t item) {
  const auto name = table.string(key);
  if (!name) return std::nullopt;
  const Where at = table.where(key);
  const std::string line = at.line > 0 ? fmt::format(":{}", at.line) : "";
  NamedText result{
      at.file.empty() ? table.path(key) : fmt::format("{}{}: {}", at.file, line, table.path(key)),
      *name};
  if (name->find('\n') == std::string::npos) {
    if (!(at.set.empty() ? files_.of_text : files_.of_sets)) {
      table.problem(key, fmt::format("found {}, expected the lines of the table: a model that is "
                                     "stored has its tables in it, and no file is opened for it",
                                     in_quotes(*name)));
      return std::nullopt;
    }
    const std::filesystem::path path = files_.folder / *name;
    auto content = file_bytes(path, FileKind::regular, most_text_bytes);
    if (content) content = in_utf8(std::move(*content.value));
    if (!content) {
      table.problem(
          key, fmt::format("cannot read the file \"{}\"{}", path.string(),
                           content.problem.starts_with("cannot") ? "" : ": " + content.problem));
      return std::nullopt;
    }
    result = {path.string(), *content};
  }
  tables_.push_back({owner, item, std::string(key), result.text});
  return result;
}

std::optional<Station> ModelBuilder::station(TableReader& table,
                                             const std::vector<std::string>& instead) {
  const bool has_at = table.has("at"), has_node = table.has("node"), has_body = table.has("body");
  Station s{.where = table.where(), .key = table.path("at")};
  const auto at = table.quantity("at", "m", Range::any);
  const auto node = table.integer("node", Range::positive);
  const auto body = table.string("body");
  if (!has_at && !has_node && !has_body) {
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
    if (has_node) double_stations_.push_back({s, static_cast<int>(*node)});
    return s;
  }
  if (!node) return std::nullopt;
  s.kind = Station::Kind::node;
  s.node = static_cast<int>(*node);
  return s;
}

std::optional<Station> ModelBuilder::named_station(const std::string& name, TableReader& table,
                                                   std::string_view key, bool may_be_ground) {
  Station s{.where = table.where(key), .key = table.path(key)};
  if (may_be_ground && name == "ground") return s;
  const auto& bodies = model_.structure.bodies;
  const auto is_it = [&](const Body& body) { return !name.empty() && body.name == name; };
  if (std::none_of(bodies.begin(), bodies.end(), is_it)) {
    std::vector<std::string> known;
    if (may_be_ground) known.push_back("ground");
    for (const Body& body : bodies) {
      if (!body.name.empty()) known.push_back(body.name);
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

void ModelBuilder::read_settings() {
  {
    TableReader table(root_.find("operation"), "operation", problems_, asked_);
    if (const auto speed = table.quantity("speed", "rad/s", Range::nonnegative)) {
      model_.speed = *speed;
      model_.has_speed = true;
    }
    read_machine_speeds(table);
    table.finish();
  }
  {
    TableReader table(root_.find("damping"), "damping", problems_, asked_);
    read_rayleigh(table, model_.structure.damping);
    read_modal_damping(table);
    table.finish();
  }
  {
    TableReader table(root_.find("reduction"), "reduction", problems_, asked_);
    table.read(model_.reduction);
    table.finish();
  }
  read_start();
}

/// Speeds of a machine: none may be above the next one.
void ModelBuilder::read_machine_speeds(TableReader& table) {
  MachineSpeeds& s = model_.machine;
  s = {};
  table.read(s);
  const auto check = [&](const char* key, double low, double high, const char* above) {
    if (low > 0.0 && high > 0.0 && low > high) {
      table.problem(key, fmt::format("is above {}", above));
    }
  };
  check("minimum_speed", s.minimum, s.maximum, "maximum_speed");
  check("minimum_speed", s.minimum, s.trip, "trip_speed");
  check("maximum_speed", s.maximum, s.trip, "trip_speed");
}

void ModelBuilder::read_rayleigh(TableReader& table, Rayleigh& to) {
  TableReader rayleigh(table.node("rayleigh"), table.path("rayleigh"), problems_, asked_);
  rayleigh.read(to);
  rayleigh.finish();
}

/// One damping ratio for all modes, or a list of them.
void ModelBuilder::read_modal_damping(TableReader& table) {
  ModalDamping& modal = model_.structure.modal_damping;
  modal = {};
  const ConfigNode* node = table.node("modal");
  if (node && node->kind == ConfigNode::Kind::array) {
    modal.ratios = table.list("modal", "", Range::nonnegative);
  } else if (const auto common = table.quantity("modal", "", Range::nonnegative)) {
    modal = {{*common}, true};
  }
  for (const double ratio : modal.ratios) {
    if (ratio < 1.0) continue;
    table.problem("modal", fmt::format("found {}, expected damping ratios below 1", ratio));
    break;
  }
}

/// Calls f(reader) for every element of an array in a table.
template <class F>
void ModelBuilder::each_item(TableReader& table, const char* key, const char* expected, F f) {
  const ConfigNode* list = table.node(key);
  if (!list) return;
  if (list->kind != ConfigNode::Kind::array) {
    table.problem(key, fmt::format("found {}, expected {}", list->as_written(), expected));
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    TableReader item(&list->items[i], fmt::format("{}.{}", table.path(key), i + 1), problems_,
                     asked_);
    f(item);
    item.finish();
  }
}

void ModelBuilder::read_start() {
  TableReader table(root_.find("start"), "start", problems_, asked_);
  if (const auto from = table.choice<StartFrom>("from")) model_.start.from = *from;
  if (const auto file = table.string("file"); file && !file->empty()) {
    // in the file: beside it; from the command line: as the shell sees it
    const bool is_in_file = table.where("file").line > 0;
    model_.start.file = is_in_file ? (files_.folder / *file).string() : *file;
  }
  if (model_.start.from == StartFrom::file && model_.start.file.empty()) {
    table.missing("file", "the name of a result file to start from");
  }
  each_item(table, "whirl", "[ { mode = 1, amplitude = \"2 mm\" } ]", [&](TableReader& item) {
    WhirlStart w;
    if (const auto mode = item.integer("mode", Range::positive, true))
      w.mode = static_cast<int>(*mode);
    w.where = item.where("mode");
    if (const auto a = item.quantity("amplitude", "m", Range::nonnegative, true)) w.amplitude = *a;
    if (const auto p = item.quantity("phase", "rad", Range::any)) w.phase = *p;
    model_.start.whirl.push_back(w);
  });
  each_item(table, "displaced", "[ { body = \"rotor\", x = \"1 mm\" } ]", [&](TableReader& item) {
    Displaced d;
    if (const auto at = station(item)) d.at = *at;
    for (const auto& [key, unit, to] : {std::tuple{"x", "m", &d.x},
                                        {"y", "m", &d.y},
                                        {"vx", "m/s", &d.vx},
                                        {"vy", "m/s", &d.vy}}) {
      if (const auto value = item.quantity(key, unit, Range::any)) *to = *value;
    }
    model_.start.displaced.push_back(d);
  });
  table.finish();
}

/// Places, masses and radii, which only the mesh knows.
void ModelBuilder::check_places() {
  const Structure& s = model_.structure;
  if (root_.find("shaft") && s.shaft.empty()) return;  // it is no array of tables; that is said
  if (s.shaft.empty() && s.bodies.empty() && problems_.empty()) {
    problems_.push_back({root_.where, "shaft", "missing: a model needs a [[shaft]] or a [[body]]"});
  }
  const bool has_shape = std::all_of(s.shaft.begin(), s.shaft.end(), [](const Segment& segment) {
    return segment.length > 0.0 && segment.left.outer > 0.0 && segment.right.outer > 0.0;
  });
  if (!has_shape) return;
  Mesh mesh;
  try {
    mesh = make_mesh(s);
  } catch (const ModelError& error) {
    problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    return;
  }
  check_stations(mesh);
  if (!problems_.empty()) return;
  if (!has_any_mass(s)) {
    problems_.push_back({root_.where, "",
                         "nothing in this model has a mass: give a material its density, "
                         "or add a disk or a body that has one"});
    return;
  }
  set_radii(mesh);
  check_movable();
}

void ModelBuilder::check_stations(const Mesh& mesh) {
  const Structure& s = model_.structure;
  for (const Station* station : all_stations(s)) {
    try {
      resolve(*station, s, mesh);
    } catch (const ModelError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    }
  }
  for (const DoubleStation& d : double_stations_) {
    if (d.node > mesh.nodes()) {
      problems_.push_back(
          {d.position.where, d.position.key,
           fmt::format("found node {}, expected a node from 1 to {}", d.node, mesh.nodes())});
    } else if (resolve(d.position, s, mesh).index != d.node - 1) {
      problems_.push_back(
          {d.position.where, d.position.key,
           fmt::format("{:g} mm and node {}, which is at {:g} mm, are different places; give one",
                       1e3 * d.position.z, d.node,
                       1e3 * mesh.z[static_cast<std::size_t>(d.node - 1)])});
    }
  }
}

/// Gives contacts without a radius that of the shaft at their station.
void ModelBuilder::set_radii(const Mesh& mesh) {
  const Structure& s = model_.structure;
  for (const MissingRadius& m : missing_radii_) {
    Contact& contact = model_.contacts[m.contact];
    const Point point = resolve(contact.at, s, mesh);
    if (point.kind != Point::Kind::node) {
      if (contact.friction.mu == 0.0 || contact.friction.slip != Slip::actual) continue;
      problems_.push_back({m.where, m.key,
                           "missing, expected a length (m): friction on a body needs the "
                           "radius of the contact for its slip velocity"});
      continue;
    }
    contact.friction.radius =
        0.5 * shaft_diameter(s, mesh, mesh.z[static_cast<std::size_t>(point.index)]);
  }
}

void ModelBuilder::check_movable() {
  const Structure& s = model_.structure;
  try {
    const System movable = Assembler{s}.uncondensed(0.0);
    if (movable.M.norm() == 0.0) {
      throw ModelError({}, "", "all that has a mass is held: nothing that can move has one");
    }
  } catch (const ModelError& error) {
    // these speak of a bearing, seal or link by its name; here its path is known
    for (Problem problem : error.problems()) {
      for (const auto& [kind, list] : s.connections()) {
        for (const Connection& c : list) {
          if (problem.where == c.where && problem.key == c.name)
            problem.key = fmt::format("{}.{}", kind, c.name);
        }
      }
      if (problem.where.file.empty()) problem.where = root_.where;
      problems_.push_back(problem);
    }
  }
}

}  // namespace whirl::inline io

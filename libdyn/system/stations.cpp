#include "libdyn/system/stations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline dyn {

namespace {

struct Label {
  Point point;
  std::string name;
};

std::vector<Label> labels(const Model& model, const Assembler& assembler) {
  std::vector<Label> all;
  for (const Disk& d : model.structure.disks) all.push_back({assembler.point(d.at), d.name});
  for (const Contact& c : model.contacts) {
    if (!c.limits) all.push_back({assembler.point(c.at), c.name});
  }
  for (const OilFilm& f : model.films) all.push_back({assembler.point(f.at), f.name});
  for (const auto* list : {&model.structure.bearings, &model.structure.seals}) {
    for (const Connection& c : *list) all.push_back({assembler.point(c.from), c.name});
  }
  for (const GearPair& g : model.structure.gears) {
    for (const Station* wheel : {&g.driving, &g.driven})
      all.push_back({assembler.point(*wheel), g.name});
  }
  for (const Support& support : model.structure.supports) {
    for (const Station* at : places_of(support))
      all.push_back({assembler.point(*at), support.name});
  }
  for (const Probe& p : model.structure.probes) all.push_back({assembler.point(p.at), p.name});
  return all;
}

}  // namespace

std::string NamedPoint::label() const {
  if (node() == 0) return name;
  return name.empty() ? fmt::format("{}", node()) : fmt::format("{} {}", node(), name);
}

std::vector<NamedPoint> named_points(const Model& model, const Assembler& assembler) {
  const std::vector<Label> all = labels(model, assembler);
  std::vector<NamedPoint> points;
  for (const int node : assembler.mesh().left_to_right)
    points.push_back({{Point::Kind::node, node}, ""});
  for (std::size_t i = 0; i < model.structure.bodies.size(); ++i) {
    points.push_back({{Point::Kind::body, static_cast<int>(i)}, model.structure.bodies[i].name});
  }
  for (NamedPoint& p : points) {
    if (p.point.kind == Point::Kind::body) continue;
    for (const Label& label : all) {
      if (label.point == p.point) p.name += (p.name.empty() ? "" : " + ") + label.name;
    }
  }
  return points;
}

PointNames point_names(const Model& model, const Assembler& assembler) {
  const std::vector<double>& z = assembler.mesh().z;
  PointNames names{.z = Vec::Map(z.data(), std::ssize(z))};
  names.node_names.resize(z.size());
  for (const NamedPoint& p : named_points(model, assembler)) {
    if (p.node() > 0) names.node_names[static_cast<std::size_t>(p.point.index)] = p.name;
  }
  for (const Body& body : model.structure.bodies) names.body_names.push_back(body.name);
  return names;
}

std::vector<NamedPoint> select_points(const Model& model, const Assembler& assembler,
                                      const std::string& list) {
  const std::vector<NamedPoint> all = named_points(model, assembler);
  if (list == "all") return all;
  std::vector<NamedPoint> chosen;
  const auto choose = [&](const NamedPoint& p) {
    const bool is_there = std::any_of(chosen.begin(), chosen.end(),
                                      [&](const NamedPoint& c) { return c.point == p.point; });
    if (!is_there) chosen.push_back(p);
  };
  if (list.empty()) {
    for (const NamedPoint& p : all) {
      if (!p.name.empty()) choose(p);
    }
    return chosen;
  }
  const std::vector<Label> known = labels(model, assembler);
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    int node = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), node);
    const bool is_number = error == std::errc{} && end == part.data() + part.size() && node > 0;
    bool found = false;
    for (const NamedPoint& p : all) {
      const bool by_name =
          !part.empty() &&
          (p.name == part || std::any_of(known.begin(), known.end(), [&](const Label& l) {
             return l.name == part && l.point == p.point;
           }));
      if (!by_name && !(is_number && p.node() == node)) continue;
      choose(p);
      found = true;
      if (!by_name) break;
    }
    if (found) continue;
    std::vector<std::string> names;
    for (const Label& l : known) names.push_back(l.name);
    for (const Body& b : model.structure.bodies) names.push_back(b.name);
    if (const int nodes = assembler.mesh().nodes(); nodes > 0) {
      names.push_back(fmt::format("nodes 1 to {}", nodes));
    }
    throw OptionError("stations", fmt::format("there is no station \"{}\"; there are {}", part,
                                              fmt::join(names, ", ")));
  }
  return chosen;
}

}  // namespace whirl::inline dyn

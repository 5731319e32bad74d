#include "libfe/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

/// Positions closer than this share of the length are one place.
constexpr double same_place = 1e-9;
/// Positions closer than this, but not the same, are taken for a slip of the pen.
constexpr double too_close = 1e-5;

/// More nodes than this are a slip of the pen: their matrices would not fit into the memory.
constexpr double most_nodes = 1e5;

/// Elements of a segment without given number: as long as its mean diameter, and at least
/// a 24th of the shaft; a massless cylinder is exact with one.
int elements_for(const Segment& segment, double piece, double shaft_length) {
  const bool is_cylinder = segment.left.outer == segment.right.outer;
  if (segment.material.rho == 0.0 && is_cylinder) return 1;
  const double diameter = 0.5 * (segment.left.outer + segment.right.outer);
  const double h = std::max(diameter, shaft_length / 24.0);
  return std::max(1, static_cast<int>(std::ceil(piece / h - 1e-9)));
}

/// Segments that cannot be told from a point, beside a shaft so long (or beyond all numbers), and
/// more elements than there can be.
void check_segments(const Structure& structure) {
  std::vector<Problem> problems;
  double elements = 0.0;
  for (const Structure::Shaft& shaft : structure.shafts()) {
    const double length = shaft.length();
    for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
      const Segment& segment = shaft.segments[i];
      const std::string key =
          fmt::format("shaft.{}{}{}", shaft.name, shaft.name.empty() ? "" : ".", i + 1);
      elements += segment.elements;
      if (!(segment.length > same_place * length)) {
        problems.push_back(
            {segment.where, key,
             fmt::format("a segment of {:g} m is no part of a shaft of {:g} m: the two "
                         "are too different in length",
                         segment.length, length)});
      } else if (elements > most_nodes) {
        problems.push_back(
            {segment.where, key, fmt::format("more than {:g} elements in all", most_nodes)});
        break;
      }
    }
  }
  if (!problems.empty()) throw ModelError(problems);
}

/// Positions of nodes that the segments make, where elements are given.
std::vector<double> given_nodes(const Structure::Shaft& shaft) {
  std::vector<double> nodes{shaft.start};
  for (const Segment& segment : shaft.segments) {
    const double from = nodes.back();
    const int n = std::max(1, segment.elements);
    for (int i = 1; i <= n; ++i) nodes.push_back(from + segment.length * i / n);
  }
  return nodes;
}

/// The problem of a position beyond the ends of its shaft.
Problem off_the_shaft(const Station& station, const Structure::Shaft& shaft) {
  const std::string found = fmt::format("{:g} mm is off the shaft", 1e3 * station.z);
  const std::string right =
      shaft.segments.empty()
          ? "the model has no shaft: name a body instead"
          : fmt::format("the shaft{} reaches from {:g} to {:g} mm",
                        shaft.name.empty() ? "" : " of rotor \"" + shaft.name + "\"",
                        1e3 * shaft.start, 1e3 * shaft.end());
  return {station.where, station.key, found + "; " + right};
}

/// Positions on a shaft that need a node, beside those that have one already; in ascending order.
/// @throws ModelError  for stations off the shaft, or nearly but not quite at one place
std::vector<double> wanted_positions(const Structure& structure, const Structure::Shaft& shaft) {
  const double length = shaft.length();
  std::vector<Problem> problems;
  std::vector<double> wanted, taken = given_nodes(shaft);
  for (const Station* station : all_stations(structure)) {
    if (station->kind != Station::Kind::position || station->rotor != shaft.name) continue;
    const double z = station->z;
    if (z < shaft.start - same_place * length || z > shaft.start + (1.0 + same_place) * length) {
      problems.push_back(off_the_shaft(*station, shaft));
      continue;
    }
    const auto close = std::find_if(taken.begin(), taken.end(), [&](double other) {
      return std::abs(other - z) < too_close * length;
    });
    if (close == taken.end()) {
      wanted.push_back(z);
      taken.push_back(z);
    } else if (std::abs(*close - z) > same_place * length) {
      problems.push_back({station->where, station->key,
                          fmt::format("{:.9g} mm and {:.9g} mm are the same place with different "
                                      "numbers; write one of them in both",
                                      1e3 * z, 1e3 * *close)});
    }
  }
  if (!problems.empty()) throw ModelError(problems);
  std::sort(wanted.begin(), wanted.end());
  return wanted;
}

/// Nodes of the mesh that the segments describe, and behind them those of the positions that are
/// wanted inside a segment whose elements are given.
std::vector<double> node_positions(const Structure::Shaft& shaft,
                                   const std::vector<double>& wanted) {
  const double length = shaft.length();
  std::vector<bool> is_used(wanted.size(), false);
  const auto inside = [&](double from, double to) {
    std::vector<double> cuts;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i] > from + same_place * length && wanted[i] < to - same_place * length) {
        cuts.push_back(wanted[i]);
        is_used[i] = true;
      }
    }
    return cuts;
  };
  std::vector<double> z{shaft.start};
  double start = shaft.start;
  for (const Segment& segment : shaft.segments) {
    const double end = start + segment.length;
    std::vector<double> borders;
    if (segment.elements == 0) borders = inside(start, end);
    borders.push_back(end);
    double piece_start = start;
    for (const double piece_end : borders) {
      const double piece = piece_end - piece_start;
      const int n = segment.elements > 0 ? segment.elements : elements_for(segment, piece, length);
      for (int i = 1; i < n; ++i) z.push_back(piece_start + piece * i / n);
      z.push_back(piece_end);
      piece_start = piece_end;
    }
    start = end;
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!is_used[i]) z.push_back(wanted[i]);
  }
  return z;
}

/// Adds the elements between neighboring nodes of a shaft.
/// @param line  its nodes, left to right
void add_elements(Mesh& mesh, const Structure::Shaft& shaft, int number,
                  const std::vector<int>& line) {
  std::size_t segment = 0;
  double start = shaft.start;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const int left = line[i], right = line[i + 1];
    const double middle = 0.5 * (mesh.z[left] + mesh.z[right]);
    while (segment + 1 < shaft.segments.size() && middle > start + shaft.segments[segment].length) {
      start += shaft.segments[segment].length;
      ++segment;
    }
    const double L = shaft.segments[segment].length;
    mesh.elements.push_back({left, right, number, static_cast<int>(segment),
                             (mesh.z[left] - start) / L, (mesh.z[right] - start) / L});
  }
}

/// Adds the nodes and elements of a shaft.
void add_shaft(Mesh& mesh, const Structure& structure, const Structure::Shaft& shaft, int number) {
  const std::vector<double> wanted = wanted_positions(structure, shaft);
  if (shaft.segments.empty()) return;
  const int first = mesh.nodes();
  for (const double z : node_positions(shaft, wanted)) mesh.z.push_back(z);
  mesh.shaft_of.resize(mesh.z.size(), number);
  std::vector<int> line(mesh.z.size() - static_cast<std::size_t>(first));
  std::iota(line.begin(), line.end(), first);
  std::sort(line.begin(), line.end(), [&](int a, int b) { return mesh.z[a] < mesh.z[b]; });
  mesh.left_to_right.insert(mesh.left_to_right.end(), line.begin(), line.end());
  add_elements(mesh, shaft, number, line);
}

/// Adds the layers beside the elements of a mesh.
void add_layers(Mesh& mesh, const Structure& structure) {
  const double slack = same_place * structure.length();
  std::vector<Problem> problems;
  std::vector<LayerSpan> spans;
  for (const Layer& layer : structure.layers) {
    spans.push_back(span_of(layer, structure, mesh));
    if (spans.back().to > spans.back().from + slack) continue;
    problems.push_back({layer.to.where, layer.to.key,
                        fmt::format("the layer ends at {:g} mm, expected a place to the right of "
                                    "{:g} mm, where it begins",
                                    1e3 * spans.back().to, 1e3 * spans.back().from)});
  }
  if (!problems.empty()) throw ModelError(problems);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const int shaft = mesh.elements[e].shaft;
    const double left = mesh.z[static_cast<std::size_t>(mesh.elements[e].left)];
    const double right = mesh.z[static_cast<std::size_t>(mesh.elements[e].right)];
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const auto& [from, to, of_shaft] = spans[i];
      if (of_shaft != shaft) continue;
      if (left < from - slack || right > to + slack) continue;
      mesh.layers.push_back({static_cast<int>(e), static_cast<int>(i), (left - from) / (to - from),
                             (right - from) / (to - from)});
    }
  }
}

}  // namespace

std::vector<const Station*> all_stations(const Structure& structure) {
  std::vector<const Station*> stations;
  for (const Disk& disk : structure.disks) stations.push_back(&disk.at);
  for (const auto& [kind, list] : structure.connections()) {
    for (const Connection& connection : list) {
      stations.push_back(&connection.from);
      stations.push_back(&connection.to);
    }
  }
  for (const GearPair& gears : structure.gears) {
    stations.push_back(&gears.driving);
    stations.push_back(&gears.driven);
  }
  for (const Support& support : structure.supports) {
    for (const auto* coordinates : {&support.sees, &support.acts_on}) {
      for (const InterfaceCoordinate& c : *coordinates) {
        stations.push_back(&c.at);
        stations.push_back(&c.to);
      }
    }
  }
  for (const Unbalance& unbalance : structure.unbalances) stations.push_back(&unbalance.at);
  for (const Force& force : structure.forces) {
    if (force.has_station()) stations.push_back(&force.at);
  }
  for (const Probe& probe : structure.probes) stations.push_back(&probe.at);
  for (const Layer& layer : structure.layers) {
    stations.push_back(&layer.from);
    stations.push_back(&layer.to);
  }
  for (const Station& station : structure.stations) stations.push_back(&station);
  return stations;
}

LayerSpan span_of(const Layer& layer, const Structure& structure, const Mesh& mesh) {
  const auto node = [&](const Station& station) {
    return static_cast<std::size_t>(resolve(station, structure, mesh).index);
  };
  for (const Station* end : {&layer.from, &layer.to}) {
    const bool is_on_shaft =
        end->kind == Station::Kind::position || end->kind == Station::Kind::node;
    if (is_on_shaft && mesh.nodes() > 0) continue;
    throw ModelError(end->where, end->key, "a layer lies on the shaft, from one place to another");
  }
  const std::size_t from = node(layer.from), to = node(layer.to);
  if (mesh.shaft_of[from] != mesh.shaft_of[to]) {
    throw ModelError(layer.to.where, layer.to.key, "a layer lies on one shaft, not on two");
  }
  return {mesh.z[from], mesh.z[to], mesh.shaft_of[from]};
}

double shaft_diameter(const Structure& structure, const Mesh& mesh, double z, int shaft) {
  const Structure::Shaft of = structure.shafts().at(static_cast<std::size_t>(shaft));
  double start = of.start, largest = 0.0;
  const double slack = same_place * of.length();
  const auto add = [&](const Section& left, const Section& right, double from, double length) {
    const double s = (z - from) / length;
    if (z < from - slack || z > from + length + slack) return;
    largest = std::max(largest, between(left, right, std::clamp(s, 0.0, 1.0)).outer);
  };
  for (const Segment& segment : of.segments) {
    add(segment.left, segment.right, start, segment.length);
    start += segment.length;
  }
  for (const Layer& layer : structure.layers) {
    const LayerSpan span = span_of(layer, structure, mesh);
    if (span.shaft == shaft) add(layer.left, layer.right, span.from, span.to - span.from);
  }
  return largest;
}

double diameter_at(const Structure& structure, const Mesh& mesh, int node) {
  const auto at = static_cast<std::size_t>(node);
  return shaft_diameter(structure, mesh, mesh.z.at(at), mesh.shaft_of.at(at));
}

std::optional<int> shaft_of(const Point& point, const Structure& structure, const Mesh& mesh) {
  if (point.kind == Point::Kind::ground) return std::nullopt;
  const auto index = static_cast<std::size_t>(point.index);
  if (point.kind == Point::Kind::node) return mesh.shaft_of.at(index);
  return structure.shaft_named(structure.bodies.at(index).rotor);
}

namespace {

bool stands(const Point& point, const Structure& structure) {
  return point.kind == Point::Kind::body &&
         !structure.bodies.at(static_cast<std::size_t>(point.index)).spins;
}

}  // namespace

double shaft_ratio(const Point& point, const Structure& structure, const Mesh& mesh) {
  const std::optional<int> shaft = shaft_of(point, structure, mesh);
  return shaft ? structure.shafts().at(static_cast<std::size_t>(*shaft)).ratio : 0.0;
}

double spin_ratio(const Point& point, const Structure& structure, const Mesh& mesh) {
  return stands(point, structure) ? 0.0 : shaft_ratio(point, structure, mesh);
}

double shaft_speed(const Point& point, const Structure& structure, const Mesh& mesh, double Omega) {
  const std::optional<int> shaft = shaft_of(point, structure, mesh);
  return shaft ? structure.shafts().at(static_cast<std::size_t>(*shaft)).speed_at(Omega) : 0.0;
}

double spin_speed(const Point& point, const Structure& structure, const Mesh& mesh, double Omega) {
  return stands(point, structure) ? 0.0 : shaft_speed(point, structure, mesh, Omega);
}

std::vector<std::vector<int>> Mesh::lines() const {
  std::vector<std::vector<int>> all;
  int last = -1;
  for (const int node : left_to_right) {
    const int shaft = shaft_of[static_cast<std::size_t>(node)];
    if (shaft != last) all.emplace_back();
    last = shaft;
    all.back().push_back(node);
  }
  return all;
}

Mesh make_mesh(const Structure& structure) {
  check_segments(structure);
  Mesh mesh;
  int number = 0;
  for (const Structure::Shaft& shaft : structure.shafts()) {
    add_shaft(mesh, structure, shaft, number++);
  }
  add_layers(mesh, structure);
  return mesh;
}

Point resolve(const Station& station, const Structure& structure, const Mesh& mesh) {
  switch (station.kind) {
    case Station::Kind::ground:
      return {Point::Kind::ground, 0};
    case Station::Kind::node:
      if (station.node < 1 || station.node > mesh.nodes()) {
        throw ModelError(station.where, station.key,
                         mesh.nodes() == 0
                             ? "the model has no shaft and no nodes: name a body instead"
                             : fmt::format("found node {}, expected a node from 1 to {}",
                                           station.node, mesh.nodes()));
      }
      return {Point::Kind::node, station.node - 1};
    case Station::Kind::body:
      for (std::size_t i = 0; i < structure.bodies.size(); ++i) {
        if (structure.bodies[i].name == station.body) {
          return {Point::Kind::body, static_cast<int>(i)};
        }
      }
      throw ModelError(station.where, station.key,
                       fmt::format("there is no body named \"{}\"", station.body));
    case Station::Kind::position:
      break;
  }
  const std::optional<int> shaft = structure.shaft_named(station.rotor);
  if (!shaft) {
    throw ModelError(station.where, station.key,
                     fmt::format("there is no rotor named \"{}\"", station.rotor));
  }
  int nearest = -1;
  for (int i = 0; i < mesh.nodes(); ++i) {
    if (mesh.shaft_of[static_cast<std::size_t>(i)] != *shaft) continue;
    if (nearest < 0 || std::abs(mesh.z[i] - station.z) < std::abs(mesh.z[nearest] - station.z)) {
      nearest = i;
    }
  }
  const double length = structure.shafts()[static_cast<std::size_t>(*shaft)].length();
  if (nearest < 0 || std::abs(mesh.z[nearest] - station.z) > 2.0 * same_place * length) {
    throw ModelError(station.where, station.key,
                     fmt::format("{:g} mm is not a node of the shaft", 1e3 * station.z));
  }
  return {Point::Kind::node, nearest};
}

}  // namespace whirl::inline fe

#include "libio/export/vtk_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "libio/drawing/disk_shape.hpp"

namespace whirl::inline io {

namespace {

/// Position along the shaft of a point: of a node its own, of a body that of what joins it.
double position(const Model& model, const Assembler& assembler, const Point& point) {
  const Mesh& mesh = assembler.mesh();
  if (const auto z = mesh.position_of(point)) return *z;
  const auto partner = [&](const Station& a, const Station& b) -> std::optional<double> {
    const Point pa = assembler.point(a), pb = assembler.point(b);
    if (pa == point) return mesh.position_of(pb);
    if (pb == point) return mesh.position_of(pa);
    return std::nullopt;
  };
  for (const Contact& c : model.contacts) {
    if (const auto z = partner(c.at, c.against)) return *z;
  }
  for (const auto& [kind, list] : model.structure.connections()) {
    for (const Connection& c : list) {
      if (const auto z = partner(c.from, c.to)) return *z;
    }
  }
  return 0.0;
}

int index_of(const Point& point, const Assembler& assembler) {
  return point.kind == Point::Kind::node ? point.index : assembler.mesh().nodes() + point.index;
}

/// Radius at which a contact touches: of its slip velocity, or the shaft's.
double contact_radius(const Model& model, const Assembler& assembler, const Contact& c) {
  if (c.friction.radius > 0.0) return c.friction.radius;
  const Point p = assembler.point(c.at);
  if (p.kind == Point::Kind::node) {
    return 0.5 * diameter_at(model.structure, assembler.mesh(), p.index);
  }
  return 5.0 * c.clearance;
}

/// Adds the bodies of the rotor. The model gives none of them a width; the radius of one is that at
/// which a contact touches it, or a symbol.
void add_bodies(const Model& model, const Assembler& assembler, VtkScene& scene) {
  double typical = 0.0;  // radius of bodies that no contact touches
  for (const Contact& c : model.contacts) {
    if (!c.limits) typical = std::max(typical, contact_radius(model, assembler, c));
  }
  if (!(typical > 0.0)) typical = 0.1;
  const double length = model.structure.length();
  for (std::size_t i = 0; i < model.structure.bodies.size(); ++i) {
    const Body& body = model.structure.bodies[i];
    if (!body.spins) continue;
    const Point point{Point::Kind::body, static_cast<int>(i)};
    double touched = 0.0;
    for (const Contact& c : model.contacts) {
      if (assembler.point(c.at) == point) touched = std::max(touched, c.friction.radius);
    }
    const double radius = touched > 0.0 ? touched : typical;
    scene.disks.push_back({body.name, index_of(point, assembler), radius, 0.0,
                           symbol_width * std::max(length, 2.0 * radius),
                           touched > 0.0 ? "width" : "size"});
  }
}

/// Bearings and films as pyramids below the rotor; what carries them, and stands on the ground,
/// likewise one floor below.
class Supports {
 public:
  Supports(const Model& model, const Assembler& assembler, VtkScene& scene)
      : model_(model), assembler_(assembler), scene_(scene) {
    constexpr double share = 0.06;  // of the rotor's length, or of its largest diameter
    double length = model.structure.length();
    for (const VtkDisk& d : scene.disks) length = std::max(length, 2.0 * d.outer_radius);
    height_ = share * (length > 0.0 ? length : 1.0);
  }

  void add() {
    for (const Connection& b : model_.structure.bearings) add(b.name, b.from, b.to);
    for (const OilFilm& f : model_.films) add(f.name, f.at, f.against);
    for (const Connection& l : model_.structure.links) {  // foundations; others have no place below
      const bool is_turned = assembler_.point(l.from).kind == Point::Kind::ground;
      const Station &above = is_turned ? l.to : l.from, &under = is_turned ? l.from : l.to;
      if (assembler_.point(under).kind == Point::Kind::ground) add(l.name, above, under);
    }
  }

 private:
  void add(const std::string& name, const Station& a, const Station& b) {
    const Point from = assembler_.point(a), to = assembler_.point(b);
    if (from.kind == Point::Kind::ground) return;
    VtkSupport s{.name = name, .from = index_of(from, assembler_), .width = height_};
    s.z = position(model_, assembler_, from);
    s.tip = below(from);
    s.foot = s.tip + height_;
    if (to.kind != Point::Kind::ground) {
      s.to = index_of(to, assembler_);
      s.foot = std::max(s.foot, below(to));
    }
    scene_.supports.push_back(std::move(s));
  }

  /// How far below the axis a point's part ends [m].
  double below(const Point& point) const {
    double lowest = 0.0;
    const int index = index_of(point, assembler_);
    if (point.kind == Point::Kind::node) {
      return 0.5 * diameter_at(model_.structure, assembler_.mesh(), index);
    }
    for (const VtkDisk& d : scene_.disks) {
      if (d.point == index) lowest = std::max(lowest, d.outer_radius);
    }
    for (const VtkStator& s : scene_.stators) {
      if (s.point == index) lowest = std::max(lowest, s.rotor_radius + s.clearance);
    }
    for (const auto& [kind, list] : model_.structure.connections()) {
      for (const Connection& c : list) {
        const Point from = assembler_.point(c.from);
        if (assembler_.point(c.to) == point && from.kind == Point::Kind::node) {
          lowest = std::max(lowest, below(from) + height_);
        }
      }
    }
    for (const OilFilm& f : model_.films) {
      if (assembler_.point(f.against) == point) {
        lowest = std::max(lowest, below(assembler_.point(f.at)) + height_);
      }
    }
    return lowest;
  }

  const Model& model_;
  const Assembler& assembler_;
  VtkScene& scene_;
  double height_ = 0.0;
};

}  // namespace

VtkScene vtk_scene(const Model& model, const Assembler& assembler) {
  const Structure& s = model.structure;
  const Mesh& mesh = assembler.mesh();
  VtkScene scene;
  scene.z = mesh.z;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    scene.z.push_back(position(model, assembler, {Point::Kind::body, static_cast<int>(i)}));
  }
  for (const MeshElement& e : mesh.elements) {
    const Segment& segment = s.segments_of(e.shaft)[static_cast<std::size_t>(e.segment)];
    scene.shaft.push_back(
        {e.left, e.right, 0.5 * segment.at(e.from).outer, 0.5 * segment.at(e.to).outer});
  }
  for (const MeshLayer& piece : mesh.layers) {
    const Layer& layer = s.layers[static_cast<std::size_t>(piece.layer)];
    const MeshElement& e = mesh.elements[static_cast<std::size_t>(piece.element)];
    scene.shaft.push_back({e.left, e.right,
                           0.5 * between(layer.left, layer.right, piece.from).outer,
                           0.5 * between(layer.left, layer.right, piece.to).outer});
  }
  for (const Disk& d : s.disks) {
    const DiskShape shape = disk_shape(d, model, assembler);
    scene.disks.push_back({d.name, assembler.point(d.at).index, shape.outer_radius,
                           shape.inner_radius, shape.width, shape.not_given});
  }
  add_bodies(model, assembler, scene);
  for (const Contact& c : model.contacts) {
    if (c.limits) continue;
    const Point at = assembler.point(c.at), against = assembler.point(c.against);
    scene.stators.push_back(
        {c.name, against.kind == Point::Kind::body ? index_of(against, assembler) : -1,
         position(model, assembler, at), c.offset, contact_radius(model, assembler, c), c.clearance,
         0.0, geometry_of(c)});
    scene.contacts.push_back({c.name, index_of(at, assembler)});
  }
  Supports(model, assembler, scene).add();
  return scene;
}

std::vector<VtkFrame> vtk_mode_frames(const Mode& mode, const DofMap& dofs, const VtkScene& scene,
                                      int frames) {
  const CVec full = dofs.T * mode.shape;
  std::vector<VtkFrame> result;
  const double period = 2.0 * std::numbers::pi / mode.frequency();
  for (int k = 0; k < frames; ++k) {
    const double share = static_cast<double>(k) / frames;
    const Vec now = (full * std::polar(1.0, 2.0 * std::numbers::pi * share)).real();
    VtkFrame frame{.time = share * period, .motion = Mat::Zero(dofs.nodes + dofs.bodies(), 4)};
    Eigen::Index row = 0;
    for (const Point& p : dofs.points()) {
      for (int c = 0; c < 4; ++c) {
        if (const int i = dofs.full_index(p, c); i >= 0) frame.motion(row, c) = now(i);
      }
      ++row;
    }
    frame.forces.resize(scene.contacts.size());
    result.push_back(std::move(frame));
  }
  const double amplitude = vtk_fitting_scale(scene, result);
  for (VtkFrame& frame : result) frame.motion *= amplitude;
  return result;
}

VtkFrame vtk_frame(const Model& model, const Assembler& assembler, double time, const Vec& full,
                   const Vec& normal, const Vec& friction) {
  const DofMap& dofs = assembler.dofs();
  VtkFrame frame{.time = time, .motion = Mat::Zero(dofs.nodes + dofs.bodies(), 4)};
  Eigen::Index row = 0;
  for (const Point& p : dofs.points()) {
    for (int c = 0; c < 4; ++c) {
      if (const int i = dofs.full_index(p, c); i >= 0) frame.motion(row, c) = full(i);
    }
    ++row;
  }
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const Contact& c = model.contacts[i];
    if (c.limits) continue;  // the last ones
    const Point at = assembler.point(c.at), against = assembler.point(c.against);
    Vec2 d = -c.offset;
    for (const int k : {X, Y}) {
      d(k) += full(dofs.full_index(at, k));
      if (const int j = dofs.full_index(against, k); j >= 0) d(k) -= full(j);
    }
    const Vec2 n = normal_of(geometry_of(c), c.clearance, d);
    const Vec2 t(-n(1), n(0));
    const auto j = static_cast<Eigen::Index>(i);
    const double radius = contact_radius(model, assembler, c);
    VtkForce force{.arm = {radius * n(0), radius * n(1), 0.0}};
    force.is_touching = normal(j) > 0.0;
    force.force = -normal(j) * n - friction(j) * t;
    frame.forces.push_back(force);
  }
  return frame;
}

}  // namespace whirl::inline io

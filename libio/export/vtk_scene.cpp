#include "libio/export/vtk_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libio/drawing/disk_shape.hpp"

namespace whirl::inline io {

namespace {

/// Position along the shaft of a point: of a node its own, of a body that of what joins it.
double position(const Model& model, const Assembler& assembler, const Point& point) {
  if (point.kind == Point::Kind::node)
    return assembler.mesh().z[static_cast<std::size_t>(point.index)];
  const auto partner = [&](const Station& a, const Station& b) -> double {
    const Point pa = assembler.point(a), pb = assembler.point(b);
    if (pa == point && pb.kind == Point::Kind::node)
      return assembler.mesh().z[static_cast<std::size_t>(pb.index)];
    if (pb == point && pa.kind == Point::Kind::node)
      return assembler.mesh().z[static_cast<std::size_t>(pa.index)];
    return -1.0;
  };
  for (const Contact& c : model.contacts) {
    if (const double z = partner(c.at, c.against); z >= 0.0) return z;
  }
  for (const auto& [kind, list] : model.structure.connections()) {
    for (const Connection& c : list) {
      if (const double z = partner(c.from, c.to); z >= 0.0) return z;
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
    const Mesh& mesh = assembler.mesh();
    return 0.5 * shaft_diameter(model.structure, mesh, mesh.z[static_cast<std::size_t>(p.index)]);
  }
  return 5.0 * c.clearance;
}

/// Adds the bodies of the rotor. The model gives none of them a width; the radius of one is that at
/// which a contact touches it, or a symbol.
void add_bodies(const Model& model, const Assembler& assembler, VtkScene& scene) {
  double typical = 0.0;  // radius of bodies that no contact touches
  for (const Contact& c : model.contacts)
    typical = std::max(typical, contact_radius(model, assembler, c));
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
    const Segment& segment = s.shaft[static_cast<std::size_t>(e.segment)];
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
    const Point at = assembler.point(c.at), against = assembler.point(c.against);
    scene.stators.push_back(
        {c.name, against.kind == Point::Kind::body ? index_of(against, assembler) : -1,
         position(model, assembler, at), c.offset, contact_radius(model, assembler, c), c.clearance,
         0.0, geometry_of(c)});
    scene.contacts.push_back({c.name, index_of(at, assembler)});
  }
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

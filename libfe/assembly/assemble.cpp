#include "libfe/assembly/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "libbase/numerics/sparse_lu.hpp"
#include "libbase/system/interruption.hpp"
#include "libfe/assembly/collector.hpp"
#include "libfe/assembly/modal_damping.hpp"
#include "libfe/assembly/support_equations.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libfe/mesh/elements/body.hpp"
#include "libfe/mesh/elements/connection.hpp"
#include "libfe/mesh/elements/disk.hpp"
#include "libfe/mesh/elements/gear.hpp"
#include "libfe/mesh/rigid_ties.hpp"
#include "libfe/mesh/shaft_elements.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

std::vector<int> indices(const DofMap& dofs, const Point& point) {
  std::vector<int> index(4);
  for (int c = 0; c < 4; ++c) index[c] = dofs.full_index(point, c);
  return index;
}

std::vector<int> indices(const DofMap& dofs, const Point& from, const Point& to) {
  std::vector<int> index = indices(dofs, from);
  const std::vector<int> other = indices(dofs, to);
  index.insert(index.end(), other.begin(), other.end());
  return index;
}

bool is_identity(const Sparse& T) {
  return T.rows() == T.cols();
}

Sparse project(const Sparse& T, const Sparse& A) {
  if (is_identity(T)) return A;
  if (A.nonZeros() == 0) return Sparse(T.cols(), T.cols());
  return T.transpose() * Sparse(A * T);
}

/// Largest magnitude in each row.
Vec row_sizes(const Sparse& A) {
  Vec size = Vec::Zero(A.rows());
  for (int j = 0; j < A.outerSize(); ++j) {
    for (Sparse::InnerIterator it(A, j); it; ++it) {
      size(it.row()) = std::max(size(it.row()), std::abs(it.value()));
    }
  }
  return size;
}

/// Degrees of freedom without inertia whose damping is beta times their stiffness, with one common
/// beta.
/// @param stays  those that are not taken all the same; empty: none
std::vector<int> condensable(const EquationsOfMotion<Sparse>& equations,
                             const std::vector<bool>& stays) {
  constexpr double tolerance = 1e-12;
  const auto& [M, C, K, spin_parts, Omega] = equations;
  const Vec mass = row_sizes(M), stiffness = row_sizes(K);
  Vec gyroscopic = Vec::Zero(M.rows());  // of each shaft: shafts against each other may cancel
  for (const SpinPart<Sparse>& part : spin_parts) {
    gyroscopic = gyroscopic.cwiseMax(row_sizes(part.G));
  }
  std::vector<int> massless;
  for (int i = 0; i < mass.size(); ++i) {
    const bool is_kept = !stays.empty() && stays[static_cast<std::size_t>(i)];
    if (mass(i) == 0.0 && gyroscopic(i) == 0.0 && !is_kept) massless.push_back(i);
  }
  if (massless.empty()) return massless;
  const Vec damping = C.diagonal(), stiff = K.diagonal();
  std::vector<double> ratios;
  for (const int i : massless) ratios.push_back(stiff(i) != 0.0 ? damping(i) / stiff(i) : 0.0);
  std::vector<double> sorted = ratios;
  std::sort(sorted.begin(), sorted.end());
  const double beta = sorted[sorted.size() / 2];
  const Vec misfit = row_sizes(Sparse(C - beta * K));
  const double scale = std::abs(beta);
  std::vector<int> chosen;
  for (const int i : massless) {
    if (misfit(i) <= tolerance * scale * stiffness(i)) chosen.push_back(i);
  }
  return chosen;
}

/// Transformation from the kept dofs to all, K_ss q_s + K_sk q_k = 0 for the others.
Sparse condensation(const Sparse& K, const std::vector<int>& condensed) {
  const int n = static_cast<int>(K.rows()), ns = static_cast<int>(condensed.size());
  std::vector<int> place(static_cast<std::size_t>(n), -1);  // in s: -(index + 2), in kept: index
  for (int i = 0; i < ns; ++i) place[condensed[i]] = -(i + 2);
  int kept = 0;
  for (int& p : place) {
    if (p == -1) p = kept++;
  }
  if (kept == 0) throw NumericalError("nothing that can move has inertia or a damper of its own");
  std::vector<Triplet> ss, sk, T;
  for (int j = 0; j < n; ++j) {
    if (place[j] >= 0) T.emplace_back(j, place[j], 1.0);
    for (Sparse::InnerIterator it(K, j); it; ++it) {
      const int row = place[it.row()];
      if (row >= 0) continue;
      if (place[j] >= 0) {
        sk.emplace_back(-row - 2, place[j], it.value());
      } else {
        ss.emplace_back(-row - 2, -place[j] - 2, it.value());
      }
    }
  }
  Sparse Kss(ns, ns), Ksk(ns, kept);
  Kss.setFromTriplets(ss.begin(), ss.end());
  Ksk.setFromTriplets(sk.begin(), sk.end());
  const SparseLu solver(Kss);
  if (!solver.is_regular()) {
    throw NumericalError(
        "some degrees of freedom have neither inertia nor stiffness: give a massless part of the "
        "shaft a density, or a massless body a mass or a support");
  }
  const Mat recovered = -solver.solve(Mat(Ksk));
  for (int j = 0; j < kept; ++j) {
    for (int i = 0; i < ns; ++i) {
      if (recovered(i, j) != 0.0) T.emplace_back(condensed[i], j, recovered(i, j));
    }
  }
  Sparse result(n, kept);
  result.setFromTriplets(T.begin(), T.end());
  return result;
}

/// Numbers of the freedoms of nodes and bodies.
DofMap freedoms_of_points(const Structure& structure, const Mesh& mesh) {
  DofMap dofs;
  dofs.nodes = mesh.nodes();
  dofs.full_size = 4 * dofs.nodes;
  for (const Body& body : structure.bodies) {
    dofs.body_start.push_back(dofs.full_size);
    dofs.body_tilts.push_back(body.tilts);
    dofs.full_size += body.tilts ? 4 : 2;
  }
  return dofs;
}

/// @throws ModelError  for an axial probe at a body that does not tilt
void check_probes(const Structure& structure) {
  for (const Probe& probe : structure.probes) {
    if (!probe.is_axial() || probe.at.kind != Station::Kind::body) continue;
    for (const Body& body : structure.bodies) {
      if (body.name != probe.at.body || body.tilts) continue;
      throw ModelError(probe.at.where, probe.at.key,
                       "this body does not tilt; give it tilts = true");
    }
  }
}

/// Whether two structures have the same mesh and the same matrices.
bool differ_in_loads_alone(const Structure& a, const Structure& b) {
  // names all members: one more does not compile until it is compared here, or said to be a load
  const auto& [shaft, disks, bodies, bearings, links, seals, linearized, unbalances, stations,
               damping, gravity, layers, modal_damping, bow, forces, probes, rotors, gears,
               supports] = a;
  const auto same_station = [](const Station* x, const Station* y) { return *x == *y; };
  return std::ranges::equal(all_stations(a), all_stations(b), same_station) && shaft == b.shaft &&
         layers == b.layers && rotors == b.rotors && disks == b.disks && bodies == b.bodies &&
         bearings == b.bearings && links == b.links && seals == b.seals && gears == b.gears &&
         supports == b.supports && damping == b.damping && modal_damping == b.modal_damping &&
         linearized.empty() && b.linearized.empty();
}

/// Adds the teeth of gears.
/// @throws ModelError  for gears whose speeds are not those that their radii say
void add_gears(const Structure& structure, const Mesh& mesh, const DofMap& dofs, Collector& to) {
  constexpr double rounding = 0.01;  // of radii that are told in few digits
  for (const GearPair& gears : structure.gears) {
    const Point driving = resolve(gears.driving, structure, mesh);
    const Point driven = resolve(gears.driven, structure, mesh);
    const double speed = spin_ratio(driving, structure, mesh);
    const double other = spin_ratio(driven, structure, mesh);
    for (const Point& wheel : {driving, driven}) {
      if (!std::isnan(shaft_ratio(wheel, structure, mesh))) continue;
      throw ModelError(gears.where, gears.name,
                       "one of its shafts has a speed of its own; expected a ratio, as teeth make "
                       "it");
    }
    const double by_radii = -speed * gears.driving_radius / gears.driven_radius;
    if (speed == 0.0 || std::abs(other - by_radii) > rounding * std::abs(by_radii)) {
      throw ModelError(gears.where, gears.name,
                       fmt::format("the driving gear turns with {:g} times the speed of the first "
                                   "shaft and the driven one with {:g} times; expected {:.6g} by "
                                   "the radii",
                                   speed, other, by_radii));
    }
    to.add(matrices(gears, speed > 0.0 ? 1.0 : -1.0), indices(dofs, driving, driven));
  }
}

/// Adds what the spin of a shaft makes at a speed [rad/s] to what does not depend on that of the
/// first one.
void add_spin(const SpinPart<Sparse>& spin, double speed, EquationsOfMotion<Sparse>& to) {
  to.C += speed * spin.G;
  to.K += speed * spin.H;
}

/// Adds what shafts of one own speed make by it; those whose own speeds change are taken apart.
void take_own_spins(const Structure& structure, EquationsOfMotion<Sparse>& equations,
                    std::vector<std::pair<std::size_t, SpinPart<Sparse>>>& changing) {
  for (std::size_t i = 0; i < structure.rotors.size(); ++i) {
    const Rotor& rotor = structure.rotors[i];
    if (!rotor.has_own_speed()) continue;
    SpinPart<Sparse>& part = equations.spin_parts[i + 1];  // the first is the first shaft
    if (rotor.own.size() == 1) {
      add_spin(part, rotor.own.front(), equations);
    } else {
      changing.emplace_back(i, part);
    }
    part.G.setZero(), part.H.setZero();
  }
}

/// Adds shaft, disks and bodies; internal functions of the shaft get the next numbers.
void add_rotor(const Structure& structure, const Mesh& mesh, DofMap& dofs, Collector& to) {
  for (const MeshElement& element : mesh.elements) {
    const auto e = matrices(beam_of(element, structure, mesh));
    std::vector<int> index =
        indices(dofs, {Point::Kind::node, element.left}, {Point::Kind::node, element.right});
    while (static_cast<Eigen::Index>(index.size()) < e.M.rows()) {
      index.push_back(dofs.full_size++);
    }
    to.add(e, index, static_cast<std::size_t>(element.shaft));
  }
  for (const MeshLayer& piece : mesh.layers) {
    const MeshElement& beside = mesh.elements[static_cast<std::size_t>(piece.element)];
    to.add(matrices(beam_of(piece, structure, mesh)),
           indices(dofs, {Point::Kind::node, beside.left}, {Point::Kind::node, beside.right}),
           static_cast<std::size_t>(beside.shaft));
  }
  for (const Disk& disk : structure.disks) {
    const Point at = resolve(disk.at, structure, mesh);
    const int shaft = mesh.shaft_of[static_cast<std::size_t>(at.index)];
    to.add(matrices(disk), indices(dofs, at), static_cast<std::size_t>(shaft));
  }
  for (std::size_t i = 0; i < structure.bodies.size(); ++i) {
    const Body& body = structure.bodies[i];
    const std::optional<int> shaft = structure.shaft_named(body.rotor);
    if (!shaft) {
      throw ModelError(body.where, body.name,
                       fmt::format("there is no rotor named \"{}\"", body.rotor));
    }
    to.add(matrices(body), indices(dofs, {Point::Kind::body, static_cast<int>(i)}),
           static_cast<std::size_t>(*shaft));
  }
}

}  // namespace

Assembler::Assembler(Structure structure)
    : structure_(std::make_shared<const Structure>(std::move(structure))) {
  const auto made = std::make_shared<Assembled>();
  assembled_ = made;
  made->mesh = make_mesh(*structure_);
  check_probes(*structure_);
  DofMap& dofs = made->dofs;
  dofs = freedoms_of_points(*structure_, made->mesh);
  std::vector<double> ratios;
  for (const Structure::Shaft& shaft : structure_->shafts()) {
    ratios.push_back(shaft.has_own_speed() ? 0.0 : shaft.ratio);
  }
  Collector collector(std::move(ratios));
  add_rotor(*structure_, made->mesh, dofs, collector);
  add_gears(*structure_, made->mesh, dofs, collector);
  add_states(*structure_, dofs);
  const int n = dofs.full_size;
  made->weighing = collector.M(n);

  dofs.T = freedoms_left(*structure_, made->mesh, dofs);
  for (const auto& [kind, list] : structure_->connections()) {
    for (const Connection& c : list) {
      if (whirl::depends_on_speed(c.coefficients)) {
        made->tables_depend_on_speed = true;
        if (whirl::depends_on_whirl(c.coefficients)) made->depends_on_whirl = true;
      } else {
        collector.add(matrices(coefficients(c.coefficients, 0.0)),
                      indices(dofs, point(c.from), point(c.to)));
      }
    }
  }
  made->fixed = {collector.M(n), collector.C(n), collector.K(n), collector.spins(n)};
  take_own_spins(*structure_, made->fixed, made->own_spins);
  if (!made->own_spins.empty()) made->tables_depend_on_speed = true;
  if (!structure_->linearized.empty()) made->tables_depend_on_speed = true;
  const bool has_supports = !structure_->supports.empty();
  if (!structure_->modal_damping.ratios.empty()) {
    // modes at rest, where films carry nothing; with the added mass of tables
    Structure without_films = *structure_;
    without_films.linearized.clear();
    const auto whole =
        std::exchange(structure_, std::make_shared<const Structure>(std::move(without_films)));
    if (has_supports) made->supports = static_support_equations(*structure_, made->mesh, dofs);
    const auto at_rest = [&] { return at(0.0); };
    made->modal = modal_damping_matrix(structure_->modal_damping, at_rest, full(0.0, 0.0).M);
    structure_ = whole;
  }
  if (has_supports) made->supports = support_equations(*structure_, made->mesh, dofs);
}

std::optional<Assembler> Assembler::with_loads_of(const Structure& structure) const {
  if (!differ_in_loads_alone(*structure_, structure)) return std::nullopt;
  check_probes(structure);
  Assembler other = *this;
  other.structure_ = std::make_shared<const Structure>(structure);
  return other;
}

Assembler::FullEquations Assembler::full(double Omega, double omega) const {
  interruption_point();
  FullEquations f = assembled_->fixed;
  f.Omega = Omega;
  for (const auto& [rotor, spin] : assembled_->own_spins) {
    add_spin(spin, structure_->rotors[rotor].speed_at(Omega), f);
  }
  Collector collector;
  bool any = false;
  for (const auto& [kind, list] : structure_->connections()) {
    for (const Connection& c : list) {
      if (!whirl::depends_on_speed(c.coefficients)) continue;
      any = true;
      collector.add(matrices(coefficients_of(c, Omega, omega)),
                    indices(dofs(), point(c.from), point(c.to)));
    }
  }
  if (any) {
    f.M += collector.M(dofs().full_size);
    f.K += collector.K(dofs().full_size);
    f.C += collector.C(dofs().full_size);
  }
  const Rayleigh& r = structure_->damping;
  if (r.mass != 0.0) f.C += r.mass * f.M;
  if (r.stiffness != 0.0) f.C += r.stiffness * symmetric_part(f.K);
  if (assembled_->modal.nonZeros() > 0) f.C += assembled_->modal;
  if (const FullEquations& supports = assembled_->supports; supports.size() > 0) {
    f.M += supports.M;  // damping of the rotor is in proportion to nothing of them
    f.C += supports.C;
    f.K += supports.K;
  }
  if (structure_->linearized.empty()) return f;
  Collector linearized;  // damping of the rotor is not in proportion to their stiffness
  for (const LinearizedConnection& c : structure_->linearized) {
    linearized.add(matrices(c.at(Omega, omega)), indices(dofs(), point(c.from), point(c.to)));
  }
  f.K += linearized.K(dofs().full_size);
  f.C += linearized.C(dofs().full_size);
  return f;
}

System Assembler::system_of(const FullEquations& f, const Sparse& T) const {
  System s{f.mapped([&](const Sparse& A) { return project(T, A); }), dofs()};
  s.dofs.T = T;
  return s;
}

System Assembler::uncondensed(double Omega, double omega) const {
  return system_of(full(Omega, omega), dofs().T);
}

System Assembler::at(double Omega, double omega) const {
  const FullEquations f = full(Omega, omega);
  System whole = system_of(f, dofs().T);
  const std::vector<int> condensed = condensable(whole, touched_by_whirl());
  if (condensed.empty()) return whole;
  // condensation follows the conservative part of K: rotating damping vanishes with it
  System s = system_of(f, Sparse(dofs().T * condensation(whole.K, condensed)));
  s.dofs.condensed = static_cast<int>(condensed.size());
  return s;
}

/// Coordinates on which coefficients act that depend on the frequency; empty: none.
std::vector<bool> Assembler::touched_by_whirl() const {
  if (!depends_on_whirl()) return {};
  std::vector<bool> is_end(static_cast<std::size_t>(dofs().full_size), false);
  for (const auto& [kind, list] : structure_->connections()) {
    for (const Connection& c : list) {
      if (!whirl::depends_on_whirl(c.coefficients)) continue;
      for (const int i : indices(dofs(), point(c.from), point(c.to))) {
        if (i >= 0) is_end[static_cast<std::size_t>(i)] = true;
      }
    }
  }
  std::vector<bool> touched(static_cast<std::size_t>(dofs().T.cols()), false);
  for (int j = 0; j < dofs().T.outerSize(); ++j) {
    for (Sparse::InnerIterator it(dofs().T, j); it; ++it) {
      if (is_end[static_cast<std::size_t>(it.row())]) touched[static_cast<std::size_t>(j)] = true;
    }
  }
  return touched;
}

BearingCoefficients Assembler::coefficients_of(const Connection& connection, double Omega,
                                               double omega) const {
  const double speed = std::abs(shaft_speed(point(connection.from), Omega));
  return coefficients(connection.coefficients, speed, omega);
}

System assemble(const Structure& structure, double Omega) {
  return Assembler(structure).at(Omega);
}

}  // namespace whirl::inline fe

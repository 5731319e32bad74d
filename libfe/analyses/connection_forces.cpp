#include "libfe/analyses/connection_forces.hpp"

#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/assembly/support_equations.hpp"
#include "libfe/mesh/elements/gear.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

/// Coefficients of the parts of a structure, in the order of carrying_parts.
std::vector<BearingCoefficients> coefficients_of_parts(const Assembler& assembler, double Omega,
                                                       double omega) {
  const Structure& s = assembler.structure();
  std::vector<BearingCoefficients> all;
  for (const auto* list : {&s.bearings, &s.seals, &s.links}) {
    for (const Connection& c : *list) all.push_back(assembler.coefficients_of(c, Omega, omega));
  }
  for (const LinearizedConnection& c : s.linearized) all.push_back(c.at(Omega, omega));
  return all;
}

/// The entries of a matrix, from a row on.
void add_rows(const Sparse& A, int row, std::vector<Triplet>& to) {
  for (int j = 0; j < A.outerSize(); ++j) {
    for (Sparse::InnerIterator it(A, j); it; ++it) {
      to.emplace_back(row + static_cast<int>(it.row()), j, it.value());
    }
  }
}

/// Forces of driving on driven gears, the first of them in a row: those that hold the driving one.
void add_teeth(const Assembler& assembler, int row, std::vector<Triplet>& K,
               std::vector<Triplet>& C) {
  const DofMap& dofs = assembler.dofs();
  for (const GearPair& gears : assembler.structure().gears) {
    const Point driving = assembler.point(gears.driving), driven = assembler.point(gears.driven);
    const auto teeth = matrices(gears, assembler.spin_speed(driving, 1.0) > 0.0 ? 1.0 : -1.0);
    for (int j = 0; j < 8; ++j) {
      const int column = dofs.full_index(j < 4 ? driving : driven, j % 4);
      for (int i = 0; i < 2 && column >= 0; ++i) {
        K.emplace_back(row + i, column, teeth.K(i, j));
        C.emplace_back(row + i, column, teeth.C(i, j));
      }
    }
    row += 2;
  }
}

/// Displacements of all points that go with a displacement of one coordinate of a rigid part, all
/// other coordinates of rigid parts held: the solution of A^T psi = 0 beside those coordinates.
class RigidShapes {
 public:
  RigidShapes(const Sparse& stiffness, const std::vector<CarryingPart>& parts, const DofMap& dofs)
      : transposed_(stiffness.transpose()), free_(static_cast<std::size_t>(stiffness.rows()), 0) {
    std::vector<char> is_held(free_.size(), 0);
    for (const CarryingPart& part : parts) {
      if (!part.is_rigid) continue;
      for (const Point& point : {part.from, part.to}) {
        for (const int k : {X, Y, THETA_X, THETA_Y}) {
          const int i = dofs.full_index(point, k);
          if (i >= 0) is_held[static_cast<std::size_t>(i)] = 1;
        }
      }
    }
    for (std::size_t i = 0; i < free_.size(); ++i) free_[i] = is_held[i] ? -1 : count_++;
    Sparse inner(count_, count_);
    std::vector<Triplet> triplets;
    for (int j = 0; j < transposed_.outerSize(); ++j) {
      for (Sparse::InnerIterator it(transposed_, j); it; ++it) {
        const int row = free_[static_cast<std::size_t>(it.row())], col = free_[at(j)];
        if (row >= 0 && col >= 0) triplets.emplace_back(row, col, it.value());
      }
    }
    inner.setFromTriplets(triplets.begin(), triplets.end());
    if (count_ > 0) solver_.emplace(inner);
  }

  /// The shape of a unit displacement; that coordinate alone where the others are not held.
  Vec of(int coordinate) const {
    Vec shape = Vec::Zero(transposed_.rows());
    shape(coordinate) = 1.0;
    if (!solver_ || !solver_->is_regular()) return shape;
    Vec load = Vec::Zero(count_);
    for (Sparse::InnerIterator it(transposed_, coordinate); it; ++it) {
      const int row = free_[static_cast<std::size_t>(it.row())];
      if (row >= 0) load(row) = -it.value();
    }
    const Vec inner = solver_->solve(load);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (free_[i] >= 0) shape(static_cast<Eigen::Index>(i)) = inner(free_[i]);
    }
    return shape;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  Sparse transposed_;
  std::vector<int> free_;  ///< number among the coordinates that are not held, or -1
  int count_ = 0;
  std::optional<SparseLu> solver_;
};

}  // namespace

std::vector<CarryingPart> carrying_parts(const Assembler& assembler) {
  const Structure& s = assembler.structure();
  std::vector<CarryingPart> parts;
  const auto add = [&](std::string_view kind, const std::vector<Connection>& list) {
    for (const Connection& c : list) {
      parts.push_back({kind, c.name, assembler.point(c.from), assembler.point(c.to),
                       c.is_rigid || c.is_clamped});
    }
  };
  add("bearing", s.bearings);
  add("seal", s.seals);
  add("link", s.links);
  for (const LinearizedConnection& c : s.linearized) {
    parts.push_back({c.kind, c.name, assembler.point(c.from), assembler.point(c.to)});
  }
  const auto forces = support_forces(s, assembler.mesh(), assembler.dofs());
  for (std::size_t i = 0, place = 1; i < forces.size(); ++i, ++place) {
    const Support* support = forces[i].support;
    const bool is_next = i + 1 < forces.size() && forces[i + 1].support == support;
    const bool is_first = i == 0 || forces[i - 1].support != support;
    if (is_first) place = 1;
    const std::string number = is_first && !is_next ? "" : " " + std::to_string(place);
    parts.push_back({support->sensors > 0 ? "magnetic bearing" : "support", support->name + number,
                     forces[i].from, forces[i].to});
  }
  for (const GearPair& gears : s.gears) {
    parts.push_back(
        {"gear", gears.name, assembler.point(gears.driving), assembler.point(gears.driven)});
  }
  return parts;
}

ConnectionForces::ConnectionForces(const Assembler& assembler, double Omega, double omega,
                                   RigidRows rigid) {
  const std::vector<CarryingPart> parts = carrying_parts(assembler);
  const auto all = coefficients_of_parts(assembler, Omega, omega);
  const DofMap& dofs = assembler.dofs();
  std::vector<Triplet> K_of, C_of, M_of, shapes;
  std::optional<Assembler::FullEquations> equations;
  std::optional<RigidShapes> static_shapes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto row = static_cast<int>(2 * i);
    for (const auto& [point, sign] :
         {std::pair(parts[i].from, 1.0), std::pair(parts[i].to, -1.0)}) {
      for (int k = 0; k < 2; ++k) {
        const int j = dofs.full_index(point, k);
        for (int r = 0; r < 2 && j >= 0; ++r) {
          K_of.emplace_back(row + r, j, sign * all[i].K(r, k));
          C_of.emplace_back(row + r, j, sign * all[i].C(r, k));
          M_of.emplace_back(row + r, j, sign * all[i].M(r, k));
        }
      }
    }
    if (!parts[i].is_rigid) continue;
    if (!equations) equations = assembler.full(Omega, omega);
    if (rigid == RigidRows::static_shape && !static_shapes) {
      static_shapes.emplace(equations->stiffness(), parts, dofs);
    }
    for (int k = 0; k < 2; ++k) {
      const int j = dofs.full_index(parts[i].from, k);
      if (j < 0) continue;
      if (!static_shapes) {
        shapes.emplace_back(row + k, j, 1.0);
        continue;
      }
      const Vec shape = static_shapes->of(j);
      for (Eigen::Index p = 0; p < shape.size(); ++p) {
        if (shape(p) != 0.0) shapes.emplace_back(row + k, static_cast<int>(p), shape(p));
      }
    }
  }
  auto row = static_cast<int>(2 * all.size());
  for (const SupportForce& f : support_forces(assembler.structure(), assembler.mesh(), dofs)) {
    add_rows(f.K, row, K_of);
    add_rows(f.C, row, C_of);
    add_rows(f.M, row, M_of);
    row += 2;
  }
  add_teeth(assembler, row, K_of, C_of);
  const auto matrix = [&](const std::vector<Triplet>& triplets) {
    Sparse A(static_cast<Eigen::Index>(2 * parts.size()), dofs.full_size);
    A.setFromTriplets(triplets.begin(), triplets.end());
    return A;
  };
  K = matrix(K_of), C = matrix(C_of), M = matrix(M_of), L = matrix(shapes);
  if (!equations) return;
  K -= L * equations->stiffness();
  C -= L * equations->D();
  M -= L * equations->M;
}

CVec ConnectionForces::at(double omega, const CVec& q, const CVec& load) const {
  const Complex i(0.0, 1.0);
  return K * q + i * omega * (C * q) - omega * omega * (M * q) + L * load;
}

}  // namespace whirl::inline fe

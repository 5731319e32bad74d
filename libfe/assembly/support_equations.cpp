#include "libfe/assembly/support_equations.hpp"

#include <algorithm>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/assembly/collector.hpp"
#include "libfe/mesh/elements/state_coordinates.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

/// Interface coordinates over freedoms of the full vector, a row for each.
struct Interface {
  std::vector<int> index;  ///< freedoms
  Mat sees, acts_on;       ///< over them
};

Interface interface_of(const Support& support, const Structure& structure, const Mesh& mesh,
                       const DofMap& dofs) {
  Interface made;
  const auto place_of = [&](int freedom) {
    const auto at = std::ranges::find(made.index, freedom);
    if (at == made.index.end()) {
      made.index.push_back(freedom);
      return std::ssize(made.index) - 1;
    }
    return at - made.index.begin();
  };
  const auto rows = [&](const std::vector<InterfaceCoordinate>& coordinates) {
    std::vector<Triplet> entries;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      const InterfaceCoordinate& c = coordinates[i];
      for (const auto& [station, sign] : {std::pair(&c.at, 1.0), std::pair(&c.to, -1.0)}) {
        const Point point = resolve(*station, structure, mesh);
        for (const auto& [component, share] : {std::pair(X, c.x), std::pair(Y, c.y)}) {
          const int freedom = dofs.full_index(point, component);
          if (freedom < 0 || share == 0.0) continue;
          entries.emplace_back(static_cast<int>(i), static_cast<int>(place_of(freedom)),
                               sign * share);
        }
      }
    }
    return entries;
  };
  const auto filled = [&](const std::vector<Triplet>& entries, std::size_t count) {
    Mat R = Mat::Zero(static_cast<Eigen::Index>(count), std::ssize(made.index));
    for (const Triplet& t : entries) R(t.row(), t.col()) += t.value();
    return R;
  };
  const auto sees = rows(support.sees), acts_on = rows(support.acts_on);
  made.sees = filled(sees, support.sees.size());
  made.acts_on = filled(acts_on, support.acts_on.size());
  return made;
}

/// Calls f(support, its interface, index in the full vector of its first state) for all of them.
template <class F>
void for_each_support(const Structure& structure, const Mesh& mesh, const DofMap& dofs, F f) {
  std::size_t state = 0;
  for (const Support& support : structure.supports) {
    const StateCoordinates c = state_coordinates(support);
    Interface at = interface_of(support, structure, mesh, dofs);
    for (int k = 0; k < c.size(); ++k) at.index.push_back(dofs.states[state++].index);
    f(support, c, at);
  }
}

/// [on ports, on states] as one matrix.
Mat joined(const Mat& ports, const Mat& by_states, const Mat& on_states, const Mat& states) {
  Mat whole(ports.rows() + states.rows(), ports.cols() + states.cols());
  whole << ports, by_states, on_states, states;
  return whole;
}

EquationsOfMotion<Sparse> equations_of(const Collector& collector, int n) {
  return {collector.M(n), collector.C(n), collector.K(n), collector.spins(n)};
}

}  // namespace

void add_states(const Structure& structure, DofMap& dofs) {
  for (const Support& support : structure.supports) {
    try {
      for (const auto& idle : state_coordinates(support).idle) {
        dofs.states.push_back({dofs.full_size++, idle});
      }
    } catch (const NumericalError& error) {
      throw ModelError(support.where, support.name, error.what());
    }
  }
}

EquationsOfMotion<Sparse> support_equations(const Structure& structure, const Mesh& mesh,
                                            const DofMap& dofs) {
  Collector collector;
  for_each_support(
      structure, mesh, dofs,
      [&](const Support& support, const StateCoordinates& c, const Interface& at) {
        const auto on_ports = [&](const Mat& D) -> Mat {
          const Eigen::Index n = at.sees.cols();
          return D.size() == 0 ? Mat(Mat::Zero(n, n)) : Mat(at.acts_on.transpose() * D * at.sees);
        };
        const Mat to_force = at.acts_on.transpose();
        const Mat none = Mat::Zero(at.sees.cols(), c.size());
        ElementMatrices<Eigen::Dynamic> e(static_cast<int>(at.index.size()));
        e.K = joined(on_ports(c.D), to_force * c.C_0, -c.B_0 * at.sees, c.K_w);
        e.C = joined(on_ports(support.law.D_rate), to_force * c.C_1, -c.B_1 * at.sees, c.C_w);
        e.M = joined(on_ports(support.law.D_inertia), none, none.transpose(),
                     Mat::Identity(c.size(), c.size()));
        collector.add(e, at.index);
      });
  return equations_of(collector, dofs.full_size);
}

EquationsOfMotion<Sparse> static_support_equations(const Structure& structure, const Mesh& mesh,
                                                   const DofMap& dofs) {
  Collector collector;
  for_each_support(structure, mesh, dofs,
                   [&](const Support& support, const StateCoordinates& c, const Interface& at) {
                     const Mat none = Mat::Zero(at.sees.cols(), c.size());
                     ElementMatrices<Eigen::Dynamic> e(static_cast<int>(at.index.size()));
                     e.K = joined(at.acts_on.transpose() * support.law.static_stiffness() * at.sees,
                                  none, none.transpose(), Mat::Identity(c.size(), c.size()));
                     collector.add(e, at.index);
                   });
  return equations_of(collector, dofs.full_size);
}

std::vector<SupportForce> support_forces(const Structure& structure, const Mesh& mesh,
                                         const DofMap& dofs) {
  std::vector<SupportForce> forces;
  for_each_support(
      structure, mesh, dofs,
      [&](const Support& support, const StateCoordinates& c, const Interface& at) {
        const std::size_t first = forces.size();
        const auto force_at = [&](const InterfaceCoordinate& port) -> SupportForce& {
          const Point from = resolve(port.at, structure, mesh);
          const Point to = resolve(port.to, structure, mesh);
          for (std::size_t i = first; i < forces.size(); ++i) {
            if (forces[i].from == from && forces[i].to == to) return forces[i];
          }
          const Sparse none(2, dofs.full_size);
          return forces.emplace_back(SupportForce{&support, from, to, none, none, none});
        };
        const auto over_all = [&](const Mat& D, const Mat& by_states, Eigen::Index row) {
          Vec entries(std::ssize(at.index));
          const Mat by_ports =
              D.size() == 0 ? Mat(Mat::Zero(1, at.sees.cols())) : Mat(D.row(row) * at.sees);
          entries << by_ports.transpose(), by_states.row(row).transpose();
          return entries;
        };
        const Mat none = Mat::Zero(support.law.outputs(), c.size());
        for (Eigen::Index row = 0; row < support.law.outputs(); ++row) {
          const InterfaceCoordinate& port = support.acts_on[static_cast<std::size_t>(row)];
          SupportForce& force = force_at(port);
          const auto add = [&](Sparse& to, const Vec& entries) {
            for (std::size_t k = 0; k < at.index.size(); ++k) {
              const double value = entries(static_cast<Eigen::Index>(k));
              if (port.x * value != 0.0) to.coeffRef(0, at.index[k]) += port.x * value;
              if (port.y * value != 0.0) to.coeffRef(1, at.index[k]) += port.y * value;
            }
          };
          add(force.K, over_all(c.D, c.C_0, row));
          add(force.C, over_all(support.law.D_rate, c.C_1, row));
          add(force.M, over_all(support.law.D_inertia, none, row));
        }
      });
  return forces;
}

namespace {

/// Numbers of ports and states over the full vector.
Vec over_full(const Vec& ports, const Vec& states, const Interface& at, const DofMap& dofs) {
  Vec row = Vec::Zero(dofs.full_size);
  for (Eigen::Index k = 0; k < std::ssize(at.index); ++k) {
    row(at.index[static_cast<std::size_t>(k)]) +=
        k < ports.size() ? ports(k) : states(k - ports.size());
  }
  return row;
}

}  // namespace

LimitedSignal limited_signal(const Structure& structure, const Mesh& mesh, const DofMap& dofs,
                             std::size_t support, std::size_t limit) {
  LimitedSignal signal;
  std::size_t number = 0;
  for_each_support(
      structure, mesh, dofs, [&](const Support& of, const StateCoordinates&, const Interface& at) {
        if (number++ != support) return;
        const SignalLimit& l = of.limits[limit];
        signal.displacement = over_full(at.sees.transpose() * l.over_displacements,
                                        following_rate(of.law) * l.over_states, at, dofs);
        signal.rate = over_full(at.sees.transpose() * l.over_rates, l.over_states, at, dofs);
        signal.force = over_full(at.acts_on.transpose() * l.to_forces, -l.to_states, at, dofs);
      });
  return signal;
}

SensorRows sensor_rows(const Structure& structure, const Mesh& mesh, const DofMap& dofs,
                       std::size_t support, int sensor) {
  SensorRows rows;
  std::size_t number = 0;
  for_each_support(
      structure, mesh, dofs,
      [&](const Support& of, const StateCoordinates& c, const Interface& at) {
        if (number++ != support) return;
        const Vec none = Vec::Zero(c.size());
        const Mat to_force = at.acts_on.transpose();
        rows.sees = over_full(at.sees.row(sensor).transpose(), none, at, dofs);
        rows.acts_on = over_full(to_force.col(sensor), none, at, dofs);
        rows.stiffness = over_full(to_force * c.D.col(sensor), -c.B_0.col(sensor), at, dofs);
        const Vec by_rate = of.law.D_rate.size() > 0 ? Vec(to_force * of.law.D_rate.col(sensor))
                                                     : Vec(Vec::Zero(to_force.rows()));
        rows.damping = over_full(by_rate, -c.B_1.col(sensor), at, dofs);
      });
  return rows;
}

}  // namespace whirl::inline fe

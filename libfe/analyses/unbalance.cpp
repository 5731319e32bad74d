#include "libfe/analyses/unbalance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"

namespace whirl::inline fe {

namespace {

UnbalanceResponse response_at(const std::vector<double>& speeds, const std::vector<Point>& points) {
  const CMat none = CMat::Zero(std::ssize(points), std::ssize(speeds));
  return {speeds, points, none, none, none, none};
}

/// Takes the displacements at the points of a full vector as those at a speed.
void put(const CVec& full, const DofMap& dofs, Eigen::Index speed, UnbalanceResponse& response) {
  for (std::size_t p = 0; p < response.points.size(); ++p) {
    int component = 0;
    for (CMat* of : {&response.x, &response.y, &response.theta_x, &response.theta_y}) {
      const int k = dofs.full_index(response.points[p], component++);
      if (k >= 0) (*of)(static_cast<Eigen::Index>(p), speed) = full(k);
    }
  }
}

}  // namespace

struct UnbalanceSolver::State {
  const Assembler& assembler;
  /// Of one frequency, those of one growth together, in the coordinates of the system.
  std::vector<Excitation> loads;
  std::optional<DynamicStiffness> stiffness{};  ///< of the last speed, if it depends on that
};

UnbalanceSolver::UnbalanceSolver(const Assembler& assembler) {
  const Sparse& T = assembler.dofs().T;
  std::vector<Excitation> loads{
      {.order = 1.0, .growth = Growth::unbalance, .amplitude = CVec::Zero(T.cols())}};
  for (const Excitation& e : synchronous_excitations(assembler)) {
    const CVec own = T.transpose() * e.amplitude;
    const auto same = std::find_if(loads.begin(), loads.end(), [&](const Excitation& other) {
      return other.growth == e.growth;
    });
    if (same == loads.end()) {
      loads.push_back({.order = 1.0, .growth = e.growth, .amplitude = own});
    } else {
      same->amplitude += own;
    }
  }
  state_ = std::make_unique<State>(State{assembler, std::move(loads)});
}

UnbalanceSolver::UnbalanceSolver(const Assembler& assembler, const Excitation& load) {
  Excitation reduced = load;
  reduced.amplitude = assembler.dofs().T.transpose() * load.amplitude;
  state_ = std::make_unique<State>(State{assembler, {std::move(reduced)}});
}

UnbalanceSolver::~UnbalanceSolver() = default;

const DofMap& UnbalanceSolver::dofs() const {
  return state_->assembler.dofs();
}

std::optional<CVec> UnbalanceSolver::at(double Omega) {
  State& s = *state_;
  if (!acts_at(s.loads, Omega)) return CVec(CVec::Zero(dofs().full_size));
  const double w = s.loads[0].frequency_at(Omega);
  if (!s.stiffness || s.assembler.tables_depend_on_speed() || s.assembler.depends_on_whirl()) {
    s.stiffness.emplace(s.assembler.uncondensed(Omega, w));
  }
  CVec force = s.loads[0].growth_at(Omega) * s.loads[0].amplitude;
  for (std::size_t i = 1; i < s.loads.size(); ++i) {
    force += s.loads[i].growth_at(Omega) * s.loads[i].amplitude;
  }
  const auto q = s.stiffness->solve(w, Omega, force);
  if (!q) return {};
  return CVec(dofs().T * *q);
}

std::optional<CVec> UnbalanceSolver::at(double Omega, const std::vector<Point>& points) {
  const auto full = at(Omega);
  if (!full) return {};
  const auto count = static_cast<Eigen::Index>(points.size());
  CVec u(2 * count);
  for (Eigen::Index p = 0; p < count; ++p) {
    const Point& point = points[static_cast<std::size_t>(p)];
    u(p) = (*full)(dofs().full_index(point, X));
    u(p + count) = (*full)(dofs().full_index(point, Y));
  }
  return u;
}

void for_each_oscillation(
    const Assembler& assembler, const Excitation& load, const std::vector<double>& speeds,
    const std::function<void(Eigen::Index, double w, const CVec& full)>& take) {
  const DofMap& dofs = assembler.dofs();
  const CVec force = dofs.T.transpose() * load.amplitude;
  const bool changes = assembler.tables_depend_on_speed() || assembler.depends_on_whirl();
  std::optional<DynamicStiffness> stiffness;
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    const double Omega = speeds[s], w = load.frequency_at(Omega);
    if (!stiffness || changes) {
      stiffness.emplace(assembler.uncondensed(Omega, w));
    }
    const auto q = stiffness->solve(w, Omega, load.growth_at(Omega) * force);
    take(static_cast<Eigen::Index>(s), w,
         q ? CVec(dofs.T * *q) : CVec::Constant(dofs.full_size, Complex(nan, nan)));
  }
}

UnbalanceResponse oscillating_response(const Assembler& assembler, const Excitation& load,
                                       const std::vector<double>& speeds,
                                       const std::vector<Point>& points) {
  UnbalanceResponse response = response_at(speeds, points);
  for_each_oscillation(assembler, load, speeds, [&](Eigen::Index s, double, const CVec& full) {
    put(full, assembler.dofs(), s, response);
  });
  return response;
}

UnbalanceResponse unbalance_response(const Assembler& assembler, const std::vector<double>& speeds,
                                     const std::vector<Point>& points) {
  const auto ns = static_cast<Eigen::Index>(speeds.size());
  UnbalanceResponse response = response_at(speeds, points);
  UnbalanceSolver solver(assembler);
  for (Eigen::Index s = 0; s < ns; ++s) {
    const double Omega = speeds[static_cast<std::size_t>(s)];
    const auto full = solver.at(Omega);
    if (!full) {
      throw NumericalError(
          fmt::format("the rotor has an undamped resonance at {:g} rad/s: the "
                      "unbalance response is unbounded",
                      Omega));
    }
    put(*full, assembler.dofs(), s, response);
  }
  return response;
}

}  // namespace whirl::inline fe

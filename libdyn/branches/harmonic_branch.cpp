#include "libdyn/branches/harmonic_branch.hpp"

#include <limits>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/orbits/hill.hpp"

namespace whirl::inline dyn {

namespace {

Mat ports_of(const Vec& x, Eigen::Index ports, double scale) {
  return scale * Eigen::Map<const Mat>(x.data(), ports, x.size() / ports);
}

Eigen::Index number_of_ports(const HarmonicProblem& problem) {
  Eigen::Index ports = 0;
  for (const PortForces& f : problem.forces) ports += f.U.rows();
  return ports;
}

/// As many as a state has numbers, those left out zero; NaN if they cannot be found.
CVec multipliers_of(const HarmonicProblem& problem, const HarmonicOrbit& orbit) {
  const HillStability hill = hill_stability(problem, orbit);
  CVec all = CVec::Zero(StateLayout(problem.coordinates()).size());
  if (hill.failure) {
    all.setConstant(std::numeric_limits<double>::quiet_NaN());
  } else {
    all.head(hill.multipliers.size()) = hill.multipliers;
  }
  return all;
}

}  // namespace

Vec harmonic_unknowns(const HarmonicOrbit& orbit, double scale) {
  const Mat& c = orbit.ports.coefficients;
  return Eigen::Map<const Vec>(c.data(), c.size()) / scale;
}

HarmonicOrbit orbit_of_unknowns(const HarmonicProblem& problem, const Vec& x, int period,
                                double scale) {
  const Eigen::Index ports = number_of_ports(problem);
  HarmonicOrbit orbit;
  orbit.ports = {ports_of(x, ports, scale), period, problem.rate};
  const HarmonicEquations equations(problem, period, orbit.ports.harmonics());
  const auto at = equations.evaluate(orbit.ports.coefficients, false);
  if (!at.has_force) {
    orbit.failure = "a force is not defined on the motion";
    return orbit;
  }
  orbit.motion = {equations.motion(at.g), period, problem.rate};
  orbit.residual = at.residual.lpNorm<Eigen::Infinity>() / scale;
  return orbit;
}

BranchEquations harmonic_equations(HarmonicProblemAt problem_at, int period, int harmonics,
                                   double scale, HarmonicSlopeAt slope_at) {
  return {[problem_at = std::move(problem_at), slope_at = std::move(slope_at), period, harmonics,
           scale](const Vec& x, double value, WithTangent wanted) {
    BranchEquations::Value result;
    try {
      const auto problem = problem_at(value);
      const auto equations = std::make_shared<const HarmonicEquations>(*problem, period, harmonics);
      HarmonicOrbit orbit;
      orbit.ports = {ports_of(x, equations->ports(), scale), period, problem->rate};
      const auto at = equations->evaluate(orbit.ports.coefficients, wanted == WithTangent::yes);
      if (!at.has_force) {
        result.failure = "a force is not defined on the motion";
        return result;
      }
      orbit.motion = {equations->motion(at.g), period, problem->rate};
      result.residual = Eigen::Map<const Vec>(at.residual.data(), at.residual.size()) / scale;
      if (problem->measures) result.contacts = problem->measures(orbit.motion);
      if (wanted == WithTangent::yes) {
        result.jacobian = equations->jacobian(at);
        if (slope_at) {
          result.slope = [slope_at, value, scale, problem, equations, u = orbit.ports.coefficients,
                          g = at.g]() -> Vec {
            const auto by = slope_at(value);
            const auto slope = by ? equations->slope(u, g, *by) : std::nullopt;
            return slope ? Vec(slope->reshaped() / scale) : Vec();
          };
        }
        result.multipliers = [problem, orbit = std::move(orbit)] {
          return multipliers_of(*problem, orbit);
        };
      }
    } catch (const NumericalError& error) {
      result.failure = error.what();
    }
    return result;
  }};
}

}  // namespace whirl::inline dyn

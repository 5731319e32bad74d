#pragma once
/// Forces at a few displacements of a periodic motion, as samples for Fourier integrals.

#include <functional>
#include <string>
#include <vector>

#include "libbase/numerics/fourier.hpp"

namespace whirl::inline dyn {

/// Largest number of displacements at one place that a force depends on and acts along.
constexpr int most_ports = 4;
using PortVec = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_ports, 1>;
using PortMat = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_ports, most_ports>;

/// A force at one instant, and how much of the period it stands for.
///
///   1 / (2 pi) int g phi d(theta) = sum_i share_i g_i phi(theta_i)
///
/// and the same for the derivative by the motion, with by_u and by_rate in place of g. Where a
/// force jumps, the instant of the jump moves with the motion: this makes a sample without force
/// but with slopes.
struct PortSample {
  double theta = 0.0;  ///< angle within the period, 0 to 2 pi
  double share = 0.0;  ///< of the period
  PortVec g;           ///< force [N]
  PortMat by_u;        ///< its derivative by the displacements [N/m]
  PortMat by_rate;     ///< and by their rates [N.s/m]
};

/// One place with forces: u = U eta, eta'' = ... + B g.
struct PortForces {
  std::string name;
  Mat U;  ///< ports x n [m]
  Mat B;  ///< n x ports
  /// Samples of the forces on a motion of these ports; their number grows with the motion's
  /// harmonics. False: there is no force, as of an oil film whose journal is outside its bearing.
  std::function<bool(const Periodic& motion, std::vector<PortSample>&)> sample;
};

/// How many evenly spaced instants of a motion a smooth force is sampled at.
/// @param number  per harmonic, 4 or more
int even_instants(const Periodic& motion, int number);

/// A smooth force g(phase, u, u') at even instants.
///
/// Its Fourier integrals have the accuracy of the motion's series where it is analytic.
///
/// @param law     fills g, by_u and by_rate of the sample; false: there is no force
/// @param number  as of even_instants
PortForces smooth_force(
    std::string name, Mat U, Mat B,
    std::function<bool(double phase, const PortVec& u, const PortVec& rate, PortSample&)> law,
    int number = 8);

}  // namespace whirl::inline dyn

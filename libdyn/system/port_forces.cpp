#include "libdyn/system/port_forces.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace whirl::inline dyn {

namespace {

constexpr int fewest_instants = 64;  ///< of a revolution

}  // namespace

int even_instants(const Periodic& motion, int number) {
  return std::max(fewest_instants * motion.period, number * motion.harmonics());
}

PortForces smooth_force(
    std::string name, Mat U, Mat B,
    std::function<bool(double phase, const PortVec& u, const PortVec& rate, PortSample&)> law,
    int number) {
  PortForces forces{.name = std::move(name), .U = std::move(U), .B = std::move(B)};
  forces.sample = [law = std::move(law), number](const Periodic& motion,
                                                 std::vector<PortSample>& samples) {
    const int N = even_instants(motion, number);
    const auto ports = motion.coefficients.rows();
    for (int i = 0; i < N; ++i) {
      PortSample s{.theta = 2.0 * std::numbers::pi * i / N,
                   .share = 1.0 / N,
                   .g = PortVec::Zero(ports),
                   .by_u = PortMat::Zero(ports, ports),
                   .by_rate = PortMat::Zero(ports, ports)};
      const auto [u, rate] = motion.at(s.theta);
      if (!law(motion.phase(s.theta), u, rate, s)) return false;
      samples.push_back(std::move(s));
    }
    return true;
  };
  return forces;
}

}  // namespace whirl::inline dyn

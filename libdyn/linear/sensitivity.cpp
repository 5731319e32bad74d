#include "libdyn/linear/sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/roots.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline dyn {

namespace {

/// A support with sensors, and rows over the coordinates that its signals and forces go by.
struct Loop {
  const Support* support = nullptr;
  Mat sees, acts_on;
};

Vec row_of(const InterfaceCoordinate& c, const Assembler& assembler, const DofMap& dofs) {
  const auto along = [&](const Station& station) {
    const Point point = assembler.point(station);
    return Vec(c.x * dofs.row(point, X) + c.y * dofs.row(point, Y));
  };
  return along(c.at) - along(c.to);
}

std::vector<Loop> loops_of(const Assembler& assembler, const DofMap& dofs) {
  std::vector<Loop> loops;
  for (const Support& support : assembler.structure().supports) {
    if (support.sensors == 0) continue;
    const auto rows = [&](const std::vector<InterfaceCoordinate>& coordinates) {
      Mat R(std::ssize(coordinates), dofs.size());
      for (std::size_t k = 0; k < coordinates.size(); ++k) {
        R.row(static_cast<Eigen::Index>(k)) = row_of(coordinates[k], assembler, dofs).transpose();
      }
      return R;
    };
    loops.push_back({&support, rows(support.sees), rows(support.acts_on)});
  }
  return loops;
}

/// The machine with all its loops closed, at one frequency after the other.
class ClosedLoops {
 public:
  ClosedLoops(const Assembler& assembler, double Omega)
      : assembler_(assembler),
        Omega_(Omega),
        system_(assembler.uncondensed(Omega)),
        stiffness_(system_),
        loops_(loops_of(assembler, system_.dofs)) {}

  const std::vector<Loop>& loops() const { return loops_; }

  /// S of a sensor; NaN where the machine resonates without damping.
  Complex sensitivity(const Loop& loop, int sensor, double w) {
    if (assembler_.depends_on_whirl()) {
      stiffness_ = DynamicStiffness(assembler_.uncondensed(Omega_, w));
    }
    // the disturbance makes forces as a displacement of the sensor does
    const CVec force = loop.support->law.stiffness_at(Complex(0.0, w)).col(sensor);
    const auto q =
        stiffness_.solve(w, Omega_, CVec(-(loop.acts_on.transpose().cast<Complex>() * force)));
    if (!q) return {nan, nan};
    return 1.0 + (loop.sees.row(sensor).cast<Complex>() * *q)(0);
  }

 private:
  const Assembler& assembler_;
  double Omega_;
  System system_;
  DynamicStiffness stiffness_;
  std::vector<Loop> loops_;
};

/// The largest of some values, refined between its neighbors.
template <class Function>
Maximum largest_of(const std::vector<double>& at, const CVec& values, const Function& size_at) {
  Eigen::Index k = 0;
  for (Eigen::Index i = 1; i < values.size(); ++i) {
    const double size = std::abs(values(i));
    if (!(std::abs(values(k)) >= size) && std::isfinite(size)) k = i;
  }
  const auto best = static_cast<std::size_t>(k);
  if (best == 0 || best + 1 == at.size()) return {at[best], std::abs(values(k))};
  constexpr double precise = 1e-9;  // relative
  return bracketed_maximum(size_at, at[best - 1], at[best], at[best + 1], precise * at[best]);
}

}  // namespace

std::string sensitivity_zone(double largest) {
  const auto zone =
      std::ranges::count_if(zone_limits, [&](double limit) { return !(largest <= limit); });
  return std::string(1, static_cast<char>('A' + zone));
}

Sensitivity loop_sensitivity(const Assembler& assembler, double Omega,
                             const std::vector<double>& frequencies) {
  Sensitivity result{.speed = Omega, .frequencies = frequencies, .loops = {}};
  ClosedLoops closed(assembler, Omega);
  if (closed.loops().empty()) {
    throw ModelError({}, "",
                     "the model has no control loop: add a [[magnetic_bearing]], or a [[support]] "
                     "with sensors");
  }
  if (frequencies.empty()) throw ModelError({"frequencies"}, "", "expected one or more");
  const auto count = static_cast<Eigen::Index>(frequencies.size());
  for (const Loop& loop : closed.loops()) {
    for (int sensor = 0; sensor < loop.support->sensors; ++sensor) {
      LoopSensitivity& found = result.loops.emplace_back();
      found.bearing = loop.support->name;
      found.axis = sensor + 1;
      found.sensitivity.resize(count);
      for (Eigen::Index k = 0; k < count; ++k) {
        const double w = frequencies[static_cast<std::size_t>(k)];
        found.sensitivity(k) = closed.sensitivity(loop, sensor, w);
      }
      found.open_loop = found.sensitivity.cwiseInverse().array() - 1.0;
      const Maximum largest = largest_of(frequencies, found.sensitivity, [&](double w) {
        return std::abs(closed.sensitivity(loop, sensor, w));
      });
      found.largest = largest.value;
      found.largest_at = largest.at;
      found.zone = sensitivity_zone(largest.value);
    }
  }
  return result;
}

}  // namespace whirl::inline dyn

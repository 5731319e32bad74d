#include "libdyn/linear/bearing_response.hpp"

#include <algorithm>
#include <optional>

#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/connection_forces.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline dyn {

namespace {

std::vector<BearingResponse> begun(const std::vector<CarryingPart>& parts, std::size_t speeds) {
  std::vector<BearingResponse> all;
  for (const CarryingPart& part : parts) {
    const CVec none = CVec::Zero(static_cast<Eigen::Index>(speeds));
    all.push_back({.kind = std::string(part.kind), .name = part.name, .x = none, .y = none});
  }
  return all;
}

void put(const CVec& forces, Eigen::Index speed, std::vector<BearingResponse>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].x(speed) = forces(static_cast<Eigen::Index>(2 * i));
    all[i].y(speed) = forces(static_cast<Eigen::Index>(2 * i + 1));
  }
}

void find_largest(const std::vector<double>& speeds, std::vector<BearingResponse>& all) {
  for (BearingResponse& of : all) {
    const Vec force = of.force();
    for (Eigen::Index s = 0; s < force.size(); ++s) {
      if (!(force(s) > of.largest)) continue;
      of.largest = force(s), of.largest_at = speeds[static_cast<std::size_t>(s)];
    }
  }
}

/// Whether a force follows from x and y of both ends: that on a rigid part follows from the
/// equations of motion, that of teeth from tilts, too, that of a support from its states.
bool is_of_ends(const CarryingPart& part) {
  return !part.is_rigid && part.kind != "gear" && part.kind != "support" &&
         part.kind != "magnetic bearing";
}

/// The full vector of a response at a speed, where elastic parts find all that they ask for;
/// nothing if some part asks for more, or is not among the points.
class KnownMotion {
 public:
  KnownMotion(const UnbalanceResponse& known, const std::vector<CarryingPart>& parts)
      : known_(known) {
    is_enough_ = std::ranges::all_of(parts, [&](const CarryingPart& part) {
      return is_of_ends(part) && is_known(part.from) && is_known(part.to);
    });
  }

  bool is_enough() const { return is_enough_; }

  CVec at(Eigen::Index speed, const DofMap& dofs) const {
    CVec full = CVec::Zero(dofs.full_size);
    for (std::size_t p = 0; p < known_.points.size(); ++p) {
      const auto row = static_cast<Eigen::Index>(p);
      full(dofs.full_index(known_.points[p], X)) = known_.x(row, speed);
      full(dofs.full_index(known_.points[p], Y)) = known_.y(row, speed);
    }
    return full;
  }

 private:
  bool is_known(const Point& point) const {
    return point.kind == Point::Kind::ground ||
           std::ranges::find(known_.points, point) != known_.points.end();
  }

  const UnbalanceResponse& known_;
  bool is_enough_ = false;
};

Vec phases_of(const CVec& amplitudes) {
  return amplitudes.cwiseArg() / degree;
}

}  // namespace

Vec BearingResponse::force() const {
  return x.binaryExpr(y, [](Complex fx, Complex fy) { return Orbit(fx, fy).major(); });
}
Vec BearingResponse::x_phase() const {
  return phases_of(x);
}
Vec BearingResponse::y_phase() const {
  return phases_of(y);
}

std::vector<BearingResponse> bearing_responses(const Assembler& assembler,
                                               const UnbalanceResponse& known) {
  const std::vector<CarryingPart> parts = carrying_parts(assembler);
  std::vector<BearingResponse> all = begun(parts, known.speeds.size());
  if (all.empty()) return all;
  const KnownMotion motion(known, parts);
  const std::vector<Excitation> loads = synchronous_excitations(assembler);
  const CVec none = CVec::Zero(assembler.dofs().full_size);
  UnbalanceSolver solver(assembler);
  const bool changes =
      assembler.tables_depend_on_speed() || std::ranges::any_of(parts, &CarryingPart::is_rigid);
  std::optional<ConnectionForces> forces;
  for (std::size_t s = 0; s < known.speeds.size(); ++s) {
    const double Omega = known.speeds[s];
    const auto row = static_cast<Eigen::Index>(s);
    // an oil film has no equilibrium at rest, and needs none without loads
    if (!acts_at(loads, Omega)) continue;
    // rigid parts take the gyroscopics of each speed
    if (!forces || changes) forces.emplace(assembler, Omega, Omega);
    if (motion.is_enough()) {
      put(forces->at(Omega, motion.at(row, assembler.dofs()), none), row, all);
    } else if (const auto full = solver.at(Omega)) {
      put(forces->at(Omega, *full, sum_at(loads, assembler, Omega)), row, all);
    }
  }
  find_largest(known.speeds, all);
  return all;
}

std::vector<BearingResponse> bearing_responses(const Assembler& assembler, const Excitation& load,
                                               const std::vector<double>& speeds) {
  std::vector<BearingResponse> all = begun(carrying_parts(assembler), speeds.size());
  if (all.empty()) return all;
  for_each_oscillation(assembler, load, speeds, [&](Eigen::Index row, double w, const CVec& full) {
    const double Omega = speeds[static_cast<std::size_t>(row)];
    put(ConnectionForces(assembler, Omega, w).at(w, full, load.growth_at(Omega) * load.amplitude),
        row, all);
  });
  find_largest(speeds, all);
  return all;
}

}  // namespace whirl::inline dyn

#include "libdyn/orbits/contact_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/system/interruption.hpp"
#include "libdyn/system/require_coordinates.hpp"
#include "libdyn/taylor/mixed.hpp"

namespace whirl::inline dyn {

namespace {

std::vector<FlowResult> pass(const ContactSystem& system, double tolerance,
                             std::span<const Vec> starts, long revolutions, WithTangent tangents) {
  interruption_point();
  std::vector<Trajectory> all;
  for (const Vec& y : starts) {
    Trajectory t{.system = &system, .revolutions = revolutions};
    t.state.y = y;
    all.push_back(std::move(t));
  }
  const BatchOptions how{.tolerance = tolerance,
                         .threads = 1,
                         .measures = true,
                         .tangent = tangents == WithTangent::yes};
  integrate_mixed(all, how);
  std::vector<FlowResult> passages;
  for (Trajectory& t : all) {
    FlowResult p{std::move(t.state.y), std::move(t.tangent), std::move(t.contacts), {}};
    if (t.outcome != Outcome::reached_end) {
      p.failure = !t.failure ? "the motion was stopped" : t.failure;
    }
    passages.push_back(std::move(p));
  }
  return passages;
}

}  // namespace

BasisChange::BasisChange(const Scene& scene, const Scene& first) {
  const Mat &Phi = scene.reduced.Phi, &Phi_first = first.reduced.Phi;
  if (Phi.rows() != Phi_first.rows() || Phi.cols() != Phi_first.cols()) {
    throw NumericalError("the parameter changes the number of degrees of freedom");
  }
  if (Phi == Phi_first) return;
  const Mat weighted = Phi.transpose() * Mat(scene.system.M);
  const Mat half = DenseLu<Mat>(weighted * Phi).solve(weighted * Phi_first);
  P_ = scene.contacts.layout().to_both(half);
  back_ = std::make_shared<const DenseLu<Mat>>(P_);
  if (!(back_->rcond() > 1e-10)) {
    throw NumericalError("the parameter changes the modes too much: keep more of them");
  }
}

Vec BasisChange::to(const Vec& y_first) const {
  if (is_none()) return y_first;
  return P_ * y_first;
}

Mat BasisChange::back(const Mat& y) const {
  if (is_none()) return y;
  return back_->solve(y);
}

void require_loads_of_a_revolution(const Flow& flow) {
  if (flow.repeats == 1) return;
  throw ModelError({std::string(branch_abilities.who)}, "",
                   branch_abilities.refusal(Need::several_revolutions));
}

Flow flow_of(const ContactSystem& system, double tolerance) {
  require_coordinates(system);
  orbit_abilities.require(system);
  return {
      system.state_scale(), system.period(),
      [&system, tolerance](std::span<const Vec> starts, long revolutions, WithTangent tangents) {
        return pass(system, tolerance, starts, revolutions, tangents);
      },
      system.repeats_after()};
}

Flow flow_of(std::shared_ptr<const Scene> scene, const Scene& first, double tolerance) {
  const ContactSystem& system = scene->contacts;
  Flow flow = flow_of(system, tolerance);
  flow.scale = first.contacts.state_scale();
  if (scene->reduced.Phi == first.reduced.Phi) {
    flow.go = [scene, tolerance](std::span<const Vec> starts, long revolutions,
                                 WithTangent tangents) {
      return pass(scene->contacts, tolerance, starts, revolutions, tangents);
    };
    return flow;
  }
  const BasisChange change(*scene, first);
  flow.go = [scene, tolerance, change](std::span<const Vec> starts, long revolutions,
                                       WithTangent tangents) {
    std::vector<Vec> own;
    for (const Vec& y : starts) own.push_back(change.to(y));
    std::vector<FlowResult> passages = pass(scene->contacts, tolerance, own, revolutions, tangents);
    for (FlowResult& p : passages) {
      if (p.failure) continue;
      p.end = change.back(p.end);
      if (tangents == WithTangent::yes) p.tangent = change.back(p.tangent * change.matrix());
    }
    return passages;
  };
  return flow;
}

}  // namespace whirl::inline dyn

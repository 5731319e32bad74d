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

void require_periodic_loads(const ContactSystem& system) {
  const auto loads = system.other_loads();
  const bool follow_the_speed = std::all_of(
      loads.begin(), loads.end(), [](const ReducedExcitation& o) { return o.order > 0.0; });
  if (follow_the_speed && system.repeats_after() > 0) return;
  throw ModelError(
      {}, "force",
      follow_the_speed
          ? "an order that is no fraction of small whole numbers makes a torus of every motion: "
            "there are no orbits and no return map, but motions to simulate and classify"
          : "a force with a frequency of its own makes a torus of every motion that has the "
            "frequency of the speed too, but at speeds in a simple ratio to it: there are no "
            "orbits of whole revolutions and no return map, but motions to simulate and classify; "
            "or give the force an order of the speed");
}

void require_loads_of_a_revolution(const Flow& flow) {
  if (flow.repeats == 1) return;
  throw ModelError({}, "force",
                   fmt::format("the forces repeat after {} revolutions only: expected orders that "
                               "are whole numbers; others go with one orbit of that period",
                               flow.repeats));
}

Flow flow_of(const ContactSystem& system, double tolerance) {
  require_coordinates(system);
  require_periodic_loads(system);
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

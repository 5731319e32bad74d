#include "libdyn/branches/plane_slopes.hpp"

#include <algorithm>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/system/number_slopes.hpp"
#include "libdyn/system/sloped_contact.hpp"
#include "libdyn/system/system_numbers.hpp"

namespace whirl::inline dyn {

namespace {

constexpr std::array compared{0.0625, 0.5, 0.90625};  ///< of a range, where numbers are
constexpr double exact_sum = 2e-13;  ///< of a block of numbers, to which they are a sum

double value_of(PlaneParameter by, double first, double second) {
  return by == PlaneParameter::first ? first : second;
}

/// Whether a + d = b + c, for numbers of four systems.
bool are_a_sum(const std::vector<Vec>& a, const std::vector<Vec>& b, const std::vector<Vec>& c,
               const std::vector<Vec>& d) {
  if (a.size() != b.size() || a.size() != c.size() || a.size() != d.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Eigen::Index size = a[k].size();
    if (b[k].size() != size || c[k].size() != size || d[k].size() != size) return false;
    if (size == 0) continue;
    double largest = 0.0;
    for (const Vec* v : {&a[k], &b[k], &c[k], &d[k]}) {
      largest = std::max(largest, v->lpNorm<Eigen::Infinity>());
    }
    const Vec rest = (a[k] - b[k]) - (c[k] - d[k]);
    if (!(rest.lpNorm<Eigen::Infinity>() <= exact_sum * largest)) return false;
  }
  return true;
}

/// Slopes of the depth over the clearance where it grazes, from those of the state there.
///
///   d(depth) = n . U dy + what the numbers of the contact change: of a ring
///   -n . d(offset) - d(clearance)
///
/// @param change  of the basis of the start
void add_depth(const ContactSystem& system, const SlopePanel& panel, double value,
               const NearestGraze& graze, const MotionSlopes& m, const BasisChange& change,
               RevolutionSlopes& to) {
  const auto i = static_cast<std::size_t>(graze.contact);
  const ReducedContact& c = system.contacts()[i];
  const Vec y = m.states.col(0);
  const ContactForces f =
      kinematics(c, graze.time * system.phase_rate(), y.data(), system.layout());
  const Vec by_eta = c.U.transpose() * f.n / c.clearance;
  const Vec by_rate = c.is_limit() ? Vec(c.V.transpose() * f.n / c.clearance) : Vec(0 * by_eta);
  const Vec weights = panel.weights(value);
  const NumberSlopes slopes(panel.secants(), weights);
  const StateLayout layout = system.layout();
  const SlopedContact contact = sloped_contact(system, i, slopes);
  const Vec2 u = c.U * layout.eta(y), rate = c.U * layout.rate(y);
  const Vec2 slip = c.rubs_apart() ? Vec2(c.V * layout.rate(y)) : rate;
  const GapMotion<ByParameter> motion{{u(0), u(1)}, {rate(0), rate(1)}, {slip(0), slip(1)}};
  const ByParameter depth =
      contact.gap(graze.time * system.phase_rate(), motion).depth / contact.clearance;
  const auto by_state = [&](const Mat& by) {
    return Vec(layout.eta(by).transpose() * by_eta + layout.rate(by).transpose() * by_rate);
  };
  to.depth_by_parameter = by_state(m.by_parameter[0].col(0))(0) + depth.slopes(0);
  if (m.by_start.empty()) return;
  to.depth_by_start = by_state(m.by_start[0]);
  if (!change.is_none()) to.depth_by_start = change.matrix().transpose() * to.depth_by_start;
}

}  // namespace

bool PlaneSlopes::is_sum() const {
  const auto numbers = [&](double x, double y) {
    const auto place = [](const ParameterEnds& of, double share) {
      return of.low + share * (of.high - of.low);
    };
    return numbers_of(at_(place(ends_[0], x), place(ends_[1], y))->contacts);
  };
  try {
    const auto corner = numbers(compared[0], compared[0]);
    std::vector<std::vector<Vec>> along;
    for (const double x : {compared[1], compared[2]}) along.push_back(numbers(x, compared[0]));
    for (const double y : {compared[1], compared[2]}) {
      const auto above = numbers(compared[0], y);
      if (!are_a_sum(numbers(compared[1], y), above, along[0], corner)) return false;
      if (!are_a_sum(numbers(compared[2], y), above, along[1], corner)) return false;
    }
  } catch (const NumericalError&) {
    return false;
  } catch (const ModelError&) {
    return false;
  }
  return true;
}

std::shared_ptr<const RangeSlopes> PlaneSlopes::line(PlaneParameter by, double first,
                                                     double second) const {
  const auto along = [&](RangeSlopes::SceneAt at, const ParameterEnds& ends) {
    return std::make_shared<const RangeSlopes>(std::move(at), at_(first, second), ends.low,
                                               ends.high);
  };
  if (by == PlaneParameter::first) {
    return along([at = at_, second](double value) { return at(value, second); }, ends_[0]);
  }
  return along([at = at_, first](double value) { return at(first, value); }, ends_[1]);
}

std::shared_ptr<const SlopePanel> PlaneSlopes::panel_at(PlaneParameter by, double first,
                                                        double second) const {
  std::shared_ptr<const RangeSlopes> along;
  {
    const std::lock_guard lock(mutex_);
    if (!is_sum_) {
      is_sum_ = is_sum();
      const double a = 0.5 * (ends_[0].low + ends_[0].high);
      const double b = 0.5 * (ends_[1].low + ends_[1].high);
      for (const auto of : {PlaneParameter::first, PlaneParameter::second}) {
        if (*is_sum_) of_sum_[static_cast<std::size_t>(of)] = line(of, a, b);
      }
    }
    along = of_sum_[static_cast<std::size_t>(by)];
  }
  if (!along) along = line(by, first, second);
  return along->panel_at(value_of(by, first, second));
}

std::optional<RevolutionSlopes> revolution_slopes(const Scene& scene, const Scene& first,
                                                  const SlopePanel& panel, double value,
                                                  const Vec& start, const RevolutionAsked& asked) {
  const ContactSystem& system = scene.contacts;
  const BasisChange change(scene, first);
  const auto own = [&](const Mat& deviations) -> Mat {
    return change.is_none() || deviations.size() == 0 ? deviations : change.matrix() * deviations;
  };
  MotionState at;
  at.y = change.to(start);
  std::vector<double> times;
  if (asked.graze) times.push_back(asked.graze->time);
  times.push_back(system.period());
  const MotionSlopes m = motion_slopes(system, at, times, panel, value,
                                       {.tolerance = slope_tolerance,
                                        .by_start = asked.by_start,
                                        .held = HeldSample::phase,
                                        .deviations = own(asked.deviations)});
  if (m.by_parameter.size() != times.size()) return std::nullopt;
  RevolutionSlopes slopes{.end = change.back(m.by_parameter.back())};
  bool is_finite = slopes.end.allFinite();
  const Eigen::Index count = asked.deviations.cols();
  slopes.deviations_by_parameter.resize(start.size(), count);
  for (Eigen::Index d = 0; d < count; ++d) {
    const auto k = static_cast<std::size_t>(d);
    slopes.deviations_by_parameter.col(d) = change.back(m.deviations_by_parameter[k]);
    if (!asked.by_start) continue;
    const Mat& by_start = m.deviations_by_start[k];
    slopes.deviations_by_start.push_back(
        change.is_none() ? by_start : change.back(by_start * change.matrix()));
    is_finite = is_finite && by_start.allFinite();
  }
  if (asked.graze) add_depth(system, panel, value, *asked.graze, m, change, slopes);
  is_finite = is_finite && slopes.deviations_by_parameter.allFinite();
  if (!is_finite) return std::nullopt;
  return slopes;
}

}  // namespace whirl::inline dyn

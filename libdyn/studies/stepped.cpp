#include "libdyn/studies/stepped.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <functional>

#include "libdyn/methods/rk4.hpp"
#include "libdyn/system/contact_measures.hpp"

namespace whirl::inline dyn {

namespace {

/// Copies of a motion near it, and how they grow apart.
class Copies {
 public:
  /// @param count  of them, one for each exponent
  Copies(const ContactSystem& system, double apart, Eigen::Index count)
      : system_(system),
        length_(apart * system.state_scale()),
        directions_(Mat::Identity(system.size(), count)),
        growth_(Vec::Zero(count)) {}

  /// As they are at the start of a revolution.
  void begin(const MotionState& motion) {
    all_.clear();
    for (Eigen::Index i = 0; i < directions_.cols(); ++i) {
      all_.push_back({.system = &system_, .state = motion, .revolutions = 1});
      all_.back().state.y += length_.cwiseProduct(directions_.col(i));
      all_.back().state.contacts.clear();  // as they follow from the motion
    }
  }

  /// Takes them through the revolution; false: one of them failed, as `failed` has it.
  bool go(const MotionState& end, const IntegrationOptions& options, Trajectory& failed) {
    integrate_batch_rk4(all_, options);
    Mat apart(directions_.rows(), directions_.cols());
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (all_[i].outcome != Outcome::reached_end) {
        failed.outcome = all_[i].outcome;
        failed.failure = all_[i].failure;
        return false;
      }
      apart.col(static_cast<Eigen::Index>(i)) = (all_[i].state.y - end.y).cwiseQuotient(length_);
    }
    const Eigen::HouseholderQR<Mat> qr(apart);
    directions_ = qr.householderQ() * Mat::Identity(apart.rows(), apart.cols());
    growth_ += qr.matrixQR().diagonal().cwiseAbs().array().log().matrix();
    return true;
  }

  /// Logarithms of what all displacements have grown by.
  const Vec& growth() const { return growth_; }

 private:
  const ContactSystem& system_;
  Vec length_;  ///< of a displacement, per state
  Mat directions_;
  Vec growth_;
  std::vector<Trajectory> all_;
};

/// Times of measures, which are shares of a whole [s].
std::vector<ContactTimes> times_of(const ContactMeter& meter, double whole) {
  std::vector<ContactTimes> all;
  for (const ContactMeasure& m : meter.measures()) {
    all.push_back({.name = m.name,
                   .in_touch = m.duty * whole,
                   .sticking = m.sticking * whole,
                   .impacts = m.impacts,
                   .max_normal = m.max_normal,
                   .max_tangential = m.max_tangential});
  }
  return all;
}

/// @param goes_on  called after every revolution; false: stop
void integrate_one(Trajectory& t, const BatchOptions& options, long steps, double apart,
                   const std::function<bool()>& goes_on) {
  const ContactSystem& system = *t.system;
  const IntegrationOptions equal{.fixed_step = system.period() / static_cast<double>(steps)};
  ContactMeter meter(system);
  Observer observer;
  if (options.measures) {
    observer = [&meter](const Step& step) {
      meter.add(step);
      return true;
    };
  }
  Copies copies(system, apart, exponents_of(system.size(), options.most_exponents));
  long done = 0;
  while (done < t.revolutions && t.outcome == Outcome::reached_end) {
    if (options.exponents) copies.begin(t.state);
    const Integration motion = Rk4::integrate(system, t.state, 1, equal, observer);
    t.cost += motion.cost;
    t.outcome = motion.outcome;
    t.failure = motion.failure;
    if (t.outcome != Outcome::reached_end) break;
    if (options.exponents && !copies.go(t.state, equal, t)) break;
    ++done;
    const Vec &y = t.state.y, &growth = copies.growth();
    if (options.sections) t.sections.insert(t.sections.end(), y.begin(), y.end());
    if (options.growths) t.growths.insert(t.growths.end(), growth.begin(), growth.end());
    if (!goes_on()) t.outcome = Outcome::stopped_by_observer;
    if (options.exponents && options.is_enough && options.is_enough(t)) break;
  }
  const double time = system.period() * static_cast<double>(done);
  if (options.measures) t.contacts = times_of(meter, time);
  if (!options.exponents || done == 0) return;
  t.exponents = copies.growth() / time;
  std::sort(t.exponents.begin(), t.exponents.end(), std::greater<>());
}

}  // namespace

void integrate_stepped(std::span<Trajectory> all, const BatchOptions& options, long steps,
                       double apart) {
  long done = 0;
  for (Trajectory& t : all) {
    integrate_one(t, options, steps, apart,
                  [&] { return !options.watch || options.watch(++done); });
  }
}

}  // namespace whirl::inline dyn

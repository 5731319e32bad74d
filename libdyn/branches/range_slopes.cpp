#include "libdyn/branches/range_slopes.hpp"

#include <algorithm>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/quadrature.hpp"
#include "libdyn/system/system_numbers.hpp"
#include "libdyn/taylor/motion_slopes.hpp"

namespace whirl::inline dyn {

namespace {

constexpr std::array point_counts{3, 9};        ///< of a panel: 2 or 8 secants
constexpr std::array checked{0.0625, 0.90625};  ///< places in a panel where it is compared
constexpr double exact = 2e-13;  ///< of a block of numbers, to which they are a polynomial
constexpr int most_halvings = 5;
constexpr double tolerance = 1e-14;  ///< of steps: impacts let errors grow

/// Whether a motion with slopes is much cheaper than its tangent: steps of both are short where a
/// force has no Taylor series at its surface, those of the motion alone are not.
bool is_cheap(const ContactSystem& system) {
  return system.films().empty() &&
         std::all_of(system.contacts().begin(), system.contacts().end(),
                     [](const ReducedContact& c) { return is_analytic(c.law); });
}

/// Slopes at a place of the polynomials that are 1 at one of some points and 0 at the others.
Vec lagrange_slopes(const Vec& points, double at) {
  Vec slopes = Vec::Zero(points.size());
  for (Eigen::Index j = 0; j < points.size(); ++j) {
    double value = 1.0;  // of the polynomial, factor by factor
    for (Eigen::Index k = 0; k < points.size(); ++k) {
      if (k == j) continue;
      const double by = 1.0 / (points(j) - points(k)), factor = (at - points(k)) * by;
      slopes(j) = slopes(j) * factor + value * by;
      value *= factor;
    }
  }
  return slopes;
}

/// Whether what is interpolated between systems are the numbers of another one.
bool is_interpolated(const std::vector<std::vector<Vec>>& known, const Vec& shares,
                     const std::vector<Vec>& wanted) {
  for (std::size_t b = 0; b < wanted.size(); ++b) {
    Vec rest = wanted[b];
    double size = rest.size() > 0 ? rest.lpNorm<Eigen::Infinity>() : 0.0;
    for (std::size_t j = 0; j < known.size(); ++j) {
      if (known[j].size() != wanted.size() || known[j][b].size() != rest.size()) return false;
      if (rest.size() == 0) continue;
      rest -= shares(static_cast<Eigen::Index>(j)) * known[j][b];
      size = std::max(size, known[j][b].lpNorm<Eigen::Infinity>());
    }
    if (rest.size() > 0 && !(rest.lpNorm<Eigen::Infinity>() <= exact * size)) return false;
  }
  return true;
}

}  // namespace

SlopePanel::SlopePanel(double low, double high, Vec points,
                       const std::vector<ContactSystem>& systems)
    : low_(low), high_(high), points_(std::move(points)) {
  for (std::size_t k = 0; k + 1 < systems.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const double length = (points_(at + 1) - points_(at)) * (high_ - low_);
    // neighbors with opposite weights: their difference is divided by the step
    secants_.push_back({"", neighbor_weights[0] * length, {systems[k + 1], systems[k]}});
  }
}

Vec SlopePanel::weights(double value) const {
  const Vec by = lagrange_slopes(points_, (value - low_) / (high_ - low_));
  // sum_j by_j c_j = sum_k (sum_(j > k) by_j) (c_(k+1) - c_k), as all by_j together are 0
  Vec weights(by.size() - 1);
  double sum = 0.0;
  for (Eigen::Index k = weights.size() - 1; k >= 0; --k) {
    sum += by(k + 1);
    weights(k) = sum * (points_(k + 1) - points_(k));
  }
  return weights;
}

std::shared_ptr<const Scene> RangeSlopes::scene_at(double value) const {
  auto scene = at_(value);
  const Mat &Phi = scene->reduced.Phi, &wanted = first_->reduced.Phi;
  if (Phi.rows() == wanted.rows() && Phi.cols() == wanted.cols() && Phi == wanted) return scene;
  throw NumericalError("the parameter changes the shapes that the rotor moves in");
}

bool RangeSlopes::keeps_shapes() const {
  for (const double x : checked) {
    try {
      scene_at(low_ + x * (high_ - low_));
    } catch (const NumericalError&) {
      return false;
    }
  }
  return true;
}

std::shared_ptr<const SlopePanel> RangeSlopes::made(double low, double high) const {
  const auto at_place = [&](double x) { return scene_at(low + x * (high - low))->contacts; };
  std::vector<std::vector<Vec>> compared;
  for (const double x : checked) compared.push_back(numbers_of(at_place(x)));
  const Mat places = Eigen::Map<const Vec>(checked.data(), std::ssize(checked));
  for (const int count : point_counts) {
    const Quadrature rule = Quadrature::gauss(count);
    std::vector<ContactSystem> systems;
    std::vector<std::vector<Vec>> numbers;
    for (const double x : rule.x) {
      systems.push_back(at_place(x));
      numbers.push_back(numbers_of(systems.back()));
    }
    const Mat shares = rule.interpolation(places);
    bool is_good = true;
    for (std::size_t i = 0; i < compared.size() && is_good; ++i) {
      const Vec row = shares.row(static_cast<Eigen::Index>(i)).transpose();
      is_good = is_interpolated(numbers, row, compared[i]);
    }
    if (is_good) return std::make_shared<const SlopePanel>(low, high, rule.x, systems);
  }
  return nullptr;
}

std::shared_ptr<const SlopePanel> RangeSlopes::panel_in(Part& part, double value, int depth) const {
  if (!part.is_known) {
    try {
      part.panel = made(part.low, part.high);
    } catch (const NumericalError&) {
    } catch (const ModelError&) {
    }  // without a panel
    part.is_known = true;
  }
  if (part.panel || depth == most_halvings) return part.panel;
  const double middle = 0.5 * (part.low + part.high);
  std::unique_ptr<Part>& half = part.halves[value < middle ? 0 : 1];
  if (!half) {
    half = std::make_unique<Part>();
    half->low = value < middle ? part.low : middle;
    half->high = value < middle ? middle : part.high;
  }
  return panel_in(*half, value, depth + 1);
}

std::shared_ptr<const SlopePanel> RangeSlopes::panel_at(double value) const {
  const std::lock_guard lock(mutex_);
  if (!whole_) {
    whole_.emplace();
    whole_->low = low_;
    whole_->high = high_;
    has_slopes_ = is_cheap(first_->contacts) && keeps_shapes();
  }
  return has_slopes_ ? panel_in(*whole_, value, 0) : nullptr;
}

std::optional<Vec> RangeSlopes::end_slope(double value, const MotionState& start,
                                          double revolutions) const {
  const auto panel = revolutions > 0.0 ? panel_at(value) : nullptr;
  if (!panel) return std::nullopt;
  try {
    const auto scene = scene_at(value);
    const ContactSystem& system = scene->contacts;
    const double time = revolutions * system.period();
    const MotionSlopes motion =
        motion_slopes(system, start, {&time, 1}, panel->secants(),
                      {.tolerance = tolerance, .by_start = false, .held = HeldSample::phase});
    if (motion.by_parameter.size() != 1) return std::nullopt;
    const Vec slope = motion.by_parameter[0] * panel->weights(value);
    if (!slope.allFinite()) return std::nullopt;
    return slope;
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace whirl::inline dyn

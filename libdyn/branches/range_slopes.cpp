#include "libdyn/branches/range_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/quadrature.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/system_numbers.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array point_counts{3, 9};        ///< of a panel: 2 or 8 secants
constexpr std::array checked{0.0625, 0.90625};  ///< places in a panel where it is compared
constexpr double exact = 2e-13;  ///< of a block of numbers, to which they are a polynomial
constexpr int most_halvings = 5;
// of numbers in shapes that change, each of which takes a reduction:
constexpr double exact_shapes = 2e-12;
constexpr int most_halvings_of_shapes = 3;
/// Errors that halves do not have less of, and less than this, are rounding of the shapes.
constexpr double rounding_of_shapes = 5e-9;
constexpr double falls = 0.1;  ///< of errors that halves have less of, over the whole

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

/// Largest difference of what is interpolated between systems from the numbers of another one, over
/// the largest number of its block.
double interpolation_error(const std::vector<std::vector<Vec>>& known, const Vec& shares,
                           const std::vector<Vec>& wanted) {
  double largest = 0.0;
  for (std::size_t b = 0; b < wanted.size(); ++b) {
    Vec rest = wanted[b];
    double size = rest.size() > 0 ? rest.lpNorm<Eigen::Infinity>() : 0.0;
    for (std::size_t j = 0; j < known.size(); ++j) {
      if (known[j].size() != wanted.size() || known[j][b].size() != rest.size()) return infinity;
      if (rest.size() == 0) continue;
      rest -= shares(static_cast<Eigen::Index>(j)) * known[j][b];
      size = std::max(size, known[j][b].lpNorm<Eigen::Infinity>());
    }
    const double error = rest.size() > 0 ? rest.lpNorm<Eigen::Infinity>() : 0.0;
    if (!std::isfinite(error)) return infinity;
    if (error > 0.0) largest = std::max(largest, error / size);
  }
  return largest;
}

/// T of eta = T eta_first.
Mat coordinates_of(const BasisChange& change) {
  const Mat& P = change.matrix();
  return P.topLeftCorner(P.rows() / 2, P.cols() / 2);
}

/// Tells equations in other coordinates, eta = T eta_first.
void tell_in_coordinates(const Mat& T, HarmonicProblem& problem) {
  const Mat back = DenseLu<Mat>(T).solve(Mat::Identity(T.rows(), T.cols()));
  for (Mat* A : {&problem.K, &problem.D}) *A = T * *A * back;
  for (HarmonicProblem::Load& load : problem.loads) {
    for (Vec* f : {&load.cosine, &load.sine}) *f = T * *f;
  }
  for (PortForces& force : problem.forces) {
    force.U = force.U * back;
    force.B = T * force.B;
  }
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

MotionSlopes motion_slopes(const ContactSystem& system, const MotionState& start,
                           std::span<const double> times, const SlopePanel& panel, double value,
                           const SlopeOptions& options) {
  MotionSlopes motion = motion_slopes(system, start, times, panel.secants(), options);
  const Vec weights = panel.weights(value);
  for (auto* by : {&motion.by_parameter, &motion.deviations_by_parameter}) {
    for (Mat& slopes : *by) slopes = (slopes * weights).eval();
  }
  return motion;
}

ContactSystem RangeSlopes::system_at(double value) const {
  const auto scene = at_(value);
  const BasisChange change(*scene, *first_);
  if (change.is_none()) return scene->contacts;
  if (!model_at_) throw NumericalError("the parameter changes the shapes that the rotor moves in");
  const Mat T = coordinates_of(change);
  const auto small = [&](const Mat& A) -> Mat { return T.transpose() * A * T; };
  const ReducedSystem& own = scene->reduced;
  const Model model = model_at_(value);
  return ContactSystem(scene->assembler, ReducedSystem{own.mapped(small), own.Phi * T, own.dofs},
                       model.contacts, model.films);
}

void RangeSlopes::look() const {
  for (const double x : checked) {
    const double value = low_ + x * (high_ - low_);
    try {
      system_at(value);
      is_reshaped_ = is_reshaped_ || !BasisChange(*at_(value), *first_).is_none();
    } catch (const NumericalError&) {
      return;
    }
  }
  has_slopes_ = true;
}

void RangeSlopes::make(Part& part, double error_of_whole) const {
  const auto at_place = [&](double x) { return system_at(part.low + x * (part.high - part.low)); };
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
    part.error = 0.0;
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const Vec row = shares.row(static_cast<Eigen::Index>(i)).transpose();
      part.error = std::max(part.error, interpolation_error(numbers, row, compared[i]));
    }
    const bool is_rounding = is_reshaped_ && count == point_counts.back() &&
                             part.error > falls * error_of_whole &&
                             part.error <= rounding_of_shapes;
    if (part.error <= (is_reshaped_ ? exact_shapes : exact) || is_rounding) {
      part.panel = std::make_shared<const SlopePanel>(part.low, part.high, rule.x, systems);
      return;
    }
  }
}

std::shared_ptr<const SlopePanel> RangeSlopes::panel_in(Part& part, double value, int depth,
                                                        double error_of_whole) const {
  if (!part.is_known) {
    try {
      make(part, error_of_whole);
    } catch (const NumericalError&) {
    } catch (const ModelError&) {
    }  // without a panel
    part.is_known = true;
  }
  const int most = is_reshaped_ ? most_halvings_of_shapes : most_halvings;
  if (part.panel || depth == most) return part.panel;
  const double middle = 0.5 * (part.low + part.high);
  std::unique_ptr<Part>& half = part.halves[value < middle ? 0 : 1];
  if (!half) {
    half = std::make_unique<Part>();
    half->low = value < middle ? part.low : middle;
    half->high = value < middle ? middle : part.high;
  }
  return panel_in(*half, value, depth + 1, part.error);
}

std::shared_ptr<const SlopePanel> RangeSlopes::panel_at(double value) const {
  const std::lock_guard lock(mutex_);
  if (!whole_) {
    whole_ = Part{.low = low_, .high = high_};
    look();
  }
  return has_slopes_ ? panel_in(*whole_, value, 0, infinity) : nullptr;
}

std::optional<Vec> RangeSlopes::end_slope(double value, const MotionState& start,
                                          double revolutions) const {
  // films ask for as many steps as tangents do, two plain motions for a fraction of them
  if (!(revolutions > 0.0) || !first_->contacts.films().empty()) return std::nullopt;
  const auto panel = panel_at(value);
  if (!panel) return std::nullopt;
  try {
    const ContactSystem system = system_at(value);
    const double time = revolutions * system.period();
    const MotionSlopes motion =
        motion_slopes(system, start, {&time, 1}, *panel, value,
                      {.tolerance = slope_tolerance, .by_start = false, .held = HeldSample::phase});
    if (motion.by_parameter.size() != 1) return std::nullopt;
    const Vec slope = motion.by_parameter[0];
    if (!slope.allFinite()) return std::nullopt;
    return slope;
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

std::optional<HarmonicProblem> RangeSlopes::problem_slope(double value) const {
  const auto panel = panel_at(value);
  if (!panel) return std::nullopt;
  try {
    const auto scene = at_(value);
    for (const SystemSlope& secant : panel->secants()) require_smooth(scene->contacts, secant);
    HarmonicProblem by =
        harmonic_slope(scene->contacts, NumberSlopes(panel->secants(), panel->weights(value)));
    const BasisChange change(*scene, *first_);
    if (!change.is_none()) tell_in_coordinates(coordinates_of(change), by);
    return by;
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace whirl::inline dyn

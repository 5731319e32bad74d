#include "libdyn/linear/modes_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"
#include "libbase/system/memory.hpp"
#include "libdyn/system/film_equilibrium.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double clear_growth = 1e-8;    ///< real part over size from which a mode grows, or decays
constexpr double threshold_tol = 1e-10;  ///< of the distance of two values

/// Modes of the models at values, with their shapes at the points of the first one.
class ModesAtValues {
 public:
  ModesAtValues(const ModelAt& model_at, int count, double first)
      : model_at_(model_at), count_(count), sampler_(Assembler(structure_at(first))) {}

  std::vector<ShapedValue> lowest(double value) {
    const Model model = model_at_(value);
    const Assembler assembler(linear_structure(model));
    const Modes modes = complex_modes(assembler, model.speed, count_ + spare_solutions);
    const DofMap dofs = assembler.at(model.speed).dofs;
    std::vector<ShapedValue> found;
    for (const Mode& mode : modes.oscillatory) {
      found.push_back({mode.frequency(), sampler_.at_points(assembler, dofs, mode.shape),
                       mode.lambda, static_cast<int>(found.size())});
    }
    known_[value] = modes.oscillatory;
    return found;
  }

  /// A mode that was found; none: there was a gap.
  const Mode& mode(double value, const ShapedValue& found) const {
    return known_.at(value).at(static_cast<std::size_t>(found.number));
  }

  Sparse weight() const { return sampler_.weight(); }

 private:
  Structure structure_at(double value) const { return linear_structure(model_at_(value)); }

  const ModelAt& model_at_;
  int count_;
  ShapeSampler sampler_;
  std::map<double, std::vector<Mode>> known_;
};

ModesOverBranch branch_of(const std::vector<ToldAt>& places, const std::vector<double>& values,
                          const ModesAtValues& modes) {
  const auto count = std::ssize(values);
  ModesOverBranch branch{.frequency = Vec::Constant(count, nan),
                         .log_decrement = Vec::Constant(count, nan),
                         .eigenvalue = CVec::Constant(count, Complex(nan, nan))};
  std::vector<Whirl> seen;
  for (const ToldAt& at : places) {
    const Mode& mode = modes.mode(values[static_cast<std::size_t>(at.index)], at.found);
    branch.frequency(at.index) = mode.frequency();
    branch.log_decrement(at.index) = mode.log_decrement();
    branch.eigenvalue(at.index) = mode.lambda;
    seen.push_back(mode.whirl);
  }
  branch.whirl = most_frequent(seen);
  return branch;
}

/// The sign of a real part; 0 within rounding.
int growth_of(Complex lambda) {
  if (std::abs(lambda.real()) <= clear_growth * std::abs(lambda)) return 0;
  return lambda.real() > 0.0 ? 1 : -1;
}

/// Where the real part of a branch is zero on the straight line between two of its places.
ModesOverThreshold threshold_on_line(const ShapeBranch& branch, std::size_t i, int number) {
  const Complex left = branch.found[i].eigenvalue, right = branch.found[i + 1].eigenvalue;
  const double share = left.real() / (left.real() - right.real());
  return {branch.at[i] + share * (branch.at[i + 1] - branch.at[i]),
          left.imag() + share * (right.imag() - left.imag()), number};
}

/// The eigenvalue of a branch between two of its places: that of the shape most like theirs.
Complex eigenvalue_between(const ShapeBranch& branch, std::size_t i, double at,
                           ModesAtValues& modes, const Sparse& W) {
  const ShapedValue &left = branch.found[i], &right = branch.found[i + 1];
  const double share = (at - branch.at[i]) / (branch.at[i + 1] - branch.at[i]);
  const Complex expected = left.eigenvalue + share * (right.eigenvalue - left.eigenvalue);
  const auto alike = [&](const ShapedValue& a, const ShapedValue& b) {
    return share_within(a.shape, b.shape / std::sqrt(b.shape.dot(CVec(W * b.shape)).real()), W);
  };
  double best = -INFINITY;
  Complex lambda(nan, nan);
  for (const ShapedValue& found : modes.lowest(at)) {
    const double away = std::abs(found.eigenvalue - expected) /
                        (std::abs(right.eigenvalue - left.eigenvalue) + 1e-3 * std::abs(expected));
    const double score = std::max(alike(found, left), alike(found, right)) - away;
    if (score > best) best = score, lambda = found.eigenvalue;
  }
  return lambda;
}

/// Where the real part of a branch is zero between two of its places, to threshold_tol; on the
/// straight line between them if a model there cannot be computed.
ModesOverThreshold threshold_between(const ShapeBranch& branch, std::size_t i, int number,
                                     ModesAtValues& modes, const Sparse& W) {
  const auto at = [&](double value) { return eigenvalue_between(branch, i, value, modes, W); };
  try {
    const double root =
        bracketed_root([&](double value) { return at(value).real(); }, branch.at[i],
                       branch.at[i + 1], threshold_tol * (branch.at[i + 1] - branch.at[i]));
    return {root, std::isfinite(root) ? at(root).imag() : nan, number};
  } catch (const NumericalError&) {
  } catch (const ModelError&) {  // such as a number that must be whole
  }
  return threshold_on_line(branch, i, number);
}

void add_thresholds(const ShapeBranch& branch, int number, ModesAtValues& modes, const Sparse& W,
                    std::vector<ModesOverThreshold>& thresholds) {
  int before = 0;
  std::size_t from = 0;  // the last place with a sign
  for (std::size_t i = 0; i < branch.at.size(); ++i) {
    const int now = growth_of(branch.found[i].eigenvalue);
    if (now != 0 && before != 0 && now != before) {
      if (i > from + 1) {  // a place between them is one, to rounding
        thresholds.push_back({branch.at[from + 1], branch.found[from + 1].value, number});
      } else {
        const ModesOverThreshold found = threshold_between(branch, from, number, modes, W);
        if (std::isfinite(found.value)) thresholds.push_back(found);
      }
    }
    if (now != 0) before = now, from = i;
  }
}

}  // namespace

ModesOver modes_over(const ModelAt& model_at, ParameterName parameter,
                     const std::vector<double>& values, int count) {
  ModesOver result;
  result.parameter = std::move(parameter);
  result.values = values;
  ModesAtValues modes(model_at, count, values.front());
  constexpr double kept = 8.0 * sizeof(Complex);  // of modes that are twice as many as told
  require_memory("over",
                 kept * count * static_cast<double>(modes.weight().rows()) *
                     static_cast<double>(values.size()),
                 fmt::format("the shapes of {} modes at {} values", count, values.size()),
                 "give fewer values, or fewer modes");
  const SolveShapes solve = [&](double value) { return modes.lowest(value); };
  const Sparse W = modes.weight();
  const ShapeBranches followed = follow_shapes(values, solve, W, shape_limit(values, solve, count));
  for (const ShapeBranch& branch : followed.branches) {
    const std::vector<ToldAt> places = told_places(branch, values);
    if (!is_among_lowest(places, count)) continue;
    const auto number = static_cast<int>(result.branches.size());
    result.branches.push_back(branch_of(places, values, modes));
    add_thresholds(branch, number, modes, W, result.thresholds);
  }
  std::stable_sort(result.thresholds.begin(), result.thresholds.end(),
                   [](const auto& a, const auto& b) { return a.value < b.value; });
  result.gaps = gaps_of(followed);
  return result;
}

}  // namespace whirl::inline dyn

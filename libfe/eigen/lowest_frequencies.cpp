#include "libfe/eigen/lowest_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/eigen/disc.hpp"

namespace whirl::inline fe {

namespace {

constexpr int cells_up = 8;      ///< cells of the sector along Im lambda
constexpr int usual_basis = 60;  ///< vectors of a disc that may be divided: large ones cost more
constexpr double step = 2.0;     ///< of the top frequency where too few are found
constexpr double equal = 1e-7;   ///< relative distance of equal eigenvalues
constexpr double same = 1e-9;    ///< relative: a frequency that belongs to those below the top
constexpr double beyond = 4.0;   ///< over the damping time: modes are overdamped above, and more
constexpr double finest = 1e-4;  ///< size of a cell over its distance from zero

/// A rectangle of the upper half plane, left or right of the imaginary axis.
struct Cell {
  int sign = -1;                 ///< of Re lambda
  double near = 0.0, far = 0.0;  ///< |Re lambda|
  double low = 0.0, high = 0.0;  ///< Im lambda

  Complex center() const { return {sign * 0.5 * (near + far), 0.5 * (low + high)}; }
  /// Largest distance of one of its points.
  double reach(Complex from) const {
    const double x =
        std::max(std::abs(sign * near - from.real()), std::abs(sign * far - from.real()));
    const double y = std::max(std::abs(low - from.imag()), std::abs(high - from.imag()));
    return std::hypot(x, y);
  }
  bool is_possible(const FrequencySearch& search) const {
    return near < search.slope * high && search.bounds.allow(sign, near, far, high);
  }
};

/// The possible part of the sector up to a frequency.
std::vector<Cell> sector_cells(double top, const FrequencySearch& search) {
  std::vector<Cell> cells;
  const double size = top / cells_up;
  const int across = static_cast<int>(std::ceil(search.slope * cells_up));
  for (const int sign : {-1, 1}) {
    for (int i = 0; i < across; ++i) {
      for (int j = 0; j < cells_up; ++j) {
        const Cell cell{sign, i * size, (i + 1) * size, j * size, (j + 1) * size};
        if (cell.is_possible(search)) cells.push_back(cell);
      }
    }
  }
  return cells;
}

bool is_in_sector(Complex lambda, double slope) {
  return lambda.imag() > 0.0 && std::abs(lambda.real()) < slope * lambda.imag();
}

/// Frequencies of the sector, ascending.
std::vector<double> frequencies_of(std::span<const Complex> lambda, double slope) {
  std::vector<double> all;
  for (const Complex each : lambda) {
    if (is_in_sector(each, slope)) all.push_back(each.imag());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// How far from a point a disc must reach to hold the sector up to a frequency, where eigenvalues
/// can be.
double reach_of_sector(double center, double top, const FrequencySearch& search) {
  double reach = 0.0;
  for (const Cell& cell : sector_cells(top, search)) {
    reach = std::max(reach, cell.reach(center));
  }
  return reach;
}

/// The disc about the center of the search: it grows until all that is wanted is in it, or until
/// a basis of the largest size would not do. Frequencies of a beam, and so the radius, grow with
/// the square of their number.
DiscModes first_disc(const DiscSolver& solver, const FrequencySearch& search) {
  const auto count = static_cast<std::size_t>(search.count);
  if (!search.is_proven) {
    return solver.around(
        search.center,
        [&](double, std::span<const Complex> lambda, double) -> std::optional<double> {
          const bool is_enough = frequencies_of(lambda, search.slope).size() >= count;
          return is_enough ? 0.0 : std::numeric_limits<double>::infinity();
        },
        {.is_confirmed = false});
  }
  return solver.around(
      search.center,
      [&](double radius, std::span<const Complex> lambda, double effort) -> std::optional<double> {
        const std::vector<double> found = frequencies_of(lambda, search.slope);
        if (found.size() < count) return std::numeric_limits<double>::infinity();
        const double top = count > 0 ? found[count - 1] * (1.0 + same) : 0.0;
        const double reach = reach_of_sector(search.center, top, search);
        if (effort * std::sqrt(reach / radius) > 1.0) return std::nullopt;
        return reach;
      });
}

class Cover {
 public:
  Cover(const Sparse& M, const Sparse& D, const Sparse& K, const FrequencySearch& search)
      : solver_(M, D, K), search_(search), first_(first_disc(solver_, search)) {
    add(first_);
  }

  const DiscModes& first() const { return first_; }

  /// Finds every eigenvalue of the sector up to a frequency.
  void extend(double top) { cover(sector_cells(top, search_)); }

  /// Frequencies of the sector found so far, ascending; complete up to the last top.
  std::vector<double> frequencies() const {
    std::vector<Complex> lambda;
    for (const Found& f : found_) lambda.push_back(f.lambda);
    return frequencies_of(lambda, search_.slope);
  }

  QuadraticModes result(double top) const {
    std::vector<const Found*> kept, others;
    for (const Found& f : found_) {
      if (!is_in_sector(f.lambda, search_.slope)) {
        if (f.is_first) others.push_back(&f);
      } else if (f.lambda.imag() <= top) {
        kept.push_back(&f);
      }
    }
    std::sort(kept.begin(), kept.end(),
              [](const Found* a, const Found* b) { return a->lambda.imag() < b->lambda.imag(); });
    std::sort(others.begin(), others.end(), [](const Found* a, const Found* b) {
      return std::abs(a->lambda) < std::abs(b->lambda);
    });
    kept.insert(kept.end(), others.begin(), others.end());
    const auto size = static_cast<Eigen::Index>(kept.size());
    QuadraticModes modes{CVec(size), CMat(first_.q.rows(), size)};
    for (Eigen::Index i = 0; i < size; ++i) {
      modes.lambda(i) = kept[static_cast<std::size_t>(i)]->lambda;
      modes.q.col(i) = kept[static_cast<std::size_t>(i)]->q;
    }
    return modes;
  }

 private:
  static constexpr int any = std::numeric_limits<int>::max();

  struct Found {
    Complex lambda;
    CVec q;
    bool is_first;  ///< from the first disc
  };

  /// Takes what no earlier disc has, and of equal eigenvalues those that an earlier one has missed.
  void add(const DiscModes& disc) {
    const auto before = static_cast<std::ptrdiff_t>(found_.size());
    for (Eigen::Index i = 0; i < disc.lambda.size(); ++i) {
      const Complex lambda = disc.lambda(i);
      if (lambda.imag() < 0.0) continue;
      const auto is_equal = [&](Complex other) {
        return std::abs(other - lambda) <= equal * std::abs(lambda);
      };
      const auto own = std::count_if(disc.lambda.begin(), disc.lambda.begin() + i + 1, is_equal);
      const auto known = std::count_if(found_.begin(), found_.begin() + before,
                                       [&](const Found& f) { return is_equal(f.lambda); });
      const bool is_contained =
          std::any_of(discs_.begin(), discs_.end(),
                      [&](const DiscModes& earlier) { return earlier.contains(lambda); });
      const bool is_missed = known > 0 && known < own;
      if (!is_contained || is_missed) found_.push_back({lambda, disc.q.col(i), discs_.empty()});
    }
    discs_.push_back({disc.center, disc.radius, CVec(0), CMat(0, 0)});
  }

  bool is_covered(const Cell& cell) const {
    return std::any_of(discs_.begin(), discs_.end(), [&](const DiscModes& disc) {
      return cell.reach(disc.center) <= disc.radius;
    });
  }

  void cover(std::vector<Cell> cells) {
    std::erase_if(cells, [&](const Cell& cell) { return is_covered(cell); });
    if (cells.empty()) return;
    if (cells.size() == 1) return refine(cells.front());
    const auto by_real = [](const Cell& a, const Cell& b) {
      return a.center().real() < b.center().real();
    };
    const auto by_imag = [](const Cell& a, const Cell& b) {
      return a.center().imag() < b.center().imag();
    };
    const auto [left, right] = std::minmax_element(cells.begin(), cells.end(), by_real);
    const auto [low, high] = std::minmax_element(cells.begin(), cells.end(), by_imag);
    const double width = right->center().real() - left->center().real(),
                 height = high->center().imag() - low->center().imag();
    const Complex middle{0.5 * (right->center().real() + left->center().real()),
                         0.5 * (high->center().imag() + low->center().imag())};
    if (try_disc(middle, cells, usual_basis)) return;
    const auto second = std::partition(cells.begin(), cells.end(), [&](const Cell& cell) {
      return width >= height ? cell.center().real() < middle.real()
                             : cell.center().imag() < middle.imag();
    });
    cover({cells.begin(), second});
    cover({second, cells.end()});
  }

  /// Whether a disc about a point that is not in another one covers all cells.
  bool try_disc(Complex center, const std::vector<Cell>& cells, int most) {
    double radius = 0.0;
    for (const Cell& cell : cells) radius = std::max(radius, cell.reach(center));
    if (static_cast<int>(discs_.size()) >= search_.most_discs) {
      throw NumericalError("the damped frequencies cannot be told apart from overdamped motions");
    }
    const DiscModes disc = solver_.around(center, radius, any, {.most = most});
    add(disc);
    return disc.radius >= radius;
  }

  void refine(const Cell& cell) {
    if (try_disc(cell.center(), {cell}, DiscSolver::largest_basis)) return;
    const double x = 0.5 * (cell.near + cell.far), y = 0.5 * (cell.low + cell.high);
    if (cell.far - cell.near < finest * std::abs(cell.center())) {
      throw NumericalError("too many damped frequencies are too close to one another");
    }
    std::vector<Cell> parts{{cell.sign, cell.near, x, cell.low, y},
                            {cell.sign, x, cell.far, cell.low, y},
                            {cell.sign, cell.near, x, y, cell.high},
                            {cell.sign, x, cell.far, y, cell.high}};
    std::erase_if(parts, [&](const Cell& part) { return !part.is_possible(search_); });
    for (const Cell& part : parts) cover({part});
  }

  DiscSolver solver_;
  FrequencySearch search_;
  std::vector<DiscModes> discs_;  ///< without their eigenpairs
  std::vector<Found> found_;
  DiscModes first_;
};

}  // namespace

QuadraticModes lowest_frequencies(const Sparse& M, const Sparse& D, const Sparse& K,
                                  const FrequencySearch& search) {
  Cover cover(M, D, K, search);
  const auto wanted = static_cast<std::size_t>(search.count);
  const double most = search.bounds.are_known && search.bounds.least_damping > 0.0
                          ? beyond / search.bounds.least_damping
                          : std::numeric_limits<double>::infinity();
  double top = cover.first().radius;
  if (!(top > 0.0)) throw NumericalError("no eigenvalue of the damped system was found");
  for (;;) {
    std::vector<double> frequencies = cover.frequencies();
    if (frequencies.size() >= wanted) top = frequencies[wanted - 1] * (1.0 + same);
    if (!std::isfinite(top) || !search.is_proven) return cover.result(top);
    cover.extend(top);
    frequencies = cover.frequencies();
    std::erase_if(frequencies, [&](double w) { return w > top; });
    if (frequencies.size() >= wanted) {
      return cover.result(frequencies[wanted - 1] * (1.0 + same));
    }
    if (top > most) return cover.result(top);
    top *= step;
  }
}

}  // namespace whirl::inline fe

#include "libdata/fit/fit_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::inline data {

namespace {

/// A block of a matrix as its entries.
void add_block(std::vector<Triplet>& entries, Eigen::Index row, Eigen::Index column,
               const Mat& block) {
  for (Eigen::Index j = 0; j < block.cols(); ++j) {
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
      if (block(i, j) == 0.0) continue;
      entries.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j), block(i, j));
    }
  }
}

/// Columns of the unknowns of a record.
struct RecordColumns {
  Eigen::Index offset, starts;
};

std::vector<RecordColumns> columns_of(const FitSearch& search) {
  Eigen::Index at = search.x.size();
  std::vector<RecordColumns> columns;
  for (const RecordShooting& shooting : search.shootings) {
    columns.push_back({.offset = at, .starts = 0});
    if (shooting.has_offset()) at += shooting.offset.size();
  }
  for (std::size_t s = 0; s < columns.size(); ++s) {
    columns[s].starts = at;
    for (const Vec& start : search.shootings[s].starts) at += start.size();
  }
  return columns;
}

/// Residuals of one window: of its readings, then of what is left to the next window.
struct WindowResiduals {
  const FitSearch& search;
  const RecordShooting& shooting;
  RecordColumns columns;
  std::size_t window;

  /// @return  false where the motion does not get through
  bool add(Eigen::Ref<Vec> r, Eigen::Index row, std::vector<Triplet>* entries) const {
    if (!shooting.system) return false;
    const ShootingWindow& of = shooting.windows[window];
    const Eigen::Index n = of.states(), m = of.readings();
    const Vec& scale = shooting.scale;
    const auto found = of.compare(*shooting.system, shooting.starts[window].cwiseProduct(scale),
                                  shooting.offset * shooting.length, entries != nullptr);
    if (!found.is_good) return false;
    r.segment(row, m) = found.readings;
    const Vec per_gap = (shooting.gap * search.between).cwiseInverse();
    const std::size_t next = (window + 1) % shooting.starts.size();
    if (of.has_next()) {
      const Vec from = shooting.starts[next].cwiseProduct(scale);
      r.segment(row + m, n) = (found.end - from).cwiseProduct(per_gap);
    }
    if (!entries) return true;
    const Eigen::Index start = columns.starts + n * static_cast<Eigen::Index>(window);
    add_block(*entries, row, 0, found.readings_by_parameter * search.sizes.asDiagonal());
    add_block(*entries, row, start, found.readings_by_start * scale.asDiagonal());
    if (shooting.has_offset()) {
      add_block(*entries, row, columns.offset, of.readings_by_offset() * shooting.length);
    }
    if (!of.has_next()) return true;
    const auto gap = [&](const Mat& by, const Vec& per) {
      return Mat(per_gap.asDiagonal() * by * per.asDiagonal());
    };
    add_block(*entries, row + m, 0, gap(found.end_by_parameter, search.sizes));
    add_block(*entries, row + m, start, gap(found.end_by_start, scale));
    const Eigen::Index after = columns.starts + n * static_cast<Eigen::Index>(next);
    add_block(*entries, row + m, after, gap(-Mat::Identity(n, n), scale));
    return true;
  }
};

}  // namespace

FitLeastSquares::FitLeastSquares(FitSearch& search) : search_(search) {}

std::vector<Vec*> FitLeastSquares::unknowns() const {
  std::vector<Vec*> all{&search_.x};
  for (RecordShooting& shooting : search_.shootings) {
    if (shooting.has_offset()) all.push_back(&shooting.offset);
  }
  for (RecordShooting& shooting : search_.shootings) {
    for (Vec& start : shooting.starts) all.push_back(&start);
  }
  return all;
}

Vec FitLeastSquares::place() const {
  std::vector<double> all;
  for (const Vec* one : unknowns()) all.insert(all.end(), one->begin(), one->end());
  return Vec::Map(all.data(), std::ssize(all));
}

void FitLeastSquares::go_to(const Vec& place) {
  Eigen::Index at = 0;
  for (Vec* one : unknowns()) {
    *one = place.segment(at, one->size());
    at += one->size();
  }
}

bool FitLeastSquares::residuals(Vec& r, std::vector<Triplet>* entries) {
  if (systems_at_.size() == 0 || systems_at_ != search_.x) {
    search_.make_systems();
    systems_at_ = search_.x;
  }
  const std::vector<RecordColumns> columns = columns_of(search_);
  Eigen::Index count = 0, row = 0;
  for (const RecordShooting& shooting : search_.shootings) {
    for (const ShootingWindow& window : shooting.windows) count += window.residuals();
  }
  r.resize(count);
  for (std::size_t s = 0; s < columns.size(); ++s) {
    const RecordShooting& shooting = search_.shootings[s];
    for (std::size_t w = 0; w < shooting.windows.size(); ++w) {
      if (search_.options.is_stopped && search_.options.is_stopped()) return false;
      if (!WindowResiduals{search_, shooting, columns[s], w}.add(r, row, entries)) return false;
      row += shooting.windows[w].residuals();
    }
  }
  return true;
}

Vec FitLeastSquares::bounds(double FreeParameter::*side, double none) const {
  Vec all = Vec::Constant(place().size(), none);
  for (std::size_t p = 0; p < search_.parameters.size(); ++p) {
    const FreeParameter& parameter = search_.parameters[p];
    all(static_cast<Eigen::Index>(p)) = parameter.*side / parameter.size;
  }
  return all;
}

DoglegResult FitLeastSquares::solve(double between, int most_iterations, double tolerance) {
  search_.between = between;
  const Vec start = place();
  const Eigen::Index moved = start.size() - (are_parameters_held_ ? search_.x.size() : 0);
  const auto all_of = [&](const Vec& x) {
    Vec all = start;
    all.tail(moved) = x;
    return all;
  };
  const LeastSquares problem{.evaluate =
                                 [&](const Vec& x, Vec& r, Sparse* J) {
                                   go_to(all_of(x));
                                   std::vector<Triplet> entries;
                                   if (!residuals(r, J ? &entries : nullptr)) return false;
                                   if (!J) return true;
                                   Sparse all(r.size(), start.size());
                                   all.setFromTriplets(entries.begin(), entries.end());
                                   *J = all.rightCols(moved);
                                   return true;
                                 },
                             .lower = bounds(&FreeParameter::lower, -HUGE_VAL).tail(moved),
                             .upper = bounds(&FreeParameter::upper, HUGE_VAL).tail(moved)};
  const auto& is_stopped = search_.options.is_stopped;
  DoglegResult found = dogleg(
      problem, start.tail(moved),
      {.most_iterations = most_iterations, .cost_tolerance = tolerance, .is_stopped = is_stopped});
  if (is_stopped && is_stopped()) found.end = DoglegEnd::stopped;  // within an evaluation, maybe
  go_to(all_of(found.x));
  iterations_ += found.iterations;
  return found;
}

DoglegResult FitLeastSquares::finish(double between, int most_iterations, double tolerance) {
  constexpr int before_leap = 15;
  const int begun = iterations_;
  for (;;) {
    const int left = most_iterations - (iterations_ - begun);
    const auto found = solve(between, std::clamp(left, 1, before_leap), tolerance);
    if (found.end != DoglegEnd::most_iterations || left <= before_leap) return found;
    leap(between);
  }
}

FitJacobian FitLeastSquares::jacobian() {
  Vec r;
  std::vector<Triplet> entries, readings, gaps;
  if (!residuals(r, &entries)) return {};
  std::vector<int> row_of;  // within the readings, from 0, or within the gaps, from -1 down
  int of_readings = 0, of_gaps = 0;
  for (const RecordShooting& shooting : search_.shootings) {
    for (const ShootingWindow& window : shooting.windows) {
      for (Eigen::Index i = 0; i < window.residuals(); ++i) {
        row_of.push_back(i < window.readings() ? of_readings++ : -1 - of_gaps++);
      }
    }
  }
  for (const Triplet& entry : entries) {
    const int row = row_of[static_cast<std::size_t>(entry.row())];
    if (row >= 0) readings.emplace_back(row, entry.col(), entry.value());
    if (row < 0) gaps.emplace_back(-1 - row, entry.col(), entry.value());
  }
  const Eigen::Index columns = place().size();
  FitJacobian found{.readings = Sparse(of_readings, columns), .gaps = Sparse(of_gaps, columns)};
  found.readings.setFromTriplets(readings.begin(), readings.end());
  found.gaps.setFromTriplets(gaps.begin(), gaps.end());
  return found;
}

std::vector<Eigen::Index> FitLeastSquares::idle_parameters() {
  std::vector<Eigen::Index> idle;
  const FitJacobian J = jacobian();
  for (Eigen::Index p = 0; p < std::min(search_.x.size(), J.readings.cols()); ++p) {
    if (J.is_idle(p)) idle.push_back(p);
  }
  return idle;
}

bool FitLeastSquares::does_something_at(double x, Eigen::Index parameter) {
  const FreeParameter& p = search_.parameters[static_cast<std::size_t>(parameter)];
  const double value = x * p.size;
  if (!(value > p.lower && value < p.upper)) return false;
  search_.x(parameter) = x;
  const FitJacobian J = jacobian();
  return J.readings.cols() > parameter && !J.is_idle(parameter);
}

bool FitLeastSquares::rouse() {
  constexpr double noises = 1.5;  // that may be left of records that are explained
  constexpr double step = 0.97, furthest = 1.0 / 3.0, beyond = 0.9;
  const double cost = cost_at(place());
  if (!std::isfinite(cost)) return false;
  if (2.0 * cost < noises * noises * static_cast<double>(search_.readings())) return false;
  std::vector<Eigen::Index> idle = idle_parameters();
  std::erase_if(idle, [&](Eigen::Index p) { return search_.x(p) == 0.0; });  // times what it may be
  if (idle.empty()) return false;
  for (double factor = step; factor > furthest; factor *= step) {
    if (search_.options.is_stopped && search_.options.is_stopped()) return false;
    for (const Eigen::Index p : idle) {
      const double own = search_.x(p);
      for (const double way : {factor, 1.0 / factor}) {
        if (!does_something_at(own * way, p)) continue;
        const double further = way < 1.0 ? beyond : 1.0 / beyond;
        if (!does_something_at(own * way * further, p)) search_.x(p) = own * way;
        return true;
      }
      search_.x(p) = own;
    }
  }
  return false;
}

double FitLeastSquares::cost_at(const Vec& place) {
  go_to(place);
  const Vec values = search_.values();
  for (std::size_t p = 0; p < search_.parameters.size(); ++p) {
    const FreeParameter& parameter = search_.parameters[p];
    const double value = values(static_cast<Eigen::Index>(p));
    if (value < parameter.lower || value > parameter.upper) return HUGE_VAL;
  }
  Vec r;
  return residuals(r, nullptr) ? 0.5 * r.squaredNorm() : HUGE_VAL;
}

void FitLeastSquares::leap(double between) {
  constexpr double along = 0.9, furthest = 100.0;  // cosine of two such steps; times the last one
  const Vec first = place();
  solve(between, 1, 0.0);
  const Vec second = place();
  const double cost = solve(between, 1, 0.0).cost;
  const Vec third = place(), b = second - first, c = third - second;
  const double q = c.dot(b) / b.squaredNorm();
  if (!(c.dot(b) > along * c.norm() * b.norm()) || !(q < 1.0)) return;
  for (double far = std::min(q / (1.0 - q), furthest); far > 1.0; far *= 0.5) {
    if (cost_at(third + far * c) < cost) return;
  }
  go_to(third);
}

}  // namespace whirl::inline data

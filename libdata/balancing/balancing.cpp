#include "libdata/balancing/balancing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libdata/balancing/confidence.hpp"
#include "libdata/balancing/quality_grade.hpp"

namespace whirl::inline data {

namespace {

std::vector<std::string> plane_names(const BalancingInput& input) {
  std::vector<std::string> names;
  for (const BalancingPlane& plane : input.planes) names.push_back(plane.name);
  return names;
}

CorrectionProblem problem_of(const BalancingInput& input, const std::vector<InfluenceLine>& lines) {
  const auto m = std::ssize(lines), n = std::ssize(input.planes);
  CorrectionProblem p{CMat(m, n), CVec(m), Vec(m), Vec(n), input.criterion};
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto at = static_cast<std::size_t>(j);
    p.A.row(j) = lines[at].coefficients.transpose();
    p.V(j) = lines[at].at(input.kept);
    p.weight(j) = input.probes[input.places[at].probe].weight;
  }
  for (Eigen::Index k = 0; k < n; ++k) p.limit(k) = input.planes[static_cast<std::size_t>(k)].limit;
  return p;
}

void require_linear(const BalancingInput& input, Balancing& found) {
  if (found.nonlinearity <= most_nonlinearity) return;
  const std::string what = fmt::format(
      "{:.0f} % of what the runs change does not follow their weights: the vibration is not linear "
      "in the unbalance, as that of a rotor that rubs, or the runs do not repeat",
      100.0 * found.nonlinearity);
  if (!input.accepts_nonlinear) throw OptionError(what);
  found.notes.push_back(what);
}

/// Puts the weight of a plane into its holes.
Complex placed_in(const BalancingHoles& holes, Complex weight, int plane,
                  const BalancingConvention& convention, std::vector<HoleBalance>& to) {
  const Vec masses = split_over_holes(holes, weight);
  Complex sum = 0.0;
  for (Eigen::Index i = 0; i < masses.size(); ++i) {
    if (masses(i) == 0.0) continue;
    const Complex piece = std::polar(masses(i), holes.angles(i));
    to.push_back({plane, convention.told_angle(piece), masses(i)});
    sum += piece;
  }
  return sum;
}

void add_planes(const BalancingInput& input, const Correction& correction, Balancing& found) {
  for (std::size_t k = 0; k < input.planes.size(); ++k) {
    const BalancingPlane& plane = input.planes[k];
    PlaneBalance row{.name = plane.name,
                     .weight = correction.weights(static_cast<Eigen::Index>(k))};
    row.placed = plane.holes ? placed_in(*plane.holes, row.weight, static_cast<int>(k),
                                         input.convention, found.holes)
                             : row.weight;
    row.mass = std::abs(row.placed);
    row.angle = input.convention.told_angle(row.placed);
    row.limit = plane.limit;
    if (plane.radius > 0.0) row.radius = plane.radius;
    found.planes.push_back(std::move(row));
  }
}

void add_readings(const BalancingInput& input, const std::vector<InfluenceLine>& lines,
                  const CVec& placed, Balancing& found) {
  const BalancingConvention& told = input.convention;
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const BalancingProbe& probe = input.probes[input.places[j].probe];
    ReadingBalance row{.probe = probe.name,
                       .speed = input.places[j].speed,
                       .unit = probe.unit,
                       .si_unit = probe.si_unit,
                       .per_unit = probe.per_unit,
                       .influence = lines[j].coefficients};
    row.before = lines[j].at(input.kept);
    row.after = lines[j].at(input.kept + placed);
    row.told_before = told.told_amplitude(row.before) / probe.per_unit;
    row.told_after = told.told_amplitude(row.after) / probe.per_unit;
    row.phase_before = told.told_phase(row.before);
    row.phase_after = told.told_phase(row.after);
    if (probe.allowed > 0.0) row.allowed = told.per_peak() * probe.allowed / probe.per_unit;
    found.readings.push_back(std::move(row));
  }
}

/// How sure all of it is, where anything says it.
void add_confidence(const BalancingInput& input, const std::vector<InfluenceLine>& lines,
                    const CorrectionProblem& problem, const CVec& placed, Balancing& found) {
  std::vector<std::size_t> probe;
  for (const ReadingPlace& place : input.places) probe.push_back(place.probe);
  Vec given(std::ssize(input.probes));
  for (std::size_t p = 0; p < input.probes.size(); ++p) {
    given(static_cast<Eigen::Index>(p)) = input.probes[p].uncertainty;
  }
  const auto variance = reading_variance(lines, probe, given);
  if (!variance) {
    found.notes.push_back(
        "how sure the weights are is not known: repeat a run, or give each probe an uncertainty");
    return;
  }
  const BalancingConfidence sure =
      confidence_of(lines, *variance, problem.weight, input.kept + placed);
  for (std::size_t k = 0; k < found.planes.size(); ++k) {
    PlaneBalance& plane = found.planes[k];
    plane.uncertainty = sure.weights(static_cast<Eigen::Index>(k));
    if (plane.uncertainty < std::abs(plane.weight)) continue;
    found.notes.push_back(fmt::format(
        "the weight in plane {} is no larger than its uncertainty: it may as well be left out",
        plane.name));
  }
  for (std::size_t j = 0; j < found.readings.size(); ++j) {
    ReadingBalance& reading = found.readings[j];
    reading.uncertainty = input.convention.per_peak() *
                          sure.readings(static_cast<Eigen::Index>(j)) / reading.per_unit;
  }
}

/// Residual unbalances beside those of the grade.
void add_grade(const BalancingInput& input, Balancing& found) {
  for (PlaneBalance& plane : found.planes) {
    const double unsure = std::isfinite(plane.uncertainty) ? plane.uncertainty : 0.0;
    plane.left = plane.radius * (std::abs(plane.weight - plane.placed) + unsure);
  }
  if (!input.grade) return;
  const RotorGrade& g = *input.grade;
  found.permissible = permissible_unbalance(g.grade, g.mass, g.speed);
  if (found.planes.size() == 1) found.planes[0].permissible = found.permissible;
  if (found.planes.size() != 2) return;
  const auto &left = input.planes[0].z, &right = input.planes[1].z;
  const auto shares = left && right && g.center ? plane_shares(*left, *right, *g.center)
                                                : std::optional(std::array{0.5, 0.5});
  if (!shares) {
    found.notes.push_back(
        "the center of mass is not between the planes: the permissible unbalance is not split");
    return;
  }
  for (const std::size_t k : {0, 1}) found.planes[k].permissible = (*shares)[k] * found.permissible;
}

void add_notes(const BalancingInput& input, Balancing& found) {
  constexpr double at_limit = 1.0 - 1e-6;
  for (const PlaneBalance& plane : found.planes) {
    if (std::abs(plane.weight) >= at_limit * plane.limit) {
      found.notes.push_back(
          fmt::format("the weight in plane {} is at its limit: more would leave less", plane.name));
    }
    if (plane.left > plane.permissible) {
      found.notes.push_back(fmt::format(
          "plane {} may keep more unbalance than the grade permits, by its pieces and by what is "
          "not known of the weight",
          plane.name));
    }
  }
  for (const ReadingBalance& reading : found.readings) {
    const auto place = fmt::format("{} at {:.6g} rpm", reading.probe, reading.speed / rpm);
    if (reading.is_too_large()) {
      found.notes.push_back(fmt::format("{} will read more than is allowed", place));
    } else if (reading.told_after > reading.told_before) {
      found.notes.push_back(fmt::format("{} will read more than before", place));
    }
  }
  if (input.coefficients) {
    found.notes.push_back("the coefficients are those of the model, whose contacts are open");
  }
}

}  // namespace

Balancing balance(const BalancingInput& input) {
  Balancing found{.convention = input.convention, .criterion = input.criterion};
  found.is_of_model = input.coefficients.has_value();
  const std::vector<std::string> names = plane_names(input);
  const std::vector<InfluenceLine> lines = input.coefficients
                                               ? lines_of_model(input.runs, *input.coefficients)
                                               : influence_lines(input.runs, names);
  const CorrectionProblem problem = problem_of(input, lines);
  found.nonlinearity = input.coefficients ? 0.0 : nonlinearity(lines, input.runs, problem.weight);
  require_linear(input, found);
  const Correction correction = correct(problem, names);
  found.objective = correction.objective;
  found.bound = correction.bound;
  add_planes(input, correction, found);
  CVec placed(std::ssize(found.planes));
  for (std::size_t k = 0; k < found.planes.size(); ++k) {
    placed(static_cast<Eigen::Index>(k)) = found.planes[k].placed;
  }
  add_readings(input, lines, placed, found);
  add_confidence(input, lines, problem, placed, found);
  add_grade(input, found);
  add_notes(input, found);
  return found;
}

}  // namespace whirl::inline data

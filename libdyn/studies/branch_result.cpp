#include "libdyn/studies/branch_result.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline dyn {

namespace {

/// A coordinate of the stations once a revolution, NaN beyond the period.
/// @param coordinate  0: x, 1: y
Mat sections_of(const OrbitMeasure& measure, Eigen::Index stations, Eigen::Index coordinate,
                Eigen::Index longest) {
  Mat all = Mat::Constant(stations, longest, nan);
  for (Eigen::Index s = 0; s < stations && measure.sections.cols() > 0; ++s) {
    all.row(s).head(measure.sections.cols()) = measure.sections.row(2 * s + coordinate);
  }
  return all;
}

BranchOrbit orbit_of(const BranchLayout& layout, const TracedBranch& traced, std::size_t i,
                     int number) {
  const BranchPoint& point = traced.branch.points[i];
  BranchOrbit orbit{.value = point.value,
                    .branch = number,
                    .revolutions = layout.period(traced.branch.period, point),
                    .work = traced.measures[i].work,
                    .residual = point.residual,
                    .state = traced.starts[i],
                    .multipliers = CVec::Constant(layout.states, Complex(nan, nan)),
                    .radii = traced.measures[i].radii,
                    .probe_peak_to_peak = traced.measures[i].probe_peak_to_peak};
  orbit.probe_peak_to_peak.resize(layout.probes.size(), nan);
  if (point.multipliers.size() > 0) orbit.stability = point.is_stable() ? 1 : 0;
  const Eigen::Index known = std::min(layout.states, point.multipliers.size());
  orbit.multipliers.head(known) = point.multipliers.head(known);
  for (const ContactMeasure& c : point.contacts) {
    orbit.duty.push_back(c.duty);
    orbit.impacts.push_back(c.impacts / orbit.revolutions);
    orbit.max_normal.push_back(c.max_normal);
    orbit.max_tangential.push_back(c.max_tangential);
  }
  return orbit;
}

/// Revolutions of the longest period; 0: sections are not told.
Eigen::Index longest_period(const BranchTree& tree) {
  Eigen::Index longest = 0;
  for (const TracedBranch& b : tree.branches) {
    for (const OrbitMeasure& m : b.measures) longest = std::max(longest, m.sections.cols());
  }
  return longest;
}

}  // namespace

std::optional<int> BranchRow::parent_branch() const {
  return parent > 0 ? std::optional(parent) : std::nullopt;
}

std::optional<bool> BranchOrbit::is_stable() const {
  return stability < 0 ? std::nullopt : std::optional(stability == 1);
}

std::optional<double> BranchOrbit::amplitude() const {
  return radii.empty() ? std::nullopt : std::optional(radii.front());
}

CVec BranchOrbit::known_multipliers() const {
  const auto is_gap = [](const Complex& m) { return std::isnan(m.real()); };
  return multipliers.head(std::find_if(multipliers.begin(), multipliers.end(), is_gap) -
                          multipliers.begin());
}

std::optional<Complex> BranchBifurcation::critical() const {
  return kind == BifurcationKind::grazing ? std::nullopt : std::optional(multiplier);
}

std::optional<std::string> BranchBifurcation::grazing_contact() const {
  return kind == BifurcationKind::grazing ? std::optional(contact) : std::nullopt;
}

HardestTouches hardest_touches(const BranchResult& branches) {
  HardestTouches hardest;
  for (std::size_t k = 0; k < branches.points.size(); ++k) {
    const BranchOrbit& orbit = branches.points[k];
    for (std::size_t i = 0; i < orbit.duty.size(); ++i) {
      hardest.add(k, i, orbit.max_normal[i], orbit.max_tangential[i], orbit.duty[i]);
    }
  }
  return hardest;
}

BranchResult branch_result(const BranchTree& tree, const ParameterName& parameter,
                           const std::vector<std::string>& stations) {
  BranchResult result{.parameter = parameter,
                      .state_layout = std::string(StateLayout::parts),
                      .is_complete = tree.is_complete() ? 1 : 0,
                      .stations = stations,
                      .contacts = tree.layout.contacts,
                      .probes = tree.layout.probes};
  if (tree.layout.harmonics > 0) {
    result.method = OrbitMethod::harmonic_balance;
    result.harmonics = tree.layout.harmonics;
  }
  const Eigen::Index longest = stations.empty() ? 0 : longest_period(tree);
  int number = 0;
  for (const TracedBranch& b : tree.branches) {
    ++number;
    result.branches.push_back({EndTexts(b.branch), number, b.branch.period, b.parent});
    for (std::size_t i = 0; i < b.branch.points.size(); ++i) {
      BranchOrbit orbit = orbit_of(tree.layout, b, i, number);
      if (longest > 0) {
        orbit.sections_x = sections_of(b.measures[i], std::ssize(stations), 0, longest);
        orbit.sections_y = sections_of(b.measures[i], std::ssize(stations), 1, longest);
      }
      result.points.push_back(std::move(orbit));
    }
    for (const Bifurcation& x : b.branch.bifurcations) {
      result.bifurcations.push_back({x.at.value, x.kind, number, static_cast<int>(x.after),
                                     x.contact, x.change, x.multiplier});
    }
  }
  return result;
}

}  // namespace whirl::inline dyn

#include "libio/texts/branches_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "libio/text/parameter_axis.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// A bifurcation, and of a grazing its contact: "grazing of ring".
std::string bifurcation_text(BifurcationKind kind, const std::string& contact) {
  const bool is_grazing = kind == BifurcationKind::grazing;
  return std::string(name_of(kind)) + (is_grazing ? " of " + contact : "");
}

std::string multiplier_text(const BranchBifurcation& x) {
  const auto m = x.critical();
  return m ? fmt::format("{:+.6f} {:+.6f} i", m->real(), m->imag())
           : fmt::format("{:+g} impacts", x.change);
}

/// The bifurcations of a branch; empty if it has none.
std::string bifurcations_table(const BranchResult& result, int branch) {
  std::vector<BranchBifurcation> on_it;
  std::ranges::copy_if(result.bifurcations, std::back_inserter(on_it),
                       [&](const BranchBifurcation& x) { return x.branch == branch; });
  if (on_it.empty()) return "";
  using B = BranchBifurcation;
  return "\n" + table_of(on_it, {{"bifurcation",
                                  [](const B& x) { return bifurcation_text(x.kind, x.contact); }},
                                 {label_of(result.parameter),
                                  [](const B& x) { return fmt::format("{:.9g}", x.value); }},
                                 shown("bifurcation_after").as("after point"),
                                 {"multiplier", multiplier_text}});
}

/// The range of a number over orbits.
std::string periods_text(std::span<const BranchOrbit> orbits) {
  const auto [least, most] = std::ranges::minmax(orbits, {}, &BranchOrbit::revolutions);
  return least.revolutions == most.revolutions
             ? fmt::format("{:.6g}", least.revolutions)
             : fmt::format("{:.6g} to {:.6g}", least.revolutions, most.revolutions);
}

std::string branch_text(const BranchResult& result, const BranchRow& branch) {
  const auto first =
      std::ranges::lower_bound(result.points, branch.number, {}, &BranchOrbit::branch);
  const auto last =
      std::ranges::upper_bound(result.points, branch.number, {}, &BranchOrbit::branch);
  const std::span<const BranchOrbit> orbits(first, last);
  if (orbits.empty()) return "";
  return fmt::format(
             "\n  branch {}: period {}, {} points, {} of them stable; from {:.8g} to {:.8g}{}\n  "
             "it ends: {}\n",
             branch.number, periods_text(orbits), orbits.size(),
             std::ranges::count(orbits, 1, &BranchOrbit::stability), orbits.front().value,
             orbits.back().value,
             branch.parent > 0 ? fmt::format("; begins on branch {}", branch.parent) : "",
             branch.end.empty() ? "not yet" : branch.end) +
         bifurcations_table(result, branch.number);
}

/// Where along branches a probe reads most, peak to peak.
struct LargestOnBranch {
  ProbeLabel probe{};
  const BranchOrbit* orbit = nullptr;  ///< null: nothing is known of it
  double peak_to_peak = 0.0;           ///< [m]
};

std::string probes_text(const BranchResult& result) {
  std::vector<LargestOnBranch> all;
  for (std::size_t i = 0; i < result.probes.size(); ++i) {
    LargestOnBranch most{result.probes[i]};
    for (const BranchOrbit& orbit : result.points) {
      if (i >= orbit.probe_peak_to_peak.size()) continue;
      const double size = orbit.probe_peak_to_peak[i];
      if (!std::isfinite(size) || (most.orbit && size <= most.peak_to_peak)) continue;
      most.orbit = &orbit;
      most.peak_to_peak = size;
    }
    all.push_back(std::move(most));
  }
  if (all.empty()) return "";
  using L = LargestOnBranch;
  return "\n  Along the probes, peak to peak\n" +
         table_of(
             all,
             {{"probe", [](const L& l) { return l.probe.name; }},
              {"angle [deg]", [](const L& l) { return angle_text(l.probe); }},
              {"largest",
               [](const L& l) { return l.orbit ? reading_text(l.peak_to_peak, l.probe) : "-"; }},
              {"at " + label_of(result.parameter),
               [](const L& l) { return l.orbit ? fmt::format("{:.9g}", l.orbit->value) : "-"; }},
              {"on branch",
               [](const L& l) { return l.orbit ? std::to_string(l.orbit->branch) : "-"; }}});
}

/// "0.1 to 0.15" of the ends of a curve.
std::string curve_range(const Mat& points, Eigen::Index parameter) {
  return fmt::format("{:.6g} to {:.6g}", points(0, parameter),
                     points(points.rows() - 1, parameter));
}

}  // namespace

std::string text_of(const BranchResult& result) {
  std::string text;
  if (result.harmonics) {
    text = fmt::format("  by harmonic balance with {} harmonics\n", *result.harmonics);
  }
  for (const BranchRow& branch : result.branches) text += branch_text(result, branch);
  return text + probes_text(result);
}

std::string text_of(const CurveResult& result) {
  if (result.curves.empty()) return "\n  no bifurcation to follow in the plane\n";
  using C = CurveRow;
  return "\n  bifurcation curves in the plane of both parameters\n\n" +
         table_of(result.curves,
                  {{"bifurcation", [](const C& c) { return bifurcation_text(c.kind, c.contact); }},
                   shown("branch").as("of branch"),
                   {"points", [](const C& c) { return std::to_string(c.points.rows()); }},
                   {label_of(result.first), [](const C& c) { return curve_range(c.points, 0); }},
                   {"at " + label_of(result.second),
                    [](const C& c) { return curve_range(c.points, 1); }},
                   shown("end").as("it ends")});
}

}  // namespace whirl::inline io

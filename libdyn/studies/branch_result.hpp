#pragma once
/// Branches of periodic orbits as a result (libbase/structs/column.hpp); group /branch.

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/parameter_name.hpp"
#include "libdyn/studies/branch_tree.hpp"
#include "libdyn/studies/end_texts.hpp"
#include "libdyn/system/hardest_touch.hpp"

namespace whirl::inline dyn {

/// A branch.
struct BranchRow : EndTexts {
  int number = 1;  ///< from 1
  int period = 1;  ///< [revolutions]
  int parent = 0;  ///< number of the branch on which this one begins; 0: none

  std::optional<int> parent_branch() const;

  static constexpr auto columns() {
    using B = BranchRow;
    constexpr double most_revolutions = 1e9;
    return joined(
        ColumnList{column("number", &B::number, "", "branch")
                       .axis()
                       .within(valid::numbers_of("branches"))
                       .only(Written::in_file),
                   column("period", &B::period, "", "period [revolutions]")
                       .within(valid::from_to(0.0, most_revolutions))
                       .as("period_revs"),
                   column("parent", &B::parent, "", "branch that it begins on; 0: none")
                       .within(valid::from_to(0.0, valid::largest))
                       .only(Written::in_file),
                   column("parent", &B::parent_branch, "", "null: none").only(Written::in_json)},
        EndTexts::columns());
  }
};

/// An orbit of a branch.
struct BranchOrbit {
  double value = 0.0;              ///< of the parameter [SI]
  int branch = 1;                  ///< its number
  int stability = -1;              ///< 1 stable, 0 unstable, -1 not known
  double revolutions = 1.0;        ///< of its period
  double work = 0.0;               ///< see OrbitMeasure [J]
  double residual = 0.0;           ///< [length scales]
  Vec state{};                     ///< reduced, at phase 0, in the basis of the first value
  CVec multipliers{};              ///< as many as states; NaN behind the last one
  std::vector<double> radii{};     ///< per station: largest distance from the axis [m]
  Mat sections_x{}, sections_y{};  ///< stations x revolutions, NaN beyond the period [m]
  /// Per probe, see OrbitMeasure; NaN in files of earlier versions [m].
  std::vector<double> probe_peak_to_peak{};
  std::vector<double> duty{}, impacts{}, max_normal{}, max_tangential{};  ///< per contact

  std::optional<bool> is_stable() const;
  std::optional<double> amplitude() const;  ///< of the first station [m]
  CVec known_multipliers() const;

  static constexpr auto columns() {
    using B = BranchOrbit;
    using enum Written;
    return ColumnList{
        column("value", &B::value, unit_of_parameter, "the parameter's")
            .axis()
            .within(valid::finite),
        column("branch", &B::branch, "", "branch of a point").within(valid::numbers_of("branches")),
        column("revolutions", &B::revolutions, "", "period [revolutions]")
            .within(valid::nonnegative)
            .as("period_revs"),
        column("amplitude", &B::amplitude, "m", "largest distance of the first station")
            .only(in_json),
        column("work", &B::work, "J", "work of the unbalance per revolution"),
        column("stable", &B::stability, "", "1 stable, 0 unstable, -1 not known")
            .within(valid::from_to(-1.0, 1.0))
            .only(in_file),
        column("stable", &B::is_stable, "", "null where it is not known").only(in_json),
        column("residual", &B::residual, "", "residual of the orbit [length scales]").only(in_file),
        column("state", &B::state, "", "reduced state at phase 0, in the basis of the first value")
            .along("states+")
            .only(in_file),
        column("multiplier", &B::multipliers, "",
               "Floquet multipliers of the period, the largest first")
            .along("states+")
            .only(in_file),
        column("max_radius", &B::radii, "m", "largest distance from the axis")
            .along("stations")
            .only(in_file)
            .maybe(),
        column("poincare_x", &B::sections_x, "m", "x at phase 0")
            .along("stations sections")
            .only(in_file)
            .maybe(),
        column("poincare_y", &B::sections_y, "m", "y at phase 0")
            .along("stations sections")
            .only(in_file)
            .maybe(),
        column("probe_peak_to_peak", &B::probe_peak_to_peak, "m",
               "largest less smallest reading of a probe")
            .along("probes")
            .only(in_file)
            .maybe(),
        column("probe_peak_to_peak", &B::probe_peak_to_peak, "m", "likewise").only(in_json).maybe(),
        column("duty", &B::duty, "", "share of time in touch").along("contacts").maybe(),
        column("impacts_per_rev", &B::impacts, "", "impacts per revolution")
            .along("contacts")
            .maybe(),
        column("max_normal", &B::max_normal, "N", "largest normal force").along("contacts").maybe(),
        column("max_tangential", &B::max_tangential, "N", "largest friction force")
            .along("contacts")
            .only(in_file)
            .maybe(),
        column("floquet", &B::known_multipliers, "", "the multipliers").only(in_json)};
  }
};

/// A bifurcation of a branch.
struct BranchBifurcation {
  double value = 0.0;  ///< of the parameter [SI]
  BifurcationKind kind{};
  int branch = 1;           ///< its number
  int after = 0;            ///< number of the point before, from 0
  std::string contact{};    ///< of a grazing
  double change = 0.0;      ///< of a grazing: of its contact's impacts a period
  Complex multiplier{1.0};  ///< the critical one; of a grazing NaN

  std::optional<Complex> critical() const;
  std::optional<std::string> grazing_contact() const;

  static constexpr auto columns() {
    using B = BranchBifurcation;
    using enum Written;
    return ColumnList{
        column("bifurcation", &B::value, unit_of_parameter, "value of the parameter")
            .axis()
            .within(valid::finite)
            .as("value"),
        column("bifurcation_kind", &B::kind, "", "kind").as("kind"),
        column("bifurcation_branch", &B::branch, "", "branch")
            .within(valid::numbers_of("branches"))
            .as("branch"),
        column("bifurcation_after", &B::after, "", "number of the point before")
            .from_one()
            .within(valid::numbers_of("points"))
            .as("after_point"),
        column("bifurcation_contact", &B::contact, "", "contact that grazes").only(in_file),
        column("contact", &B::grazing_contact, "", "null: no grazing").only(in_json),
        column("bifurcation_change", &B::change, "", "change of its impacts a period")
            .only(in_file),
        column("bifurcation_multiplier", &B::multiplier, "", "critical multiplier").only(in_file),
        column("multiplier", &B::critical, "", "the critical one; null: a grazing").only(in_json)};
  }
};

/// A tree of branches.
struct BranchResult {
  ParameterName parameter{};
  OrbitMethod method{};
  std::optional<int> harmonics{};  ///< of harmonic balance
  std::string state_layout{};      ///< see StateLayout::parts; empty in files of earlier versions
  std::string fixed{};             ///< PATH=VALUE lines of a second parameter
  int is_complete = 0;             ///< 1: nothing is left to be walked
  std::vector<BranchRow> branches{};
  std::vector<std::string> stations{};  ///< whose amplitudes are told
  std::vector<std::string> contacts{};
  ProbeLabels probes{};               ///< of the model
  std::vector<BranchOrbit> points{};  ///< of all branches, one after the other
  std::vector<BranchBifurcation> bifurcations{};
  std::vector<double> walk{};  ///< what the study goes on from, packed

  static constexpr std::string_view group = "/branch";
  static auto& parameter_of(auto& result, std::string_view) { return result.parameter; }
  static constexpr auto columns() {
    using B = BranchResult;
    using enum Written;
    return joined(
        ColumnList{
            column(
                "parameter", [](const B& b) { return b.parameter.path; }, "",
                "path of the parameter")
                .maybe(),
            column(
                "unit", [](const B& b) { return b.parameter.unit; }, "", "SI unit of the parameter")
                .only(in_json),
            column("method", &B::method, "", "how the orbits are found").only(in_json),
            column("harmonics", &B::harmonics, "", "of harmonic balance").maybe(),
            column("fixed", &B::fixed, "", "value of a second parameter").only(in_file).maybe(),
            column("state_layout", &B::state_layout, "", "parts of a state, in their order")
                .only(in_file)
                .maybe(),
            column("complete", &B::is_complete, "", "0: the study was stopped")
                .only(in_file)
                .maybe(),
            rows(&B::branches, "branches"),
            column("station", &B::stations, "", "station").axis("stations+").only(in_file).maybe(),
            column("contact", &B::contacts, "", "contact").axis("contacts+").only(in_file).maybe(),
            rows([](const B& b) { return b.probes.list(); }, "probes").only(in_json).maybe()},
        probe_label_columns(),
        ColumnList{rows(&B::points, "points"), rows(&B::bifurcations, "bifurcations").only(in_json),
                   rows(&B::bifurcations, "bifurcations").only(in_file).maybe(),
                   column("walk", &B::walk, "", "what the walk goes on from")
                       .along("packed")
                       .only(in_file)});
  }
};

/// The hardest touches of all orbits, with the numbers of these orbits from 0.
HardestTouches hardest_touches(const BranchResult& branches);

/// @param stations  names of the stations that the tree measures
BranchResult branch_result(const BranchTree& tree, const ParameterName& parameter,
                           const std::vector<std::string>& stations);

}  // namespace whirl::inline dyn

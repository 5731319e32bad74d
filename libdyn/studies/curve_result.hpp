#pragma once
/// Curves of bifurcations as a result (libbase/structs/column.hpp); group /border.

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/parameter_name.hpp"
#include "libdyn/studies/bifurcation_curves.hpp"
#include "libdyn/studies/end_texts.hpp"

namespace whirl::inline dyn {

/// A curve.
struct CurveRow : EndTexts {
  int number = 1;  ///< from 1
  BifurcationKind kind{};
  std::string contact;  ///< of a grazing
  int period = 1;       ///< of the orbits [revolutions]
  int branch = 1;       ///< number of the branch that the curve goes through
  Mat points{};         ///< values of both parameters, a row each [SI]

  std::optional<std::string> grazing_contact() const {
    return contact.empty() ? std::nullopt : std::optional(contact);
  }

  static constexpr auto columns() {
    using C = CurveRow;
    using enum Written;
    return joined(
        ColumnList{column("number", &C::number, "", "curve")
                       .axis()
                       .within(valid::numbers_of("borders"))
                       .only(in_file),
                   column("kind", &C::kind, "", "kind of the bifurcation"),
                   column("period", &C::period, "", "period of the orbits [revolutions]")
                       .as("period_revs"),
                   column("branch", &C::branch, "", "branch that it goes through").only(in_json),
                   column("contact", &C::contact, "", "contact that grazes").only(in_file),
                   column("contact", &C::grazing_contact, "", "null: no grazing").only(in_json),
                   column("points", &C::points, "", "values of both parameters").only(in_json)},
        EndTexts::columns());
  }
};

/// A point of a curve.
struct CurvePlace {
  double first = 0.0, second = 0.0;  ///< values of both parameters [SI]
  int curve = 1;                     ///< its number
  int is_stable = 1;                 ///< 1: no other multiplier is outside of the unit circle

  static constexpr auto columns() {
    using C = CurvePlace;
    return ColumnList{
        column("first", &C::first, unit_of_parameter, "of the first parameter")
            .axis()
            .within(valid::finite),
        column("second", &C::second, unit_of_parameter, "of the second parameter")
            .within(valid::finite),
        column("curve", &C::curve, "", "curve of a point").within(valid::numbers_of("borders")),
        column("stable", &C::is_stable, "", "1: no other multiplier is outside of the unit circle")
            .within(valid::from_to(0.0, 1.0))};
  }
};

/// Curves in the plane of two parameters.
struct CurveResult {
  ParameterName first{}, second{};  ///< the parameters: that of the branches, and the second one
  int is_complete = 0;              ///< 1: nothing is left to be walked
  std::vector<CurveRow> curves{};
  std::vector<CurvePlace> places{};  ///< of all curves, one after the other
  std::vector<double> walk{};        ///< what the study goes on from, packed

  static constexpr std::string_view group = "/border";
  static auto& parameter_of(auto& result, std::string_view dataset) {
    return dataset == "first" ? result.first : result.second;
  }
  static constexpr auto columns() {
    using C = CurveResult;
    using enum Written;
    return ColumnList{
        rows(&C::curves, "borders"), rows(&C::places, "places+").only(in_file),
        column("walk", &C::walk, "", "what the walk goes on from")
            .along("packed_borders")
            .only(in_file),
        column("complete", &C::is_complete, "", "0: the study was stopped").only(in_file).maybe()};
  }
};

/// @param along  range of the first parameter
CurveResult curve_result(const BifurcationCurves& curves, const ParameterName& first,
                         const ParameterRange& along, const ParameterName& second);

}  // namespace whirl::inline dyn

#pragma once

#include <span>
#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libfe/parts/bearings/coefficient_table.hpp"

namespace whirl::inline fe {

/// A bearing given by a table over the speed, the frequency at which its journal whirls, or both.
struct TableBearing {
  static constexpr std::string_view name = "table";
  static constexpr std::string_view told_by = "table";

  CoefficientTable table;
  Interpolation interpolation = Interpolation::linear;

  bool operator==(const TableBearing&) const = default;

  static constexpr auto fields() {
    return std::tuple{
        required("table", &TableBearing::table, "", Range::any,
                 "file with coefficients against speed, whirl frequency or both, beside the "
                 "model"),
        optional("interpolation", &TableBearing::interpolation, "", Range::any,
                 "between the rows of its table")};
  }

  BearingCoefficients at(double Omega, double omega) const {
    return table.at(Omega, omega, interpolation);
  }
  bool depends_on_speed() const { return !table.speed.empty(); }
  bool depends_on_whirl() const { return !table.whirl.empty(); }
  std::span<const double> speeds() const { return table.speed; }
  std::span<const double> whirls() const { return table.whirl; }
};

}  // namespace whirl::inline fe

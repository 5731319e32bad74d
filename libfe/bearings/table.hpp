#pragma once

#include <span>
#include <string_view>
#include <tuple>

#include "libbase/field.hpp"
#include "libfe/bearings/coefficient_table.hpp"

namespace whirl::inline fe {

/// A bearing given by a table over speed, whatever the frequency at which its journal whirls.
struct TableBearing {
  static constexpr std::string_view name = "table";
  static constexpr std::string_view told_by = "table";
  static constexpr bool depends_on_speed = true;
  static constexpr bool depends_on_whirl = false;

  CoefficientTable table;

  static constexpr auto fields() {
    return std::tuple{required("table", &TableBearing::table, "", Range::any,
                               "file with coefficients against speed (CSV), beside the model")};
  }

  BearingCoefficients at(double Omega, double /*omega*/) const { return table.at(Omega); }
  std::span<const double> speeds() const { return table.speed; }
};

}  // namespace whirl::inline fe

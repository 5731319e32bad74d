#pragma once
/// Laws of supports beside the frequency responses that they were fitted to.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/column.hpp"

namespace whirl::inline dyn {

/// How the law of a support fits its response, see LawFit.
struct SupportFit {
  std::string name;
  int samples = 0, poles = 0;
  double error = 0.0, largest = 0.0, largest_at = 0.0;
  int mirrored = 0;
  double least_damping = 0.0, least_damping_at = 0.0;

  static constexpr auto columns() {
    using S = SupportFit;
    return ColumnList{
        column("name", &S::name, "", "support"),
        column("samples", &S::samples, "", "frequencies of its response"),
        column("poles", &S::poles, "", "poles of its law"),
        column("error", &S::error, "", "root mean square of what is left, relative"),
        column("largest", &S::largest, "", "most that is left at a frequency, relative"),
        column("largest_at", &S::largest_at, "rad/s", "its frequency"),
        column("mirrored", &S::mirrored, "", "poles that were made stable"),
        column("least_damping", &S::least_damping, "",
               "least part of the stiffness that damps; below 0: it gives energy"),
        column("least_damping_at", &S::least_damping_at, "rad/s", "its frequency")};
  }
};

/// An entry of a dynamic stiffness at a frequency.
struct StiffnessPoint {
  int support = 0;                     ///< number of the fit, from 0
  int row = 0, column = 0;             ///< of the entry, from 0
  double frequency = 0.0;              ///< [rad/s]
  double real = 0.0, imaginary = 0.0;  ///< [N/m]

  Complex value() const { return {real, imaginary}; }

  static constexpr auto columns() {
    using P = StiffnessPoint;
    return ColumnList{
        whirl::column("support", &P::support, "", "number of the support")
            .within(valid::numbers_of("fits"))
            .from_one(),
        whirl::column("row", &P::row, "", "of the entry").from_one(),
        whirl::column("column", &P::column, "", "of the entry").from_one(),
        whirl::column("frequency", &P::frequency, "rad/s", "frequency").within(valid::positive),
        whirl::column("real", &P::real, "N/m", "dynamic stiffness, real part"),
        whirl::column("imaginary", &P::imaginary, "N/m", "dynamic stiffness, imaginary part")};
  }
};

/// Responses and the laws that were fitted to them; group /support_fits.
struct SupportFits {
  std::vector<SupportFit> fits;
  std::vector<StiffnessPoint> samples;  ///< of the responses: entry by entry, frequencies ascend
  std::vector<StiffnessPoint> curve;    ///< of the laws, there and between

  static constexpr std::string_view group = "/support_fits";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{rows(&SupportFits::fits, "fits+"),
                      rows(&SupportFits::samples, "samples").prefixed("sample_").only(in_file),
                      rows(&SupportFits::curve, "curve").prefixed("curve_").only(in_file)};
  }
};

}  // namespace whirl::inline dyn

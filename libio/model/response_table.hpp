#pragma once
/// Frequency responses of supports, as laws are fitted to.

#include <optional>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/transfer_function.hpp"

namespace whirl::inline io {

/// Dynamic stiffness over frequency.
struct MeasuredStiffness {
  std::vector<double> omega;  ///< ascending [rad/s]
  std::vector<CMat> K;        ///< ports x ports [N/m]
};

/// Reads a frequency response as a dynamic stiffness.
///
/// Columns: `frequency` with its unit and `real`, `imaginary`, or `magnitude`, `phase`; of several
/// coordinates `real11`, `imaginary11`, `real12`, ...: of the matrix that is told, by row and
/// column. See parse_delimited for the form of the lines. Frequencies ascend and are above zero.
///
/// @param form      what is told: a receptance or mobility is inverted
/// @param ports     coordinates of the support
/// @param file      for messages
/// @param problems  receives what is wrong, with its place
/// @param doubts    receives columns that are not read; null: not wanted
MeasuredStiffness parse_response_table(const std::string& text, const std::string& file,
                                       TransferForm form, int ports, std::vector<Problem>& problems,
                                       std::vector<Problem>* doubts = nullptr);

/// How many columns of such a table a line names.
std::size_t response_columns_named_in(const std::string& line);

inline constexpr int most_fit_order = 40;  ///< poles of a law that is fitted

/// How a law is fitted.
struct FitOptions {
  int order = 0;            ///< number of poles; 0: as many as the tolerance needs
  double tolerance = 1e-3;  ///< root mean square of what is left, relative
};

/// The law with the fewest poles, and then with a damper and a mass only where they are needed,
/// that a frequency response is fitted by.
/// @throws NumericalError  where there are too few samples
StateSpace fitted_law(const MeasuredStiffness& response, const FitOptions& how, LawFit& fit);

/// A law beside the response that it was fitted to.
struct FittedLaw {
  std::string support;  ///< its name
  MeasuredStiffness response;
  StateSpace law;  ///< without springs, dampers and masses beside it
  LawFit fit;
};

}  // namespace whirl::inline io

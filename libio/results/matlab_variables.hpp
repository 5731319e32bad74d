#pragma once
/// Variables of MATLAB files.

#include <matio.h>

#include <memory>
#include <string>
#include <vector>

namespace whirl::inline io {

using MatlabVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;
using MatlabFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;

/// Texts as rows of equally many characters.
MatlabVariable matlab_texts(const char* name, const std::vector<std::string>& texts);

/// A matrix of numbers, column by column.
MatlabVariable matlab_numbers(const char* name, std::vector<double> values, std::size_t rows,
                              std::size_t columns);

}  // namespace whirl::inline io

#pragma once
/// Variables of MATLAB files.

#include <matio.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

using MatlabVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;
using MatlabFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;

/// Writes a file of level 5.
/// @param head  text that the file begins with, for people
/// @throws FileError  as FileReplacement, and if the file is not whole: matio does not tell of a
///                    full disk
void write_matlab_file(const std::filesystem::path& place, const char* head,
                       const std::vector<MatlabVariable>& variables, Replaces replaces);

/// Texts as rows of equally many characters.
MatlabVariable matlab_texts(const char* name, const std::vector<std::string>& texts);

/// A matrix of numbers, column by column.
MatlabVariable matlab_numbers(const char* name, std::vector<double> values, std::size_t rows,
                              std::size_t columns);

/// Numbers of an array of any dimensions, the first index running fastest; none: it holds no full
/// array of numbers.
/// @param data  those of the variable, or one of both parts of complex numbers
std::vector<double> matlab_doubles(const matvar_t& v, const void* data);

}  // namespace whirl::inline io

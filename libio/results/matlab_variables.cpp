#include "libio/results/matlab_variables.hpp"

#include <algorithm>
#include <array>

namespace whirl::inline io {

MatlabVariable matlab_texts(const char* name, const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& t : texts) width = std::max(width, t.size());
  std::string columns(texts.size() * width, ' ');  // characters column by column
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (std::size_t k = 0; k < texts[i].size(); ++k) columns[k * texts.size() + i] = texts[i][k];
  }
  std::array<std::size_t, 2> size{texts.size(), width};
  return {Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UINT8, 2, size.data(), columns.data(), 0),
          &Mat_VarFree};
}

MatlabVariable matlab_numbers(const char* name, std::vector<double> values, std::size_t rows,
                              std::size_t columns) {
  std::array<std::size_t, 2> size{rows, columns};
  return {Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), values.data(), 0),
          &Mat_VarFree};
}

}  // namespace whirl::inline io

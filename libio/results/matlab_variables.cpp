#include "libio/results/matlab_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

namespace whirl::inline io {

namespace {

using Tag = std::array<std::uint32_t, 2>;  ///< type and size of an element; of a small one with it

/// Goes over elements that follow each other in a file.
/// @param f  called with the tag and the place of each
/// @return   whether the last one ends where they all are said to end
template <class F>
bool are_whole(std::ifstream& in, std::streamoff at, std::streamoff end, const F& f) {
  constexpr std::streamoff tag_bytes = 8;
  while (at < end) {
    Tag tag{};
    if (!in.seekg(at).read(reinterpret_cast<char*>(tag.data()), tag_bytes) || !f(tag, at)) {
      return false;
    }
    const bool is_small = tag[0] >> 16u != 0;
    at += tag_bytes + (is_small ? 0 : (tag[1] + tag_bytes - 1) / tag_bytes * tag_bytes);
  }
  return at == end;
}

/// Whether a file has so many variables, each with all of its bytes, and nothing behind them.
bool is_whole(const std::filesystem::path& file, std::size_t variables) {
  constexpr std::streamoff head = 128, tag_bytes = 8;
  std::ifstream in(file, std::ios::binary);
  const std::streamoff size = in.seekg(0, std::ios::end).tellg();
  std::size_t count = 0;
  return are_whole(in, head, size,
                   [&](const Tag& variable, std::streamoff at) {
                     ++count;
                     return are_whole(in, at + tag_bytes, at + tag_bytes + variable[1],
                                      [](const Tag&, std::streamoff) { return true; });
                   }) &&
         count == variables;
}

template <class Number>
std::vector<double> as_doubles(const void* data, std::size_t count) {
  const auto* values = static_cast<const Number*>(data);
  return {values, values + count};
}

}  // namespace

std::vector<double> matlab_doubles(const matvar_t& v, const void* data) {
  if (!data) return {};
  std::size_t count = 1;
  for (int i = 0; i < v.rank; ++i) count *= v.dims[i];
  switch (v.class_type) {
    case MAT_C_DOUBLE:
      return as_doubles<double>(data, count);
    case MAT_C_SINGLE:
      return as_doubles<float>(data, count);
    case MAT_C_INT8:
      return as_doubles<std::int8_t>(data, count);
    case MAT_C_UINT8:
      return as_doubles<std::uint8_t>(data, count);
    case MAT_C_INT16:
      return as_doubles<std::int16_t>(data, count);
    case MAT_C_UINT16:
      return as_doubles<std::uint16_t>(data, count);
    case MAT_C_INT32:
      return as_doubles<std::int32_t>(data, count);
    case MAT_C_UINT32:
      return as_doubles<std::uint32_t>(data, count);
    case MAT_C_INT64:
      return as_doubles<std::int64_t>(data, count);
    case MAT_C_UINT64:
      return as_doubles<std::uint64_t>(data, count);
    default:
      return {};
  }
}

void write_matlab_file(const std::filesystem::path& place, const char* head,
                       const std::vector<MatlabVariable>& variables, Replaces replaces) {
  FileReplacement file(place, replaces_own(place, head, replaces));
  MatlabFile mat(Mat_CreateVer(file.temporary().c_str(), head, MAT_FT_MAT5), &Mat_Close);
  for (const MatlabVariable& v : variables) {
    if (!mat || !v || Mat_VarWrite(mat.get(), v.get(), MAT_COMPRESSION_NONE) != 0) {
      throw FileError(place.string() + " cannot be written");
    }
  }
  mat.reset();
  if (!is_whole(file.temporary(), variables.size())) {
    throw FileError(
        fmt::format("cannot write {}: the disk is full, or the file too large", place.string()));
  }
  file.commit();
}

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

#include "libio/measured/law_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/measured/law_parts.hpp"
#include "libio/model/state_space_table.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/encoding.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

[[noreturn]] void fail_law(const std::string& file, const std::string& name, std::string why) {
  throw ModelError({file}, name, std::move(why));
}

const LawArray* array_of(const std::vector<LawArray>& arrays, std::string_view name) {
  const auto at = std::ranges::find(arrays, name, &LawArray::name);
  return at == arrays.end() ? nullptr : &*at;
}

void require_finite(const std::string& file, const std::string& name, const CMat& values) {
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      const Complex v = values(i, j);
      if (std::isfinite(v.real()) && std::isfinite(v.imag())) continue;
      fail_law(file, name,
               fmt::format("number {} of row {} is not finite ({:g}, {:g})", j + 1, i + 1, v.real(),
                           v.imag()));
    }
  }
}

/// The real part of an array that has no other one.
Mat real_of(const std::string& file, const LawArray& array) {
  require_finite(file, array.name, array.values);
  if (array.is_complex && !array.values.imag().isZero(0.0)) {
    fail_law(file, array.name, "has complex numbers, expected real ones");
  }
  return array.values.real();
}

std::string state_space_of(const std::string& file, const std::vector<LawArray>& arrays) {
  StateSpaceTable table;
  const auto take = [&](const char* name, std::optional<Mat>& to) {
    if (const LawArray* found = array_of(arrays, name)) to = real_of(file, *found);
  };
  take("A", table.A);
  take("B", table.B);
  take("C", table.C);
  take("D", table.D);
  const bool has_none = !table.A && !table.B && !table.C && !table.D;
  if (has_none) fail_law(file, "", "has no matrices A, B, C and D");
  // a vector may lie or stand
  const Eigen::Index n = table.A ? table.A->rows() : 0;
  if (n > 1 && table.B && table.B->rows() == 1 && table.B->cols() == n) {
    table.B = Mat(table.B->transpose());
  }
  if (n > 1 && table.C && table.C->cols() == 1 && table.C->rows() == n) {
    table.C = Mat(table.C->transpose());
  }
  return state_space_text(table);
}

/// Frequencies of a response [rad/s].
Vec frequencies_of(const std::string& file, const std::vector<LawArray>& arrays) {
  const LawArray* omega = array_of(arrays, "omega");
  const LawArray* found = omega ? omega : array_of(arrays, "frequency");
  if (!found) {
    fail_law(file, "", "has no vector omega (rad/s) or frequency (Hz) of a response");
  }
  const Mat values = real_of(file, *found);
  if (values.rows() != 1 && values.cols() != 1) {
    fail_law(file, found->name,
             fmt::format("found {} x {}, expected a vector", values.rows(), values.cols()));
  }
  const std::string written = found->unit.empty() ? (omega ? "rad/s" : "Hz") : found->unit;
  const auto unit = unit_in_table(written, "rad/s");
  if (!unit) fail_law(file, found->name, unit.problem);
  return *parse_as("1 " + *unit, "rad/s") * values.reshaped();
}

std::string response_of(const std::string& file, const std::vector<LawArray>& arrays, int ports) {
  const Vec omega = frequencies_of(file, arrays);
  const LawArray* response = array_of(arrays, "response");
  if (!response) response = array_of(arrays, "H");
  if (!response)
    fail_law(file, "", "has frequencies and no array response (or H) of complex numbers");
  if (!response->is_complex) {
    fail_law(file, response->name, "has real numbers, expected complex ones");
  }
  CMat H = response->values;
  if (H.rows() == 1 && H.cols() == omega.size()) H.transposeInPlace();
  if (H.rows() != omega.size()) {
    fail_law(file, response->name,
             fmt::format("found {} x {}, expected numbers for each of {} frequencies", H.rows(),
                         H.cols(), omega.size()));
  }
  return response_text(file, omega, H, ports);
}

std::string words_of(const ModelError& error) {
  const Problem& problem = error.problems().front();
  const std::string line = problem.where.line > 0 ? fmt::format(":{}", problem.where.line) : "";
  return fmt::format("cannot read the file \"{}\"{}: {}{}{}", problem.where.file, line, problem.key,
                     problem.key.empty() ? "" : ": ", problem.message);
}

}  // namespace

void require_law_size(const std::string& file, const std::string& name,
                      const std::vector<std::size_t>& sizes) {
  std::size_t count = 1;
  for (const std::size_t size : sizes) {
    const bool fits = size <= most_law_rows && count * size <= most_law_numbers;
    if (!fits) {
      fail_law(file, name,
               fmt::format("has too many numbers, expected up to {} rows and {} numbers",
                           most_law_rows, most_law_numbers));
    }
    count *= size;
  }
}

std::string response_text(const std::string& file, const Vec& omega, const CMat& H, int ports) {
  if (H.cols() != static_cast<Eigen::Index>(ports) * ports) {
    fail_law(
        file, "response",
        fmt::format("has {} entries at each frequency, expected {}: a matrix of {} coordinate{}",
                    H.cols(), ports * ports, ports, ports == 1 ? "" : "s"));
  }
  require_finite(file, "response", H);
  std::string text = "frequency [rad/s]";
  for (int i = 1; i <= ports; ++i) {
    for (int j = 1; j <= ports; ++j) {
      const std::string entry = ports == 1 ? "" : fmt::format("{}{}", i, j);
      text += fmt::format(", real{0}, imaginary{0}", entry);
    }
  }
  text += '\n';
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const bool ascends = std::isfinite(omega(k)) && (k == 0 || omega(k) > omega(k - 1));
    if (!ascends) {
      fail_law(file, "frequency",
               fmt::format("number {} is {:g} rad/s: frequencies must ascend", k + 1, omega(k)));
    }
    if (omega(k) <= 0.0) continue;
    text += fmt::format("{}", omega(k));
    for (const Complex& v : H.row(k)) text += fmt::format(", {}, {}", v.real(), v.imag());
    text += '\n';
  }
  return text;
}

Parsed<ConvertedTable> law_table(const std::filesystem::path& file, const std::string& part,
                                 const ForeignTable& wanted) {
  const std::string ending = lower_case(file.extension().string()), name = file.string();
  const bool is_matlab = ending == ".mat", is_hdf5 = ending == ".h5" || ending == ".hdf5";
  try {
    if (!is_matlab && !is_hdf5) {
      if (wanted.kind == ForeignTable::Kind::response) {
        return universal_response(file, part, wanted);
      }
      fail_law(name, "", "a universal file has no state space");
    }
    const std::vector<LawArray> arrays =
        is_matlab ? matlab_law_arrays(file, part) : hdf5_law_arrays(file, part);
    ConvertedTable made;
    made.table.name = part.empty() ? name : fmt::format("{}#{}", name, part);
    made.table.text = wanted.kind == ForeignTable::Kind::response
                          ? response_of(name, arrays, wanted.ports)
                          : state_space_of(name, arrays);
    return made;
  } catch (const ModelError& error) {
    return Parsed<ConvertedTable>::failed(words_of(error));
  } catch (const FileError& error) {
    return Parsed<ConvertedTable>::failed(error.what());
  }
}

}  // namespace whirl::inline io

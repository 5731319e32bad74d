#include "libio/model/matrix_market.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string_view>

namespace whirl::inline io {

namespace {

constexpr std::int64_t most_rows = 1'000'000, most_dense = 4000;

/// What the first line says.
struct Header {
  bool is_array = false, is_symmetric = false;
};

std::optional<Header> header_of(std::string line) {
  for (char& c : line) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::istringstream words(line);
  std::string banner, object, form, field, symmetry;
  words >> banner >> object >> form >> field >> symmetry;
  const bool is_known = banner == "%%matrixmarket" && object == "matrix" &&
                        (form == "coordinate" || form == "array") &&
                        (field == "real" || field == "integer" || field == "double") &&
                        (symmetry == "general" || symmetry == "symmetric");
  if (!is_known) return std::nullopt;
  return Header{form == "array", symmetry == "symmetric"};
}

/// Lines of a text that are neither empty nor comments.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  /// The next line; nothing: it ends.
  std::optional<std::string_view> next() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first == std::string_view::npos || (number_ > 1 && line[first] == '%')) continue;
      return line.substr(first);
    }
    return std::nullopt;
  }
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// Takes a number from the front of a line.
template <class T>
std::optional<T> take(std::string_view& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return std::nullopt;
  line.remove_prefix(first);
  if (line.front() == '+') line.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc()) return std::nullopt;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return value;
}

}  // namespace

Sparse parse_matrix_market(const std::string& text, const std::string& file,
                           std::vector<Problem>& problems) {
  Lines lines(text);
  const auto fail = [&](std::string message) {
    problems.push_back({{file, lines.number(), 1}, "", std::move(message)});
    return Sparse(0, 0);
  };
  const auto first = lines.next();
  const auto header = first ? header_of(std::string(*first)) : std::nullopt;
  if (!header) {
    return fail(
        "expected \"%%MatrixMarket matrix coordinate real symmetric\", or array, or general");
  }
  auto sizes = lines.next().value_or("");
  const auto rows = take<std::int64_t>(sizes), columns = take<std::int64_t>(sizes);
  const auto entries =
      header->is_array ? std::optional<std::int64_t>(0) : take<std::int64_t>(sizes);
  if (!rows || !columns || !entries || *rows < 1 || *rows != *columns) {
    return fail("expected the numbers of rows and columns, which are the same, and of entries");
  }
  const std::int64_t most = header->is_array ? most_dense : most_rows;
  if (*rows > most) return fail(fmt::format("found {} rows, expected up to {}", *rows, most));
  const auto n = static_cast<int>(*rows);
  std::vector<Triplet> triplets;
  const auto add = [&](int i, int j, double value) {
    if (value == 0.0) return;
    triplets.emplace_back(i, j, value);
    if (header->is_symmetric && i != j) triplets.emplace_back(j, i, value);
  };
  if (header->is_array) {
    for (int j = 0; j < n; ++j) {
      for (int i = header->is_symmetric ? j : 0; i < n; ++i) {
        auto line = lines.next().value_or("");
        const auto value = take<double>(line);
        if (!value || !std::isfinite(*value)) return fail("expected a number for every entry");
        add(i, j, *value);
      }
    }
  } else {
    for (std::int64_t k = 0; k < *entries; ++k) {
      auto line = lines.next().value_or("");
      const auto i = take<std::int64_t>(line), j = take<std::int64_t>(line);
      const auto value = take<double>(line);
      if (!i || !j || !value || *i < 1 || *j < 1 || *i > *rows || *j > *rows ||
          !std::isfinite(*value)) {
        return fail(
            fmt::format("expected row, column and value of entry {} of {}, rows and "
                        "columns from 1 to {}",
                        k + 1, *entries, *rows));
      }
      add(static_cast<int>(*i) - 1, static_cast<int>(*j) - 1, *value);
    }
  }
  if (lines.next()) return fail("more entries than the file says that it has");
  Sparse A(n, n);
  A.setFromTriplets(triplets.begin(), triplets.end());
  return A;
}

std::string matrix_market_text(const Mat& A, const std::string& comment) {
  std::string text = fmt::format("%%MatrixMarket matrix array real general\n% {}\n{} {}\n", comment,
                                 A.rows(), A.cols());
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = 0; i < A.rows(); ++i) text += fmt::format("{}\n", A(i, j));
  }
  return text;
}

}  // namespace whirl::inline io

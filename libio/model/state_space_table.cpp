#include "libio/model/state_space_table.hpp"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include "libio/model/matrix_market.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

constexpr std::array<std::pair<const char*, std::optional<Mat> StateSpaceTable::*>, 4>
    matrix_members{{{"A", &StateSpaceTable::A},
                    {"B", &StateSpaceTable::B},
                    {"C", &StateSpaceTable::C},
                    {"D", &StateSpaceTable::D}}};

/// The rows of a matrix that are read so far.
using MatrixRows = std::vector<std::vector<double>>;

Mat matrix_of(const MatrixRows& rows) {
  Mat M(std::ssize(rows), std::ssize(rows.front()));
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    for (Eigen::Index j = 0; j < M.cols(); ++j) {
      M(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return M;
}

/// Adds a line to the rows of its matrix.
void add_matrix_line(const std::vector<Cell>& cells, std::array<MatrixRows, 4>& all,
                     const ReportProblem& report) {
  std::size_t which = 0;
  while (which < all.size() && cells.front().text != matrix_members[which].first) ++which;
  if (which == all.size()) {
    report(cells.front().place, "",
           fmt::format("found {}, expected A, B, C or D, and behind it a row of this matrix",
                       in_quotes(cells.front().text)));
    return;
  }
  std::vector<double> row;
  for (std::size_t k = 1; k < cells.size(); ++k) {
    const auto value = parse_as(cells[k].text, "");
    if (!value) {
      report(cells[k].place, matrix_members[which].first, value.problem);
      return;
    }
    row.push_back(*value);
  }
  MatrixRows& rows = all[which];
  if (row.empty() || (!rows.empty() && row.size() != rows.front().size())) {
    report(1, matrix_members[which].first,
           fmt::format("a row of {} numbers, expected {}", row.size(),
                       rows.empty() ? "one or more" : fmt::format("{}", rows.front().size())));
    return;
  }
  rows.push_back(std::move(row));
}

constexpr std::string_view states_comment = "% states";

/// The parts of [A, B; C, D].
StateSpaceTable parse_system_matrix(const std::string& text, const std::string& file,
                                    std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  const Mat S(parse_matrix_market(text, file, problems));
  if (problems.size() > before) return {};
  Eigen::Index n = -1;
  if (const std::size_t at = text.find(states_comment); at != std::string::npos) {
    std::istringstream(text.substr(at + states_comment.size(), 20)) >> n;
  }
  if (n < 0 || n > S.rows() || n > S.cols()) {
    problems.push_back({{file, 1, 1},
                        "",
                        fmt::format("a matrix [A, B; C, D] of {} x {} needs a comment that says "
                                    "how many rows and columns A has, such as \"% states 2\"",
                                    S.rows(), S.cols())});
    return {};
  }
  const Eigen::Index rows = S.rows() - n, cols = S.cols() - n;
  StateSpaceTable table;
  if (rows > 0 && cols > 0) table.D = S.bottomRightCorner(rows, cols);
  if (n == 0) return table;
  table.A = S.topLeftCorner(n, n);
  if (cols > 0) table.B = S.topRightCorner(n, cols);
  if (rows > 0) table.C = S.bottomLeftCorner(rows, n);
  return table;
}

}  // namespace

StateSpaceTable parse_state_space_table(const std::string& text, const std::string& file,
                                        std::vector<Problem>& problems) {
  if (text.starts_with("%%MatrixMarket")) return parse_system_matrix(text, file, problems);
  const std::size_t before = problems.size();
  std::array<MatrixRows, 4> all;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    add_matrix_line(
        cells_of(line, delimiter_of(line)), all,
        [&](int place, std::string key, std::string message) {
          problems.push_back({{file, number, place}, std::move(key), std::move(message)});
        });
  }
  StateSpaceTable table;
  if (problems.size() > before) {
    tell_once(problems, before);
    return table;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!all[k].empty()) table.*matrix_members[k].second = matrix_of(all[k]);
  }
  return table;
}

std::string state_space_text(const StateSpaceTable& table) {
  std::string text;
  for (const auto& [name, member] : matrix_members) {
    if (!(table.*member)) continue;
    const Mat& M = *(table.*member);
    for (Eigen::Index i = 0; i < M.rows() && M.cols() > 0; ++i) {
      text += name;
      for (Eigen::Index j = 0; j < M.cols(); ++j) text += fmt::format(", {}", M(i, j));
      text += '\n';
    }
  }
  return text;
}

}  // namespace whirl::inline io

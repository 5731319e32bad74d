#include "libio/model/read_matrices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "libfe/eigen/symmetric.hpp"
#include "libio/model/matrix_market.hpp"

namespace whirl::inline io {

namespace {

constexpr const char* matrix_keys[] = {"mass_matrix", "stiffness_matrix", "damping_matrix"};
constexpr long most_modes = 100;
constexpr int usual_modes = 20;

/// The comment of matrices that are reduced already.
std::string comment_of(const std::vector<long>& rows) {
  return fmt::format("whirl: interface of rows {}, then modes", fmt::join(rows, " "));
}

/// The three matrices; empty: not told, or wrong.
struct ReadMatrices {
  std::array<Sparse, 3> all;
  std::array<std::size_t, 3> tables{};  ///< numbers among the texts of files
  bool are_reduced = false;
};

std::optional<ReadMatrices> matrices_of(ModelReading& reading, TableReader& table, std::size_t item,
                                        const std::vector<long>& rows) {
  ReadMatrices read;
  bool is_whole = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const char* key = matrix_keys[k];
    const auto from = reading.text_of(table, key, "support", item,
                                      [](const std::string&) { return std::size_t{0}; });
    if (!from) {
      if (table.has(key)) is_whole = false;
      continue;
    }
    read.tables[k] = reading.file_tables.size() - 1;
    std::vector<Problem> wrong;
    read.all[k] = parse_matrix_market(from->text, from->name, wrong);
    reading.add_problems(wrong);
    is_whole = is_whole && wrong.empty();
    const std::size_t comment = from->text.find("% whirl: interface of rows");
    if (comment == std::string::npos) continue;
    read.are_reduced = true;
    if (from->text.compare(comment + 2, comment_of(rows).size(), comment_of(rows)) == 0) continue;
    table.problem(
        key, fmt::format("its matrices were reduced to other rows than {}", fmt::join(rows, ", ")));
    is_whole = false;
  }
  return is_whole ? std::optional(std::move(read)) : std::nullopt;
}

/// Whether the matrices go with each other and with the interface; if not, this is reported.
bool fit_together(TableReader& table, const ReadMatrices& read, const std::vector<long>& rows) {
  const auto n = read.all[1].rows();
  for (std::size_t k = 0; k < 3; ++k) {
    if (read.all[k].rows() == n || (k == 2 && read.all[k].rows() == 0)) continue;
    table.problem(matrix_keys[k], fmt::format("found {} rows, expected {} as in stiffness_matrix",
                                              read.all[k].rows(), n));
    return false;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_symmetric(read.all[k])) continue;
    table.problem(matrix_keys[k], "expected a symmetric matrix, as that of a casing is");
    return false;
  }
  std::vector<long> sorted = rows;
  std::ranges::sort(sorted);
  const bool are_right = !sorted.empty() && sorted.front() >= 1 && sorted.back() <= n &&
                         std::ranges::adjacent_find(sorted) == sorted.end();
  if (are_right || read.are_reduced) return true;
  table.problem(
      "interface",
      fmt::format("expected a row of the matrices for every coordinate, from 1 to {}, each "
                  "another one: {{ at = ..., angle = ..., row = 1 }}",
                  n));
  return false;
}

}  // namespace

std::optional<StructureMatrices<Mat>> read_matrices(ModelReading& reading, TableReader& table,
                                                    std::size_t item,
                                                    const std::vector<long>& rows) {
  const auto modes = table.integer("modes", Range::positive);
  if (modes) table.at_most("modes", *modes, most_modes);
  const auto read = matrices_of(reading, table, item, rows);
  const bool has_any =
      std::ranges::any_of(matrix_keys, [&](const char* k) { return table.has(k); });
  if (!has_any) {
    if (table.has("modes")) table.problem("modes", "belongs to matrices, which are missing");
    return std::nullopt;
  }
  for (const char* key : {"mass_matrix", "stiffness_matrix"}) {
    if (!table.has(key)) table.missing(key, "a file in MatrixMarket's form");
  }
  if (!read || read->all[0].rows() == 0 || read->all[1].rows() == 0) return std::nullopt;
  if (!fit_together(table, *read, rows)) return std::nullopt;
  try {
    StructureMatrices<Mat> reduced;
    if (read->are_reduced) {
      const auto& [M, K, C] = read->all;
      const long had = M.rows() - std::ssize(rows);
      if (modes.value_or(had) > had) {
        table.problem("modes", fmt::format("the matrices are reduced already, to {} modes", had));
        return std::nullopt;
      }
      if (modes.value_or(had) == had) {
        reduced = {Mat(M), Mat(C), Mat(K)};
      } else {
        std::vector<int> interface(rows.size());
        std::iota(interface.begin(), interface.end(), 0);
        reduced = craig_bampton({M, C, K}, interface, static_cast<int>(*modes));
      }
    } else {
      std::vector<int> interface;
      for (const long row : rows) interface.push_back(static_cast<int>(row) - 1);
      const auto& [M, K, C] = read->all;
      reduced = craig_bampton({M, C, K}, interface,
                              static_cast<int>(std::min(modes.value_or(usual_modes), most_modes)));
      const Mat* matrices[] = {&reduced.M, &reduced.K, &reduced.C};
      for (std::size_t k = 0; k < 3; ++k) {
        if (matrices[k]->rows() == 0) continue;
        reading.file_tables[read->tables[k]].text =
            matrix_market_text(*matrices[k], comment_of(rows));
      }
    }
    return reduced;
  } catch (const NumericalError& error) {
    table.problem("stiffness_matrix", error.what());
    return std::nullopt;
  }
}

}  // namespace whirl::inline io

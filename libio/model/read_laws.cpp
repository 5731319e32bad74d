#include "libio/model/read_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "libio/model/state_space_table.hpp"

namespace whirl::inline io {

namespace {

constexpr std::string_view law_keys[] = {"numerator", "denominator", "poles", "residues",   "A",
                                         "B",         "C",           "D",     "state_space"};
constexpr Eigen::Index most_states = 200;  ///< more is a model of its own

/// The keys of laws as they are read.
struct LawKeys {
  std::optional<Mat> poles, residues, A, B, C, D;
  std::vector<double> numerator, denominator;

  explicit LawKeys(TableReader& table)
      : poles(table.rows("poles")),
        residues(table.rows("residues")),
        A(table.rows("A")),
        B(table.rows("B")),
        C(table.rows("C")),
        D(table.rows("D")),
        numerator(table.list("numerator", "", Range::any)),
        denominator(table.list("denominator", "", Range::any)) {}
};

struct PolesAndResidues {
  std::vector<PoleResidue> parts;
  Eigen::Index ports = 1;
};

/// The rows of poles [re, im] and of residues [re, im, ...], of each pole in the order of rows of
/// its matrix.
std::optional<PolesAndResidues> poles_and_residues(TableReader& table, const LawKeys& keys) {
  const auto& [poles, residues] = std::tie(keys.poles, keys.residues);
  if (!poles || !residues) {
    if (table.has("poles") && !table.has("residues")) {
      table.missing("residues", "a row for each of the poles: [real part, imaginary part]");
    }
    return std::nullopt;
  }
  const auto ports = static_cast<Eigen::Index>(
      std::lround(std::sqrt(0.5 * static_cast<double>(residues->cols()))));
  if (poles->cols() > 2) {
    table.problem("poles", "expected rows [real part, imaginary part] in rad/s");
    return std::nullopt;
  }
  if (2 * ports * ports != residues->cols() || residues->rows() != poles->rows()) {
    table.problem("residues",
                  fmt::format("found {} rows of {}, expected {} of two numbers (real and imaginary "
                              "part), or of two for each entry of a matrix",
                              residues->rows(), residues->cols(), poles->rows()));
    return std::nullopt;
  }
  PolesAndResidues read{{}, ports};
  for (Eigen::Index k = 0; k < poles->rows(); ++k) {
    const double imaginary = poles->cols() > 1 ? (*poles)(k, 1) : 0.0;
    const double sign = imaginary < 0.0 ? -1.0 : 1.0;  // the conjugate one says the same
    CMat residue(ports, ports);
    for (Eigen::Index i = 0; i < ports * ports; ++i) {
      residue(i / ports, i % ports) =
          Complex((*residues)(k, 2 * i), sign * (*residues)(k, 2 * i + 1));
    }
    if (imaginary == 0.0 && !residue.imag().isZero(0.0)) {
      table.problem("residues", fmt::format("the residue of the real pole {:g} rad/s is not real",
                                            (*poles)(k, 0)));
      return std::nullopt;
    }
    read.parts.push_back({Complex((*poles)(k, 0), std::abs(imaginary)), residue});
  }
  return read;
}

/// The state space of matrices that are there, or what does not fit together.
/// @param wrong  called with the name of a matrix and what is wrong with it
std::optional<StateSpace> law_of(const StateSpaceTable& found,
                                 const std::function<void(const char*, std::string)>& wrong) {
  StateSpace law;
  const auto& [A, B, C, D] = found;
  if (D && !A && !B && !C) {
    law = {Mat(0, 0), Mat(0, D->cols()), Mat(D->rows(), 0), *D, {}, {}};
    return law;
  }
  if (!A || !B || !C) return std::nullopt;
  const Eigen::Index n = A->rows();
  law.A = *A;
  law.B = B->rows() == 1 && n > 1 ? Mat(B->transpose()) : *B;  // one column, written as a row
  law.C = *C;
  law.D = D ? *D : Mat(Mat::Zero(law.C.rows(), law.B.cols()));
  const auto check = [&](const char* key, const Mat& M, Eigen::Index rows, Eigen::Index cols) {
    if (M.rows() == rows && M.cols() == cols) return true;
    wrong(key, fmt::format("found {} x {}, expected {} x {}", M.rows(), M.cols(), rows, cols));
    return false;
  };
  const bool fits = check("A", law.A, n, n) && check("B", law.B, n, law.B.cols()) &&
                    check("C", law.C, law.C.rows(), n) &&
                    check("D", law.D, law.C.rows(), law.B.cols());
  return fits ? std::optional(law) : std::nullopt;
}

std::optional<StateSpace> matrices(TableReader& table, const LawKeys& keys) {
  const bool has_states = table.has("A") || table.has("B") || table.has("C");
  for (const char* key : {"A", "B", "C"}) {
    if (has_states && !table.has(key)) {
      table.missing(key, "a matrix of the state space z' = A z + B u");
    }
  }
  return law_of({keys.A, keys.B, keys.C, keys.D}, [&](const char* key, std::string message) {
    table.problem(key, std::move(message));
  });
}

/// The law in the file that the key state_space names.
std::optional<StateSpace> matrices_of_file(ModelReading& reading, TableReader& table,
                                           LawOwner owner) {
  const ForeignTable wanted{.kind = ForeignTable::Kind::state_space};
  const auto from = reading.text_of(
      table, "state_space", owner.name, owner.item,
      [](const std::string&) { return std::size_t{0}; }, &wanted);
  if (!from) return std::nullopt;
  std::vector<Problem> wrong;
  const StateSpaceTable found = parse_state_space_table(from->text, from->name, wrong);
  reading.add_problems(wrong);
  if (!wrong.empty()) return std::nullopt;
  const auto report = [&](const char* key, const std::string& message) {
    table.problem("state_space", fmt::format("{}: {}: {}", from->name, key, message));
  };
  const bool has_states = found.A || found.B || found.C || !found.D;
  for (const auto& [key, matrix] :
       {std::pair("A", &found.A), std::pair("B", &found.B), std::pair("C", &found.C)}) {
    if (!has_states || *matrix) continue;
    report(key, "missing, expected a matrix of the state space z' = A z + B u");
    return std::nullopt;
  }
  return law_of(found, report);
}

std::optional<TransferFunction> function_in(TableReader& table, const LawKeys& keys) {
  for (const char* key : {"numerator", "denominator"}) {
    if (!table.has(key)) {
      table.missing(key, "coefficients of powers of s [rad/s], of the highest one first");
    }
  }
  if (keys.numerator.empty() || keys.denominator.empty()) return std::nullopt;
  return TransferFunction{keys.numerator, keys.denominator};
}

std::optional<StateSpace> residues(TableReader& table, const LawKeys& keys, TransferForm form) {
  const auto read = poles_and_residues(table, keys);
  if (!read) return std::nullopt;
  if (form == TransferForm::dynamic_stiffness) {
    return state_space(read->parts, Mat::Zero(read->ports, read->ports));
  }
  if (read->ports > 1) {
    table.problem("form", "several coordinates take a dynamic stiffness");
    return std::nullopt;
  }
  return state_space(dynamic_stiffness_of(function_of(read->parts), form));
}

}  // namespace

InterfaceCoordinate interface_along(const Station& at, const Station& to, double angle) {
  constexpr double rounding = 1e-15;
  const auto exact = [](double v) { return std::abs(v) < rounding ? 0.0 : v; };
  return {at, to, exact(std::cos(angle)), exact(std::sin(angle))};
}

Station other_side(ModelReading& reading, TableReader& table, const std::optional<Station>& at) {
  const auto name = table.string("to");
  const auto found = name ? reading.named_station(*name, table, "to", true, at) : std::nullopt;
  if (found && at && at->kind == Station::Kind::body && at->body == found->body) {
    table.problem("to", "the body would stand on itself");
  }
  return found.value_or(Station{});
}

std::optional<TransferFunction> read_function(TableReader& table) {
  return function_in(table, LawKeys(table));
}

bool has_law(const TableReader& table) {
  return std::ranges::any_of(law_keys, [&](std::string_view key) { return table.has(key); });
}

std::optional<StateSpace> read_law(ModelReading& reading, TableReader& table, LawOwner owner,
                                   TransferForm form) {
  const bool has_function = table.has("numerator") || table.has("denominator");
  const bool has_poles = table.has("poles") || table.has("residues");
  const bool has_matrices = table.has("A") || table.has("B") || table.has("C") || table.has("D");
  const bool has_file = table.has("state_space");
  const char* key = has_file       ? "state_space"
                    : has_matrices ? "A"
                    : has_poles    ? "poles"
                                   : "denominator";
  const LawKeys keys(table);
  std::optional<StateSpace> law;
  try {
    if (has_function + has_poles + has_matrices + has_file > 1) {
      table.problem(has_poles ? "poles" : key,
                    "found two laws, expected one: numerator and denominator, poles and residues, "
                    "A, B, C and D, or a file of these");
      table.string("state_space");
      return std::nullopt;
    }
    if (const auto of_file = matrices_of_file(reading, table, owner)) law = of_file;
    if (has_poles) law = residues(table, keys, form);
    if (has_matrices) law = matrices(table, keys);
    if (const auto read = has_function ? function_in(table, keys) : std::nullopt) {
      law = state_space(dynamic_stiffness_of(*read, form));
    }
  } catch (const NumericalError& error) {
    table.problem(has_poles ? "poles" : "numerator", error.what());
    return std::nullopt;
  }
  if (law && law->states() > most_states) {
    table.problem(key,
                  fmt::format("found {} states, expected up to {}", law->states(), most_states));
    return std::nullopt;
  }
  return law;
}

}  // namespace whirl::inline io

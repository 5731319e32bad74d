#include "libio/model/response_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/vector_fit.hpp"
#include "libio/model/delimited_table.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

constexpr int most_ports = 4;  ///< whose entries have names

std::string_view unit_of(TransferForm form) {
  switch (form) {
    case TransferForm::dynamic_stiffness:
      return "N/m";
    case TransferForm::impedance:
      return "N.s/m";
    case TransferForm::receptance:
      return "m/N";
    default:
      return "m/N/s";
  }
}

/// "12" of the second entry in the first row; nothing where there is one only.
std::string entry_name(int ports, int row, int column) {
  return ports == 1 ? "" : fmt::format("{}{}", row + 1, column + 1);
}

std::vector<ColumnKind> response_columns(TransferForm form, int ports) {
  std::vector<ColumnKind> columns{{.name = "whirl",
                                   .unit = "rad/s",
                                   .range = Range::positive,
                                   .must_be_filled = true,
                                   .others_need_unit = true}};
  for (int i = 0; i < ports; ++i) {
    for (int j = 0; j < ports; ++j) {
      const std::string entry = entry_name(ports, i, j);
      for (const char* part : {"real", "imaginary", "magnitude"}) {
        columns.push_back({part + entry, std::string(unit_of(form)), Range::any});
      }
      columns.push_back({"angle" + entry, "rad", Range::any});
    }
  }
  return columns;
}

/// Which parts of an entry a table has; empty: not those that are needed.
std::vector<std::string> parts_of(const DelimitedTable& table, const std::string& entry) {
  if (table.has("real" + entry) && table.has("imaginary" + entry)) {
    return {"real" + entry, "imaginary" + entry};
  }
  if (table.has("magnitude" + entry) && table.has("angle" + entry)) {
    return {"magnitude" + entry, "angle" + entry};
  }
  return {};
}

/// What is told at a frequency as a dynamic stiffness; nothing: it cannot be inverted.
std::optional<CMat> stiffness_of(const CMat& told, TransferForm form, double omega) {
  const bool is_inverse = form == TransferForm::receptance || form == TransferForm::mobility;
  const bool is_of_rate = form == TransferForm::impedance || form == TransferForm::mobility;
  CMat K = told;
  if (is_inverse) {
    const DenseLu<CMat> factor(told);
    if (!(factor.rcond() > 1e-14)) return std::nullopt;
    K = factor.solve(CMat::Identity(told.rows(), told.cols()));
  }
  if (is_of_rate) K *= Complex(0.0, omega);
  return K;
}

/// Damping of a stiffness: the least part of it that takes energy from a motion, of its size.
double damping_of(const CMat& K) {
  const CMat imaginary = (K - K.adjoint()) / Complex(0.0, 2.0);
  return hermitian_modes(imaginary).values.minCoeff() / std::max(K.norm(), 1e-300);
}

StateSpace law_of(const RationalFit& fit, Eigen::Index ports) {
  const auto matrix = [&](const auto& entries) {
    CMat M(ports, ports);
    for (Eigen::Index k = 0; k < entries.size(); ++k) M(k / ports, k % ports) = entries(k);
    return M;
  };
  std::vector<PoleResidue> parts;
  for (Eigen::Index k = 0; k < fit.poles.size(); ++k) {
    parts.push_back({fit.poles(k), matrix(fit.residues.col(k))});
  }
  StateSpace law = state_space(parts, matrix(fit.direct.col(0)).real());
  if (!fit.direct.col(1).isZero(0.0)) law.D_rate = matrix(fit.direct.col(1)).real();
  if (!fit.direct.col(2).isZero(0.0)) law.D_inertia = matrix(fit.direct.col(2)).real();
  return law;
}

}  // namespace

std::size_t response_columns_named_in(const std::string& line) {
  return columns_named_in(line, response_columns(TransferForm::dynamic_stiffness, most_ports)) +
         columns_named_in(line, response_columns(TransferForm::dynamic_stiffness, 1));
}

MeasuredStiffness parse_response_table(const std::string& text, const std::string& file,
                                       TransferForm form, int ports, std::vector<Problem>& problems,
                                       std::vector<Problem>* doubts) {
  const std::size_t before = problems.size();
  const auto report = [&](int line, int place, std::string key, std::string message) {
    problems.push_back({{file, line, line > 0 ? place : 0}, std::move(key), std::move(message)});
  };
  if (ports > most_ports) {
    report(0, 0, "",
           fmt::format("a response of {} coordinates, expected up to {}", ports, most_ports));
    return {};
  }
  const DelimitedTable table =
      parse_delimited(text, file, response_columns(form, ports), problems, doubts);
  std::vector<std::vector<std::string>> parts;
  if (table.header > 0 && problems.size() == before && !table.has("whirl")) {
    report(table.header, 1, "frequency", "missing, expected frequencies with their unit (Hz)");
  }
  for (int i = 0; i < ports && problems.size() == before; ++i) {
    for (int j = 0; j < ports; ++j) {
      const std::string entry = entry_name(ports, i, j);
      parts.push_back(parts_of(table, entry));
      if (!parts.back().empty()) continue;
      report(table.header, 1, "real" + entry,
             fmt::format("missing, expected real{0} and imaginary{0}, or magnitude{0} and phase{0}",
                         entry));
      break;
    }
  }
  MeasuredStiffness response;
  if (problems.size() > before) return response;
  for (const DelimitedRow& row : table.rows) {
    const auto omega = row.number("whirl");
    if (!omega) continue;  // which is reported
    if (!response.omega.empty() && *omega <= response.omega.back()) {
      report(row.line, row.place("whirl"), "frequency",
             "frequencies must ascend from line to line");
    }
    CMat told(ports, ports);
    for (Eigen::Index k = 0; k < ports * ports; ++k) {
      const std::vector<std::string>& names = parts[static_cast<std::size_t>(k)];
      const double a = row.number(names[0]).value_or(0.0), b = row.number(names[1]).value_or(0.0);
      const bool is_polar = names[0].starts_with("magnitude");
      told(k / ports, k % ports) = is_polar ? std::polar(a, b) : Complex(a, b);
    }
    const auto K = stiffness_of(told, form, *omega);
    if (!K) {
      report(row.line, row.place("whirl"), "frequency", "the response has no inverse here");
      continue;
    }
    response.omega.push_back(*omega);
    response.K.push_back(*K);
  }
  if (problems.size() == before) return response;
  tell_once(problems, before);
  return {};
}

StateSpace fitted_law(const MeasuredStiffness& response, const FitOptions& how, LawFit& fit) {
  const auto samples = std::ssize(response.omega);
  if (samples == 0) throw NumericalError("the response has no samples");
  const Eigen::Index ports = response.K.front().rows();
  const Vec omega = Eigen::Map<const Vec>(response.omega.data(), samples);
  CMat H(ports * ports, samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const CMat& K = response.K[static_cast<std::size_t>(k)];
    for (Eigen::Index e = 0; e < H.rows(); ++e) H(e, k) = K(e / ports, e % ports);
  }
  const auto most = static_cast<int>(std::min<Eigen::Index>(most_fit_order, (samples - 3) / 2));
  const int first = how.order > 0 ? how.order : 0, last = how.order > 0 ? how.order : most;
  RationalFit best;
  best.error = std::numeric_limits<double>::infinity();
  for (int order = first; order <= std::max(first, last) && best.error > how.tolerance; ++order) {
    for (int direct = 1; direct <= 3 && best.error > how.tolerance; ++direct) {
      RationalFit found = vector_fit(omega, H, order, direct);
      if (found.error < best.error) best = std::move(found);
    }
  }

  const StateSpace law = law_of(best, ports);
  fit = {.samples = static_cast<int>(samples),
         .poles = law.states(),
         .error = best.error,
         .largest = best.largest,
         .mirrored = best.unstable,
         .least_damping = std::numeric_limits<double>::infinity()};
  for (Eigen::Index k = 0; k < samples; ++k) {
    const Complex s{0.0, omega(k)};
    const CVec left = best.at(s) - H.col(k);
    if (left.norm() / H.col(k).norm() >= best.largest) fit.largest_at = omega(k);
    const double damping = damping_of(law.stiffness_at(s));
    if (damping >= fit.least_damping) continue;
    fit.least_damping = damping;
    fit.least_damping_at = omega(k);
  }
  return law;
}

}  // namespace whirl::inline io

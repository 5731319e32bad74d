#include "libio/export/matrices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libdyn/system/stations.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/results/matlab_variables.hpp"

namespace whirl::inline io {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view mtx_head =
    "%%MatrixMarket matrix coordinate real general\n% written by whirl\n";
constexpr std::string_view dofs_head = "coordinate,what,z [m]\n";
constexpr const char* matlab_head = "MATLAB 5.0 MAT-file, written by whirl";

struct NamedMatrix {
  const char* name;
  Sparse values;
};

std::array<NamedMatrix, 4> matrices_of(const System& system) {
  return {{{"M", system.M}, {"C", system.C}, {"G", system.G()}, {"K", system.stiffness()}}};
}

std::string market_text(const Sparse& A) {
  std::string text(mtx_head);
  fmt::format_to(std::back_inserter(text), "{} {} {}\n", A.rows(), A.cols(), A.nonZeros());
  for (int j = 0; j < A.outerSize(); ++j) {
    for (Sparse::InnerIterator it(A, j); it; ++it) {
      fmt::format_to(std::back_inserter(text), "{} {} {}\n", it.row() + 1, j + 1, it.value());
    }
  }
  return text;
}

/// A sparse matrix as MATLAB has it: by columns, rows ascending.
MatlabVariable sparse_variable(const char* name, Sparse A) {
  A.makeCompressed();
  std::vector<mat_uint32_t> rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
  std::vector<mat_uint32_t> columns(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
  mat_sparse_t data{};
  data.nzmax = static_cast<mat_uint32_t>(A.nonZeros());
  data.ir = rows.data();
  data.nir = data.nzmax;
  data.jc = columns.data();
  data.njc = static_cast<mat_uint32_t>(columns.size());
  data.ndata = data.nzmax;
  data.data = A.valuePtr();
  std::array<std::size_t, 2> size{static_cast<std::size_t>(A.rows()),
                                  static_cast<std::size_t>(A.cols())};
  return {Mat_VarCreate(name, MAT_C_SPARSE, MAT_T_DOUBLE, 2, size.data(), &data, 0), &Mat_VarFree};
}

}  // namespace

std::vector<std::string> coordinate_names(const DofMap& dofs, const Model& model) {
  constexpr std::array<const char*, 4> components{"x", "y", "theta_x", "theta_y"};
  std::vector<std::string> of_full(static_cast<std::size_t>(dofs.full_size));
  for (const Point& p : dofs.points()) {
    const auto i = static_cast<std::size_t>(p.index);
    const std::string at = p.kind == Point::Kind::body ? model.structure.bodies.at(i).name
                                                       : fmt::format("node {}", p.index + 1);
    for (int c = 0; c < 4; ++c) {
      const int k = dofs.full_index(p, c);
      if (k >= 0) of_full[static_cast<std::size_t>(k)] = fmt::format("{} {}", at, components[c]);
    }
  }
  std::vector<std::string> names(static_cast<std::size_t>(dofs.size()));
  for (int q = 0; q < dofs.size(); ++q) {
    std::string& name = names[static_cast<std::size_t>(q)];
    for (Sparse::InnerIterator it(dofs.T, q); it; ++it) {
      const std::string& one = of_full[static_cast<std::size_t>(it.row())];
      name += (name.empty() ? "" : " = ") + (one.empty() ? "internal shape function" : one);
    }
  }
  return names;
}

std::vector<double> coordinate_places(const DofMap& dofs, const Model& model,
                                      const Assembler& assembler) {
  const Vec z = point_names(model, assembler).z;
  std::vector<double> places(static_cast<std::size_t>(dofs.size()), std::nan(""));
  for (int q = 0; q < dofs.size(); ++q) {
    double& at = places[static_cast<std::size_t>(q)];
    for (Sparse::InnerIterator it(dofs.T, q); it && std::isnan(at); ++it) {
      if (it.row() < 4 * dofs.nodes) at = z(it.row() / 4);
    }
  }
  return places;
}

std::vector<fs::path> write_matrix_market(const fs::path& stem, const Model& model,
                                          const Assembler& assembler, double Omega,
                                          Replaces replaces) {
  const System system = assembler.uncondensed(Omega);
  std::vector<fs::path> files;
  for (const auto& [name, values] : matrices_of(system)) {
    files.emplace_back(fmt::format("{}_{}.mtx", stem.string(), name));
    replace_file(files.back(), market_text(values), replaces_own(files.back(), mtx_head, replaces));
  }
  const std::vector<std::string> names = coordinate_names(system.dofs, model);
  const std::vector<double> places = coordinate_places(system.dofs, model, assembler);
  std::string table(dofs_head);
  for (std::size_t q = 0; q < names.size(); ++q) {
    const std::string at = std::isnan(places[q]) ? "" : fmt::format("{}", places[q]);
    table += fmt::format("{},{},{}\n", q + 1, csv_quoted(spreadsheet_text(names[q])), at);
  }
  files.emplace_back(stem.string() + "_dofs.csv");
  replace_file(files.back(), table, replaces_own(files.back(), dofs_head, replaces));
  return files;
}

std::vector<fs::path> write_matlab(const fs::path& stem, const Model& model,
                                   const Assembler& assembler, double Omega, Replaces replaces) {
  const System system = assembler.uncondensed(Omega);
  const fs::path place = stem.string() + ".mat";
  std::vector<MatlabVariable> variables;
  for (const auto& [name, values] : matrices_of(system)) {
    variables.push_back(sparse_variable(name, values));
  }
  variables.push_back(matlab_numbers("Omega", {Omega}, 1, 1));
  variables.push_back(matlab_texts("dofs", coordinate_names(system.dofs, model)));
  write_matlab_file(place, matlab_head, variables, replaces);
  return {place};
}

}  // namespace whirl::inline io

#include "libdyn/methods/step_tables.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/numerics/legendre.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double fast = 4.0;  ///< modes by the contact frequency, from which on they are too fast
                              ///< for the points of a step

int nodes_for(const ContactSystem& system) {
  const bool is_fast = fastest_mode(system) > fast * contact_frequency(system);
  return is_fast ? 2 * StepTables::terms : StepTables::terms;
}

}  // namespace

StepTables::StepTables(const ContactSystem& system, double longest)
    : system_(system), longest_(longest), nodes_(nodes_for(system)), families_(2) {
  const GaussRule rule = gauss_rule(nodes_);
  project_.resize(terms, nodes_);
  at_nodes_.resize(nodes_, terms);
  for (int i = 0; i < nodes_; ++i) {
    const Vec p = legendre(rule.s(i), terms);
    at_nodes_.row(i) = p.transpose();
    for (int k = 0; k < terms; ++k) project_(k, i) = rule.w(i) * (2 * k + 1) * p(k);
  }
  const auto places = [](const Vec& s) {
    return StepPlaces{s, values_to_legendre(s), legendre_to_powers(static_cast<int>(s.size()))};
  };
  Vec with_ends(nodes_ + 2);
  with_ends << 0.0, rule.s, 1.0;
  touch_places_ = places(with_ends);
  flight_places_ = places(chebyshev_points(samples));
  at_places_.resize(nodes_ + 2, terms);
  for (int i = 0; i < nodes_ + 2; ++i) {
    at_places_.row(i) = legendre(with_ends(i), terms).transpose();
  }
}

double StepTables::size(Rung rung) const {
  const double top = rung.family() == 0 ? longest_ : longest_ / std::numbers::sqrt2;
  return std::ldexp(top, -rung.level());
}

Rung StepTables::rung_for(double h) const {
  return {std::max(0, static_cast<int>(std::floor(2.0 * std::log2(longest_ / h) + 1e-9)))};
}

StepTables::Family& StepTables::family_of(Rung rung) {
  auto& family = families_[static_cast<std::size_t>(rung.family())];
  if (!family) {
    family.reset(new Family{{system_, size({rung.family()}), terms}, {}, {}, {}});
    family->touch.resize(LinearFlow::levels);
    family->flight.resize(LinearFlow::levels);
    family->dense.resize(LinearFlow::levels);
  }
  return *family;
}

void StepTables::fill(StepNodes& table, LinearFlow& flow, int level, const Vec& s,
                      bool has_force) const {
  const auto contacts = system_.contacts().size();
  const StateLayout layout = system_.layout();
  const auto m = s.size();
  Mat r = Mat::Zero(rows * static_cast<Eigen::Index>(contacts), layout.size());
  for (std::size_t c = 0; c < contacts; ++c) {
    const auto row = rows * static_cast<Eigen::Index>(c);
    layout.eta_columns(r).middleRows(row, 2) = system_.contacts()[c].U;
    layout.rate_columns(r).middleRows(row + 2, 2) = system_.contacts()[c].U;
  }
  table.free.assign(contacts, Mat(rows * m, layout.size() + 3));
  if (has_force) table.kernel.assign(contacts * contacts, Mat(rows * m, 2 * terms));
  for (Eigen::Index i = 0; i < m; ++i) {
    const LinearFlow::Rows at =
        flow.rows(level, s(i), r, has_force ? LinearFlow::Forces::all : LinearFlow::Forces::none);
    for (std::size_t c = 0; c < contacts; ++c) {
      for (int d = 0; d < rows; ++d) {
        const auto from = rows * static_cast<Eigen::Index>(c) + d, to = d * m + i;
        table.free[c].row(to) << at.y.row(from), at.load.row(from);
        for (std::size_t b = 0; has_force && b < contacts; ++b) {
          table.kernel[c * contacts + b].row(to) =
              at.force.row(from).segment(static_cast<Eigen::Index>(b) * 2 * terms, 2 * terms);
        }
      }
    }
  }
}

const StepNodes& StepTables::nodes_of(Rung rung, bool is_touching) {
  Family& family = family_of(rung);
  const auto level = static_cast<std::size_t>(rung.level());
  StepNodes& table = is_touching ? family.touch[level] : family.flight[level];
  if (table.free.empty()) {
    const Vec s = is_touching ? touch_places_.s.segment(1, nodes_).eval()
                              : flight_places_.s.tail(samples - 1).eval();
    fill(table, family.flow, rung.level(), s, is_touching);
  }
  return table;
}

const Mat& StepTables::dense(Rung of_family, int level) {
  Family& family = family_of(of_family);
  Mat& table = family.dense[static_cast<std::size_t>(level)];
  if (table.size() > 0) return table;
  const Vec s = chebyshev_points(samples);
  const auto N = system_.size();
  const auto forces = 2 * static_cast<Eigen::Index>(system_.contacts().size()) * terms;
  table.resize((samples - 1) * N, N + 3 + forces);
  for (int i = 1; i < samples; ++i) {
    const LinearFlow::Rows rows_at = family.flow.rows(level, s(i), Mat::Identity(N, N));
    table.middleRows((i - 1) * N, N) << rows_at.y, rows_at.load, rows_at.force;
  }
  return table;
}

}  // namespace whirl::inline dyn

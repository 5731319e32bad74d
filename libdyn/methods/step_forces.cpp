#include "libdyn/methods/step_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/legendre.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int most_sweeps = 25, most_newton = 12;
constexpr double slow = 0.3;  ///< contraction from which on Newton's method is cheaper
constexpr double rounding_of_forces = 4e-15;  ///< of forces

/// Largest value on [0, 1] of the integral of P_terms(2 s - 1): what a force that is left out does
/// to the velocity.
double largest_integral(int terms) {
  double largest = 0.0;
  for (double s = 0.0; s < 1.0; s += 0.01) {
    const Vec p = legendre(s, terms + 2);
    largest = std::max(largest, std::abs(p(terms + 1) - p(terms - 1)) / (2 * (2 * terms + 1)));
  }
  return largest;
}

}  // namespace

NodeMotion::NodeMotion(const ContactSystem& system, StepTables& of)
    : tables(of),
      a(Vec::Zero(2 * static_cast<Eigen::Index>(system.contacts().size()) * terms)),
      free(system.contacts().size()),
      under(system.contacts().size(), Mat(of.nodes(), StepTables::rows)) {}

void NodeMotion::begin(Rung of, const MotionState& from) {
  constexpr int rows = StepTables::rows;
  rung = of;
  touching.clear();
  for (std::size_t c = 0; c < from.contacts.size(); ++c) {
    if (from.contacts[c].in_touch()) touching.push_back(static_cast<int>(c));
  }
  load = load_at(from.phase);
  Vec extended(from.y.size() + 3);
  extended << from.y, load;
  const StepNodes& table = tables.nodes_of(rung, !touching.empty());
  for (std::size_t c = 0; c < free.size(); ++c) {
    free[c].resize(table.free[c].rows() / rows, rows);
    Eigen::Map<Vec>(free[c].data(), free[c].size()).noalias() = table.free[c] * extended;
  }
  a.setZero();
}

void NodeMotion::evaluate(bool with_rates) {
  constexpr int rows = StepTables::rows;
  const StepNodes& table = tables.nodes_of(rung, true);
  const auto contacts = static_cast<int>(under.size());
  const Eigen::Index used = (with_rates ? rows : 2) * tables.nodes();
  for (const int c : touching) {
    Mat& at = under[static_cast<std::size_t>(c)];
    Eigen::Map<Vec> values(at.data(), used);
    values = Eigen::Map<const Vec>(free[static_cast<std::size_t>(c)].data(), used);
    for (const int b : touching) {
      values.noalias() +=
          table.kernel[static_cast<std::size_t>(c * contacts + b)].topRows(used) * force_of(b);
    }
  }
}

Mat NodeMotion::of(std::size_t contact) const {
  const auto is_it = [&](int c) { return static_cast<std::size_t>(c) == contact; };
  if (touching.empty()) return free[contact];
  if (std::any_of(touching.begin(), touching.end(), is_it)) return under[contact];
  Mat at = free[contact];
  Eigen::Map<Vec> flat(at.data(), at.size());
  const StepNodes& table = tables.nodes_of(rung, true);
  for (const int b : touching) {
    flat.noalias() +=
        table.kernel[contact * free.size() + static_cast<std::size_t>(b)] * force_of(b);
  }
  return at;
}

StepForces::StepForces(const ContactSystem& system, StepTables& tables, double tolerance)
    : system_(system), tables_(tables), nodes_(system, tables), node_forces_(tables.nodes(), 2) {
  const double left_out = largest_integral(terms);
  const auto rate_scale = system.layout().rate(system.state_scale());
  for (const ReducedContact& c : system.contacts()) {
    const double depth = 0.01 * c.clearance, rate = c.clearance * system.phase_rate();
    const bool is_damped = normal_force(c.law, depth, rate) != normal_force(c.law, depth, 0.0);
    const bool is_smooth =
        c.friction.mu > 0.0 && !c.friction.is_exact() && c.friction.slip == Slip::actual;
    rate_matters_.push_back(is_damped || is_smooth ? 1 : 0);
    const double largest = (c.B.array().colwise() / rate_scale.array()).abs().maxCoeff();
    weight_.push_back(left_out * largest / tolerance);
  }
}

bool StepForces::solve(Rung rung, const MotionState& from) {
  nodes_.begin(rung, from);
  state_size_ =
      std::max(1.0, (from.y.array() / system_.state_scale().array()).abs().maxCoeff() / grown);
  error_ = 0.0;
  if (nodes_.touching.empty()) return true;
  const bool sticks = std::any_of(from.contacts.begin(), from.contacts.end(),
                                  [](const ContactState& c) { return c.touch == Touch::sticking; });
  if ((sticks || !picard(from)) && !newton(from)) return false;
  nodes_.evaluate(true);
  estimate();
  return true;
}

Vec2 StepForces::node_force(int contact, const ContactState& state, const double* node,
                            int stride) {
  const ReducedContact& c = system_.contacts()[static_cast<std::size_t>(contact)];
  ++evaluations_;
  const ContactForces f = forces_at(c, Vec2(node[0], node[stride]) - c.offset,
                                    Vec2(node[2 * stride], node[3 * stride]));
  return f.normal * f.n + sliding_friction(c, state, f) * f.t();
}

bool StepForces::picard(const MotionState& from) {
  bool with_rates = false;
  for (const int c : nodes_.touching) {
    with_rates = with_rates || rate_matters_[static_cast<std::size_t>(c)] != 0;
  }
  const double h = tables_.size(nodes_.rung);
  double before = std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    nodes_.evaluate(with_rates);
    double change = 0.0, largest = 0.0, effect = 0.0;
    for (const int c : nodes_.touching) {
      const auto i = static_cast<std::size_t>(c);
      for (int k = 0; k < tables_.nodes(); ++k) {
        node_forces_.row(k) =
            node_force(c, from.contacts[i], nodes_.under[i].data() + k, tables_.nodes())
                .transpose();
      }
      Eigen::Map<Mat> a(nodes_.a.data() + 2 * c * terms, terms, 2);
      Eigen::Matrix<double, terms, 2> next;
      next.noalias() = tables_.project().lazyProduct(node_forces_);
      const double size_of_change = (next - a).cwiseAbs().maxCoeff();
      change = std::max(change, size_of_change);
      effect = std::max(effect, size_of_change * weight_[i] * h / state_size_);
      largest = std::max(largest, next.cwiseAbs().maxCoeff());
      a = next;
    }
    if (!std::isfinite(change)) return false;
    if (change <= rounding_of_forces * largest || effect <= 1e-3) return true;
    if (sweep > 2 && change > slow * before) return false;
    before = change;
  }
  return false;
}

void StepForces::residual(const MotionState& from, int contact, const double* dw, const Vec2& force,
                          Vec2& out) {
  const auto i = static_cast<std::size_t>(contact);
  const ReducedContact& c = system_.contacts()[i];
  if (from.contacts[i].touch == Touch::sliding) {
    out = force - node_force(contact, from.contacts[i], dw, 1);
    return;
  }
  ++evaluations_;
  const ContactForces f = forces_at(c, Vec2(dw[0], dw[1]) - c.offset, Vec2(dw[2], dw[3]));
  const Vec2 t = f.t();
  if (!system_.leads(from.contacts, i)) {  // another one carries its friction
    out = force - f.normal * f.n;
    return;
  }
  const double mobility = tables_.size(nodes_.rung) * t.dot(c.U * (c.B * t));
  out = (f.n.dot(force) - f.normal) * f.n - (f.slip / mobility) * t;
}

void StepForces::add_slopes(const MotionState& from, const StepNodes& table, Eigen::Index p, int k,
                            const Vec2& force, const Vec2& value, Mat& J) {
  const int c = nodes_.touching[static_cast<std::size_t>(p)];
  const auto i = static_cast<std::size_t>(c);
  const auto contacts = static_cast<int>(nodes_.under.size());
  const auto m = static_cast<Eigen::Index>(nodes_.touching.size());
  double dw[rows];
  for (int d = 0; d < rows; ++d) dw[d] = nodes_.under[i](k, d);
  Vec2 other;
  Eigen::Matrix<double, 2, rows> by_motion;
  for (int d = 0; d < rows; ++d) {
    const double step =
        1e-7 * system_.contacts()[i].clearance * (d < 2 ? 1.0 : system_.phase_rate());
    const double kept = dw[d];
    dw[d] = kept + step;
    residual(from, c, dw, force, other);
    dw[d] = kept;
    by_motion.col(d) = (other - value) / step;
  }
  Mat2 by_force;
  for (int d = 0; d < 2; ++d) {
    const double step = std::max(1.0, force.norm());
    residual(from, c, dw, force + step * Vec2::Unit(d), other);
    by_force.col(d) = (other - value) / step;
  }
  for (int d = 0; d < 2; ++d) {
    for (int e = 0; e < 2; ++e) {
      J.block((2 * p + d) * terms, (2 * p + e) * terms, terms, terms) +=
          by_force(d, e) * tables_.project().col(k) * tables_.at_nodes().row(k);
    }
    for (Eigen::Index q = 0; q < m; ++q) {
      const int b = nodes_.touching[static_cast<std::size_t>(q)];
      const Mat& kernel = table.kernel[static_cast<std::size_t>(c * contacts + b)];
      Eigen::RowVectorXd along = Eigen::RowVectorXd::Zero(2 * terms);
      for (int e = 0; e < rows; ++e) along += by_motion(d, e) * kernel.row(e * tables_.nodes() + k);
      J.block((2 * p + d) * terms, q * 2 * terms, terms, 2 * terms) +=
          tables_.project().col(k) * along;
    }
  }
}

bool StepForces::newton(const MotionState& from) {
  const StepNodes& table = tables_.nodes_of(nodes_.rung, true);
  const auto m = static_cast<Eigen::Index>(nodes_.touching.size());
  const double h = tables_.size(nodes_.rung);
  Mat J(2 * terms * m, 2 * terms * m);
  Vec r(2 * terms * m);
  std::optional<DenseLu<Mat>> lu;
  double before = std::numeric_limits<double>::infinity();
  bool has_jacobian = false;
  if (!nodes_.a.allFinite()) nodes_.a.setZero();
  for (int iteration = 0; iteration < most_newton; ++iteration) {
    nodes_.evaluate(true);
    const bool renew = !has_jacobian;
    if (renew) J.setZero();
    r.setZero();
    for (Eigen::Index p = 0; p < m; ++p) {
      const int c = nodes_.touching[static_cast<std::size_t>(p)];
      const auto i = static_cast<std::size_t>(c);
      const Eigen::Map<const Mat> a(nodes_.a.data() + 2 * c * terms, terms, 2);
      for (int k = 0; k < tables_.nodes(); ++k) {
        double dw[rows];
        for (int d = 0; d < rows; ++d) dw[d] = nodes_.under[i](k, d);
        const Vec2 force = (tables_.at_nodes().row(k) * a).transpose();
        Vec2 value;
        residual(from, c, dw, force, value);
        for (int d = 0; d < 2; ++d) {
          r.segment((2 * p + d) * terms, terms) += value(d) * tables_.project().col(k);
        }
        if (renew) add_slopes(from, table, p, k, force, value, J);
      }
    }
    if (renew) lu.emplace(J);
    has_jacobian = true;
    const Vec change = lu->solve(r);
    double size_of_change = change.cwiseAbs().maxCoeff(), effect = 0.0;
    if (!std::isfinite(size_of_change)) return false;
    for (Eigen::Index p = 0; p < m; ++p) {
      const int c = nodes_.touching[static_cast<std::size_t>(p)];
      const auto part = change.segment(2 * p * terms, 2 * terms);
      nodes_.force_of(c) -= part;
      effect = std::max(effect, part.cwiseAbs().maxCoeff() * weight_[static_cast<std::size_t>(c)] *
                                    h / state_size_);
    }
    if (size_of_change <= rounding_of_forces * nodes_.a.cwiseAbs().maxCoeff() || effect <= 1e-3)
      return true;
    if (size_of_change > 0.1 * before) has_jacobian = false;
    before = size_of_change;
  }
  return false;
}

void StepForces::estimate() {
  // the first coefficient that is left out, from the fall of the last ones
  for (const int c : nodes_.touching) {
    const Eigen::Map<const Mat> a(nodes_.a.data() + 2 * c * terms, terms, 2);
    const double last =
        std::max(a.row(terms - 1).norm(),
                 0.5 * a.row(terms - 2).norm() * a.row(terms - 2).norm() / a.row(terms - 4).norm());
    const double fall =
        std::sqrt(std::min(1.0, (a.row(terms - 1).norm() + a.row(terms - 2).norm()) /
                                    (a.row(terms - 3).norm() + a.row(terms - 4).norm())));
    error_ = std::max(error_, weight_[static_cast<std::size_t>(c)] * tables_.size(nodes_.rung) *
                                  last / state_size_ * (std::isfinite(fall) ? fall : 1.0));
  }
}

}  // namespace whirl::inline dyn

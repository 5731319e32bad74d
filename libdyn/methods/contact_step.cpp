#include "libdyn/methods/contact_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/legendre.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int most_sweeps = 25, most_newton = 12;
constexpr double slow = 0.3;  ///< contraction from which on Newton's method is cheaper
constexpr double rounding_of_forces = 4e-15;  ///< of forces

constexpr double fast = 4.0;  ///< modes by the contact frequency, from which on they are too fast
                              ///< for the points of a step

int nodes_for(const ContactSystem& system) {
  const bool is_fast = fastest_mode(system) > fast * contact_frequency(system);
  return is_fast ? 2 * ContactStep::terms : ContactStep::terms;
}

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

ContactStep::ContactStep(const ContactSystem& system, double longest, double tolerance)
    : system_(system),
      longest_(longest),
      tolerance_(tolerance),
      nodes_(nodes_for(system)),
      families_(2),
      extended_(system.size() + 3),
      a_(Vec::Zero(2 * static_cast<Eigen::Index>(system.contacts().size()) * terms)),
      free_(system.contacts().size()),
      at_(system.contacts().size(), Mat(nodes_, rows)),
      paths_(system.contacts().size()),
      node_forces_(nodes_, 2) {
  const GaussRule rule = gauss_rule(nodes_);
  project_.resize(terms, nodes_);
  at_nodes_.resize(nodes_, terms);
  for (int i = 0; i < nodes_; ++i) {
    const Vec p = legendre(rule.s(i), terms);
    at_nodes_.row(i) = p.transpose();
    for (int k = 0; k < terms; ++k) project_(k, i) = rule.w(i) * (2 * k + 1) * p(k);
  }
  const auto places = [](const Vec& s) {
    return Places{s, values_to_legendre(s), legendre_to_powers(static_cast<int>(s.size()))};
  };
  Vec with_ends(nodes_ + 2);
  with_ends << 0.0, rule.s, 1.0;
  touch_places_ = places(with_ends);
  flight_places_ = places(chebyshev_points(samples));
  at_places_.resize(nodes_ + 2, terms);
  for (int i = 0; i < nodes_ + 2; ++i) {
    at_places_.row(i) = legendre(with_ends(i), terms).transpose();
  }

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

double ContactStep::size(Rung rung) const {
  const double top = rung.family() == 0 ? longest_ : longest_ / std::numbers::sqrt2;
  return std::ldexp(top, -rung.level());
}

Rung ContactStep::rung_for(double h) const {
  return {std::max(0, static_cast<int>(std::floor(2.0 * std::log2(longest_ / h) + 1e-9)))};
}

void ContactStep::fill(Nodes& table, LinearFlow& flow, int level, const Vec& s,
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

const ContactStep::Nodes& ContactStep::nodes_of(Rung rung, bool is_touching) {
  auto& family = families_[static_cast<std::size_t>(rung.family())];
  if (!family) {
    family.reset(new Family{{system_, size({rung.family()}), terms}, {}, {}, {}});
    family->touch.resize(LinearFlow::levels);
    family->flight.resize(LinearFlow::levels);
    family->dense.resize(LinearFlow::levels);
  }
  const auto level = static_cast<std::size_t>(rung.level());
  Nodes& table = is_touching ? family->touch[level] : family->flight[level];
  if (table.free.empty()) {
    const Vec s = is_touching ? touch_places_.s.segment(1, nodes_).eval()
                              : flight_places_.s.tail(samples - 1).eval();
    fill(table, family->flow, rung.level(), s, is_touching);
  }
  return table;
}

bool ContactStep::solve(Rung rung, const MotionState& from) {
  rung_ = rung;
  touching_.clear();
  bool sticks = false;
  for (std::size_t c = 0; c < from.contacts.size(); ++c) {
    if (!from.contacts[c].in_touch()) continue;
    touching_.push_back(static_cast<int>(c));
    sticks = sticks || from.contacts[c].touch == Touch::sticking;
  }
  size_ = std::max(1.0, (from.y.array() / system_.state_scale().array()).abs().maxCoeff() / grown);
  load_ = load_at(from.phase);
  extended_ << from.y, load_;
  const Nodes& table = nodes_of(rung, !touching_.empty());
  for (std::size_t c = 0; c < free_.size(); ++c) {
    free_[c].resize(table.free[c].rows() / rows, rows);
    Eigen::Map<Vec>(free_[c].data(), free_[c].size()).noalias() = table.free[c] * extended_;
  }
  a_.setZero();
  error_ = 0.0;
  if (!touching_.empty()) {
    if ((sticks || !picard(from)) && !newton(from)) return false;
    evaluate_nodes(true);
    estimate();
  }
  return make_paths(from);
}

void ContactStep::evaluate_nodes(bool with_rates) {
  const Nodes& table = nodes_of(rung_, true);
  const auto contacts = static_cast<int>(at_.size());
  const Eigen::Index used = (with_rates ? rows : 2) * nodes_;
  for (const int c : touching_) {
    Mat& at = at_[static_cast<std::size_t>(c)];
    Eigen::Map<Vec> values(at.data(), used);
    values = Eigen::Map<const Vec>(free_[static_cast<std::size_t>(c)].data(), used);
    for (const int b : touching_) {
      values.noalias() +=
          table.kernel[static_cast<std::size_t>(c * contacts + b)].topRows(used) * forces_of(b);
    }
  }
}

Vec2 ContactStep::node_force(int contact, const ContactState& state, const double* node,
                             int stride) {
  const ReducedContact& c = system_.contacts()[static_cast<std::size_t>(contact)];
  ++evaluations_;
  const ContactForces f = forces_at(c, Vec2(node[0], node[stride]) - c.offset,
                                    Vec2(node[2 * stride], node[3 * stride]));
  return f.normal * f.n + sliding_friction(c, state, f) * f.t();
}

bool ContactStep::picard(const MotionState& from) {
  bool with_rates = false;
  for (const int c : touching_) {
    with_rates = with_rates || rate_matters_[static_cast<std::size_t>(c)] != 0;
  }
  const double h = size(rung_);
  double before = std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    evaluate_nodes(with_rates);
    double change = 0.0, largest = 0.0, effect = 0.0;
    for (const int c : touching_) {
      const auto i = static_cast<std::size_t>(c);
      for (int k = 0; k < nodes_; ++k) {
        node_forces_.row(k) =
            node_force(c, from.contacts[i], at_[i].data() + k, nodes_).transpose();
      }
      Eigen::Map<Mat> a(a_.data() + 2 * c * terms, terms, 2);
      Eigen::Matrix<double, terms, 2> next;
      next.noalias() = project_.lazyProduct(node_forces_);
      const double size_of_change = (next - a).cwiseAbs().maxCoeff();
      change = std::max(change, size_of_change);
      effect = std::max(effect, size_of_change * weight_[i] * h / size_);
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

void ContactStep::residual(const MotionState& from, int contact, const double* dw,
                           const Vec2& force, Vec2& out) {
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
  const double mobility = size(rung_) * t.dot(c.U * (c.B * t));
  out = (f.n.dot(force) - f.normal) * f.n - (f.slip / mobility) * t;
}

void ContactStep::add_slopes(const MotionState& from, const Nodes& table, Eigen::Index p, int k,
                             const Vec2& force, const Vec2& value, Mat& J) {
  const int c = touching_[static_cast<std::size_t>(p)];
  const auto i = static_cast<std::size_t>(c);
  const auto contacts = static_cast<int>(at_.size());
  const auto m = static_cast<Eigen::Index>(touching_.size());
  double dw[rows];
  for (int d = 0; d < rows; ++d) dw[d] = at_[i](k, d);
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
          by_force(d, e) * project_.col(k) * at_nodes_.row(k);
    }
    for (Eigen::Index q = 0; q < m; ++q) {
      const int b = touching_[static_cast<std::size_t>(q)];
      const Mat& kernel = table.kernel[static_cast<std::size_t>(c * contacts + b)];
      Eigen::RowVectorXd along = Eigen::RowVectorXd::Zero(2 * terms);
      for (int e = 0; e < rows; ++e) along += by_motion(d, e) * kernel.row(e * nodes_ + k);
      J.block((2 * p + d) * terms, q * 2 * terms, terms, 2 * terms) += project_.col(k) * along;
    }
  }
}

bool ContactStep::newton(const MotionState& from) {
  const Nodes& table = nodes_of(rung_, true);
  const auto m = static_cast<Eigen::Index>(touching_.size());
  const double h = size(rung_);
  Mat J(2 * terms * m, 2 * terms * m);
  Vec r(2 * terms * m);
  std::optional<DenseLu<Mat>> lu;
  double before = std::numeric_limits<double>::infinity();
  bool has_jacobian = false;
  if (!a_.allFinite()) a_.setZero();
  for (int iteration = 0; iteration < most_newton; ++iteration) {
    evaluate_nodes(true);
    const bool renew = !has_jacobian;
    if (renew) J.setZero();
    r.setZero();
    for (Eigen::Index p = 0; p < m; ++p) {
      const int c = touching_[static_cast<std::size_t>(p)];
      const auto i = static_cast<std::size_t>(c);
      const Eigen::Map<const Mat> a(a_.data() + 2 * c * terms, terms, 2);
      for (int k = 0; k < nodes_; ++k) {
        double dw[rows];
        for (int d = 0; d < rows; ++d) dw[d] = at_[i](k, d);
        const Vec2 force = (at_nodes_.row(k) * a).transpose();
        Vec2 value;
        residual(from, c, dw, force, value);
        for (int d = 0; d < 2; ++d) {
          r.segment((2 * p + d) * terms, terms) += value(d) * project_.col(k);
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
      const int c = touching_[static_cast<std::size_t>(p)];
      const auto part = change.segment(2 * p * terms, 2 * terms);
      forces_of(c) -= part;
      effect = std::max(
          effect, part.cwiseAbs().maxCoeff() * weight_[static_cast<std::size_t>(c)] * h / size_);
    }
    if (size_of_change <= rounding_of_forces * a_.cwiseAbs().maxCoeff() || effect <= 1e-3)
      return true;
    if (size_of_change > 0.1 * before) has_jacobian = false;
    before = size_of_change;
  }
  return false;
}

void ContactStep::estimate() {
  // the first coefficient that is left out, from the fall of the last ones
  for (const int c : touching_) {
    const Eigen::Map<const Mat> a(a_.data() + 2 * c * terms, terms, 2);
    const double last =
        std::max(a.row(terms - 1).norm(),
                 0.5 * a.row(terms - 2).norm() * a.row(terms - 2).norm() / a.row(terms - 4).norm());
    const double fall =
        std::sqrt(std::min(1.0, (a.row(terms - 1).norm() + a.row(terms - 2).norm()) /
                                    (a.row(terms - 3).norm() + a.row(terms - 4).norm())));
    error_ = std::max(error_, weight_[static_cast<std::size_t>(c)] * size(rung_) * last / size_ *
                                  (std::isfinite(fall) ? fall : 1.0));
  }
}

void ContactStep::advance(double fraction, const MotionState& from, Vec& y) {
  y = from.y;
  nodes_of(rung_, !touching_.empty());
  families_[static_cast<std::size_t>(rung_.family())]->flow.advance(rung_.level(), fraction, load_,
                                                                    a_, touching_, y);
}

}  // namespace whirl::inline dyn

#include "libdyn/flow/linear_flow.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int series_terms = 13;  ///< (1/4)^14 / 14! is below rounding

}  // namespace

Eigen::Vector3d load_at(double phase) {
  return {1.0, std::cos(phase), std::sin(phase)};
}

double balanced_norm(Mat A) {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const double own = std::abs(A(i, i));
      const double column = A.col(i).cwiseAbs().sum() - own, row = A.row(i).cwiseAbs().sum() - own;
      if (!(column > 0.0) || !(row > 0.0)) continue;
      const double f = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (column * f + row / f >= 0.95 * (column + row)) continue;
      A.col(i) *= f;
      A.row(i) /= f;
      has_changed = true;
    }
  }
  return A.cwiseAbs().colwise().sum().maxCoeff();
}

Mat first_order_matrix(const ContactSystem& system) {
  return system.layout().first_order(system.K(), system.D());
}

double contact_gain(const ReducedContact& contact) {
  const auto gain = [](const Mat& G) {
    return std::sqrt(symmetric_modes(G.transpose() * G).values(1));
  };
  const double normal = gain(contact.U * contact.B);
  return contact.rubs_apart() ? std::max(normal, gain(contact.V * contact.B_t)) : normal;
}

double contact_frequency(const ContactSystem& system) {
  double sum = 0.0;
  for (const ReducedContact& c : system.contacts()) {
    const double depth = 0.01 * c.clearance;
    const double k = (normal_force(c.law, depth, 0.0) - normal_force(c.law, 0.0, 0.0)) / depth;
    sum += k * contact_gain(c);
  }
  return std::sqrt(sum);
}

double fastest_mode(const ContactSystem& system) {
  return eigenvalues(first_order_matrix(system)).cwiseAbs().maxCoeff();
}

LinearFlow::LinearFlow(const ContactSystem& system, double longest, int terms)
    : layout_(system.layout()),
      terms_(terms),
      contacts_(static_cast<int>(system.contacts().size())),
      longest_(longest),
      rate_(system.phase_rate()),
      A_(first_order_matrix(system)),
      F_(Mat::Zero(layout_.size(), 3)),
      B_(Mat::Zero(layout_.size(), 2 * contacts_)),
      rule_(gauss_rule(terms)),
      first_half_(restriction(0.0, 0.5, rule_)),
      second_half_(restriction(0.5, 1.0, rule_)),
      to_powers_(legendre_to_powers(terms)),
      tables_(levels),
      work_(layout_.size()),
      term_(layout_.size()),
      a_(2 * contacts_ * terms),
      whole_(a_) {
  norm_ = std::max(balanced_norm(A_), rate_);
  if (!is_small(levels - 1)) {
    throw NumericalError(fmt::format(
        "the linear motion of the rotor has rates of {:.3g} 1/s, and {:.3g} s are to be computed "
        "at once: more than 2^{} times as long; is the speed too low, or a stiffness or damping "
        "too high?",
        norm_, longest, levels));
  }
  layout_.rate(F_) << system.constant_load(), system.synchronous_load().cosine,
      system.synchronous_load().sine;
  for (int c = 0; c < contacts_; ++c) {
    layout_.rate(B_).middleCols(2 * c, 2) = system.contacts()[static_cast<std::size_t>(c)].B;
  }
  W_ << 0.0, 0.0, 0.0, 0.0, 0.0, -rate_, 0.0, rate_, 0.0;
}

double LinearFlow::size(int level) const {
  return std::ldexp(longest_, -level);
}

Eigen::Matrix3d LinearFlow::rotation(double t) const {
  const double c = std::cos(rate_ * t), s = std::sin(rate_ * t);
  Eigen::Matrix3d R;
  R << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  return R;
}

const LinearFlow::Table& LinearFlow::table(int level) {
  Table& t = tables_[static_cast<std::size_t>(level)];
  if (t.h > 0.0) return t;
  t.h = size(level);
  t.R = rotation(t.h);
  is_small(level) ? build_by_series(t) : build_by_doubling(t, table(level + 1));
  return t;
}

void LinearFlow::build_by_series(Table& t) const {
  const double h = t.h;
  t.X = Mat::Zero(layout_.size(), layout_.size());
  t.L = Mat::Zero(layout_.size(), 3);
  // of powers (r / h)^k: integral of e^(A (h-r)) B (r/h)^k dr = sum A^m B h^(m+1) k! / (k+m+1)!
  Mat G = Mat::Zero(layout_.size(), 2 * contacts_ * terms_);
  Mat power = Mat::Identity(layout_.size(), layout_.size());  // (A h)^m / m!
  Mat load = Mat::Zero(layout_.size(), 3);                    // h^m / m! sum A^(m-1-j) F W^j
  for (int m = 0; m <= series_terms; ++m) {
    const Mat pushed = power * B_;
    double factor = h;  // h m! k! / (k + m + 1)!
    for (int i = 1; i <= m + 1; ++i) factor /= i;
    for (int i = 1; i <= m; ++i) factor *= i;
    for (int k = 0; k < terms_; ++k) {
      if (k > 0) factor *= static_cast<double>(k) / (k + m + 1);
      for (int b = 0; b < 2 * contacts_; ++b) {
        G.col(b * terms_ + k) -= factor * pushed.col(b);
      }
    }
    load = (h / (m + 1) * (power * F_ + load * W_)).eval();
    t.L += load;
    power = (h / (m + 1) * (A_ * power)).eval();
    t.X += power;
  }
  t.G.resize(G.rows(), G.cols());
  for (int b = 0; b < 2 * contacts_; ++b) {
    t.G.middleCols(b * terms_, terms_) = G.middleCols(b * terms_, terms_) * to_powers_;
  }
}

void LinearFlow::build_by_doubling(Table& t, const Table& half) const {
  t.X = 2.0 * half.X + half.X * half.X;
  t.L = half.L + half.X * half.L + half.L * half.R;
  const Mat later = half.G + half.X * half.G;
  t.G.resize(half.G.rows(), half.G.cols());
  for (int b = 0; b < 2 * contacts_; ++b) {
    t.G.middleCols(b * terms_, terms_) = later.middleCols(b * terms_, terms_) * first_half_ +
                                         half.G.middleCols(b * terms_, terms_) * second_half_;
  }
}

void LinearFlow::restrict_to_half(bool second, std::span<const int> touching, Vec& a) const {
  const Mat& Q = second ? second_half_ : first_half_;
  for (const int c : touching) {
    for (int b = 2 * c; b < 2 * c + 2; ++b) {
      double* p = a.data() + b * terms_;
      for (int j = 0; j < terms_; ++j) {  // upper triangular: entry j needs entries j and beyond
        double sum = 0.0;
        for (int k = j; k < terms_; ++k) sum += Q(j, k) * p[k];
        p[j] = sum;
      }
    }
  }
}

void LinearFlow::advance(int level, double fraction, const Eigen::Vector3d& load_before,
                         const Vec& a_whole, std::span<const int> touching, Vec& y) {
  Eigen::Vector3d load = load_before;
  if (!touching.empty()) a_ = a_whole;
  const auto apply = [&](const Table& t) {
    work_.noalias() = t.X * y;
    work_.noalias() += t.L * load;
    for (const int c : touching) {
      work_.noalias() +=
          t.G.middleCols(2 * c * terms_, 2 * terms_) * a_.segment(2 * c * terms_, 2 * terms_);
    }
    y += work_;
    load = (t.R * load).eval();
  };
  if (fraction >= 1.0) return apply(table(level));
  int k = level;
  double f = fraction;
  for (; f > 0.0 && !is_small(k); f *= 2.0) {
    ++k;
    const bool takes_half = 2.0 * f >= 1.0;
    if (takes_half) {
      if (!touching.empty()) whole_ = a_;
      restrict_to_half(false, touching, a_);
      apply(table(k));
      if (!touching.empty()) a_ = whole_;
      f -= 0.5;
    }
    restrict_to_half(takes_half, touching, a_);
  }
  if (f == 0.0) return;

  // the rest by its Taylor series in s = t / d
  const double d = f * size(k);
  auto rate = layout_.rate(work_);
  term_ = y;
  Eigen::Vector3d load_term = load;
  double scale = 1.0;
  for (int m = 0; m <= series_terms; ++m) {
    layout_.eta(work_) = layout_.rate(term_);
    rate.noalias() = layout_.rate(A_) * term_;
    rate.noalias() += layout_.rate(F_) * load_term;
    if (m < terms_) {
      for (const int c : touching) {
        for (int b = 2 * c; b < 2 * c + 2; ++b) {
          const double power = to_powers_.row(m).dot(a_.segment(b * terms_, terms_)) * scale;
          rate -= power * layout_.rate(B_).col(b);
        }
      }
      scale *= f;
    }
    term_ = work_ * (d / (m + 1));
    load_term = (W_ * load_term * (d / (m + 1))).eval();
    y += term_;
  }
}

LinearFlow::Rows LinearFlow::rows_by_series(double d, const Mat& r, int columns) const {
  Mat power = r;  // r (A d)^m / m!
  Mat load = Mat::Zero(r.rows(), 3);
  Rows sum{r, load, Mat::Zero(r.rows(), columns * terms_)};
  for (int m = 0; m <= series_terms; ++m) {
    const Mat pushed = power * B_.leftCols(columns);
    double factor = d;
    for (int i = 1; i <= m + 1; ++i) factor /= i;
    for (int i = 1; i <= m; ++i) factor *= i;
    for (int j = 0; j < terms_; ++j) {
      if (j > 0) factor *= static_cast<double>(j) / (j + m + 1);
      for (int b = 0; b < columns; ++b) {
        sum.force.col(b * terms_ + j) -= factor * pushed.col(b);
      }
    }
    load = (d / (m + 1) * (power * F_ + load * W_)).eval();
    sum.load += load;
    power = (d / (m + 1) * (power * A_)).eval();
    sum.y += power;
  }
  return sum;
}

LinearFlow::Rows LinearFlow::rows(int level, double fraction, const Mat& r, Forces forces) {
  // the same pieces as advance(), walked from the last to the first
  struct Piece {
    int level;
    double from, to;
  };
  std::vector<Piece> pieces;
  double at = 0.0, width = 1.0;
  int k = level;
  if (fraction >= 1.0) {
    pieces.push_back({level, 0.0, 1.0});
    at = 1.0;
  } else {
    while (!is_small(k)) {
      ++k;
      width *= 0.5;
      if (at + width > fraction) continue;
      pieces.push_back({k, at, at + width});
      at += width;
    }
  }
  const int columns = forces == Forces::all ? 2 * contacts_ : 0;
  Rows out{r, Mat::Zero(r.rows(), 3), Mat::Zero(r.rows(), columns * terms_)};
  const auto add_force = [&](const Mat& force, const Mat& part) {
    for (int b = 0; b < columns; ++b) {
      out.force.middleCols(b * terms_, terms_) += force.middleCols(b * terms_, terms_) * part;
    }
  };
  const double h = size(level), d = (fraction - at) * h;
  if (d > 0.0) {
    const Rows rest = rows_by_series(d, r, columns);
    out.y = rest.y;
    out.load = rest.load * rotation(at * h);
    if (columns > 0) add_force(rest.force, to_powers_ * restriction(at, fraction, rule_));
  }
  for (auto p = pieces.rbegin(); p != pieces.rend(); ++p) {
    const Table& t = table(p->level);
    out.load += out.y * t.L * rotation(p->from * h);
    if (columns > 0) add_force(out.y * t.G, restriction(p->from, p->to, rule_));
    out.y += (out.y * t.X).eval();
  }
  return out;
}

}  // namespace whirl::inline dyn

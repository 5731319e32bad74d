#include "libdyn/branches/torus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/newton.hpp"
#include "libbase/numerics/roots.hpp"
#include "libbase/numerics/smooth_average.hpp"
#include "libbase/system/memory.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double broken = 1e-2;     ///< tail beyond which there is no circle
constexpr int iterations = 4000;    ///< of tangents, for exponents
constexpr int parts = 6;            ///< of the strongest line that are tried as the circle's own
constexpr int tested = 16;          ///< harmonics by which they are compared
constexpr double all_told = 1e-4;   ///< of the energy, that may be left without a search
constexpr double much_less = 0.25;  ///< energy left, for a part to be taken
constexpr Eigen::Index scanned_sections =
    1024;                               ///< sections in which a line is looked for at first
constexpr double sharpest_line = 1e-9;  ///< share of a line's width, to which it is found
constexpr double moves = 1e-9;          ///< scales that a motion moves at least
constexpr double matrices = 3.0;        ///< of Newton's method at once: one, its factors, the next

/// Shift of a trigonometric polynomial by its values at N even angles: the value at theta + angle
/// is the sum of D(theta_i - theta_j + angle) x_j with Dirichlet's kernel D; and its derivative.
struct Shift {
  Mat value, rate;
  Shift(Eigen::Index N, double angle) : value(N, N), rate(N, N) {
    const Eigen::Index K = (N - 1) / 2;
    for (Eigen::Index d = 0; d < N; ++d) {
      const double t = turn * static_cast<double>(d) / static_cast<double>(N) + angle;
      double v = 1.0, r = 0.0;
      for (Eigen::Index k = 1; k <= K; ++k) {
        const double a = static_cast<double>(k);
        v += 2.0 * std::cos(a * t);
        r -= 2.0 * a * std::sin(a * t);
      }
      for (Eigen::Index j = 0; j < N; ++j) {
        value((j + d) % N, j) = v / static_cast<double>(N);
        rate((j + d) % N, j) = r / static_cast<double>(N);
      }
    }
  }
};

/// Coefficients of harmonics 0 to K of values at even angles, a column each.
CMat harmonics_of(const Mat& points) {
  const Eigen::Index N = points.cols(), K = (N - 1) / 2;
  CMat c = CMat::Zero(points.rows(), K + 1);
  for (Eigen::Index k = 0; k <= K; ++k) {
    for (Eigen::Index j = 0; j < N; ++j) {
      const auto place = static_cast<double>(k * j % N);
      c.col(k) += points.col(j) *
                  std::polar(1.0 / static_cast<double>(N), -turn * place / static_cast<double>(N));
    }
  }
  return c;
}

double tail_of(const Mat& scaled_points) {
  const CMat c = harmonics_of(scaled_points);
  const Eigen::Index K = c.cols() - 1, some = std::max<Eigen::Index>(1, K / 8);
  double largest = 0.0, last = 0.0;
  for (Eigen::Index k = 1; k <= K; ++k) {
    const double size = c.col(k).norm();
    largest = std::max(largest, size);
    if (k > K - some) last = std::max(last, size);
  }
  return largest > 0.0 ? last / largest : 0.0;
}

/// The matrix of an angle by its values at even ones.
Mat tangent_at(const std::vector<Mat>& tangents, double theta) {
  const auto N = std::ssize(tangents);
  const Eigen::Index K = (N - 1) / 2;
  Mat A = Mat::Zero(tangents[0].rows(), tangents[0].cols());
  for (std::ptrdiff_t j = 0; j < N; ++j) {
    const double t = theta - turn * static_cast<double>(j) / static_cast<double>(N);
    const double half = std::sin(0.5 * t);
    const double kernel = std::abs(half) < 1e-12
                              ? static_cast<double>(N)
                              : std::sin((static_cast<double>(K) + 0.5) * t) / half;
    A += kernel / static_cast<double>(N) * tangents[static_cast<std::size_t>(j)];
  }
  return A;
}

/// Exponents of tangents along a circle, all of them, descending: smooth averages of the growth of
/// orthogonal directions, which converge faster than any power where the motion is quasi-periodic.
Vec exponents_of(const std::vector<Mat>& tangents, double rotation) {
  const Eigen::Index n = tangents[0].rows();
  constexpr int settling = iterations / 4;
  const Vec weights = smooth_weights(iterations);
  Mat Q = Mat::Identity(n, n);
  Vec sum = Vec::Zero(n);
  for (int i = -settling; i < iterations; ++i) {
    const double cycles = rotation * i;
    Q = tangent_at(tangents, turn * (cycles - std::floor(cycles))) * Q;
    for (Eigen::Index a = 0; a < n; ++a) {  // modified Gram-Schmidt
      for (Eigen::Index b = 0; b < a; ++b) Q.col(a) -= Q.col(b).dot(Q.col(a)) * Q.col(b);
      const double size = Q.col(a).norm();
      Q.col(a) /= size;
      if (i >= 0) sum(a) += weights(i) * std::log(size);
    }
  }
  std::sort(sum.begin(), sum.end(), std::greater<>());
  return sum;
}

/// Exponents without the one nearest to zero, and that one.
std::pair<Vec, double> across(const Vec& all) {
  Eigen::Index along = 0;
  all.cwiseAbs().minCoeff(&along);
  Vec others(all.size() - 1);
  others << all.head(along), all.tail(all.size() - along - 1);
  return {others, all(along)};
}

/// Sections of a motion about their mean, a state per column, seen by their lines: frequencies
/// [cycles a section]. The first `used` of them are looked at.
class Lines {
 public:
  Lines(const Mat& sections, Eigen::Index most, Eigen::Index used)
      : sections_(sections), row_(sections.row(most)) {
    use(used);
  }
  void use(Eigen::Index used) { weights_ = smooth_weights(used); }
  Eigen::Index used() const { return weights_.size(); }
  double width() const { return 0.5 / static_cast<double>(used()); }

  /// Complex amplitude of a line.
  CVec operator()(double cycles) const { return average(sections_, cycles); }
  /// Its size in the coordinate that moves most.
  double size(double cycles) const { return std::abs(average(row_, cycles)(0)); }
  double energy() const {
    double whole = 0.0;
    for (Eigen::Index i = 0; i < used(); ++i) {
      whole += weights_(i) * sections_.col(i).squaredNorm();
    }
    return whole;
  }
  /// Energy that the harmonics of a line leave.
  double left(double cycles) const {
    double energy_left = energy();
    for (int k = 1; k <= tested; ++k) energy_left -= 2.0 * (*this)(k * cycles).squaredNorm();
    return std::abs(energy_left);
  }
  /// The strongest on a grid that none falls through.
  double strongest() const {
    double best = width(), largest = 0.0;
    for (double cycles = width(); cycles < 0.5; cycles += width()) {
      if (const double s = size(cycles); s > largest) {
        best = cycles;
        largest = s;
      }
    }
    return best;
  }
  /// A line by its harmonic `part`, which is strong.
  double sharpened(double line, int part) const {
    return bracketed_maximum([&](double cycles) { return size(part * cycles); }, line - width(),
                             line, line + width(), sharpest_line * width())
        .at;
  }

 private:
  CVec average(const Mat& rows, double cycles) const {
    CVec sum = CVec::Zero(rows.rows());
    for (Eigen::Index i = 0; i < used(); ++i) {
      const double place = cycles * static_cast<double>(i);
      sum += rows.col(i) * std::polar(weights_(i), -turn * (place - std::floor(place)));
    }
    return sum;
  }
  const Mat& sections_;
  Mat row_;
  Vec weights_;
};

/// A line of which the strongest one is a harmonic, and which: itself, or a part of it whose
/// harmonics leave much less.
std::pair<double, int> own_line(const Lines& lines, double strongest) {
  std::pair<double, int> found{strongest, 1};
  const double all = all_told * lines.energy();
  double least = lines.left(strongest);
  for (int k = 2; k <= parts && least > all; ++k) {
    for (int turns = 0; turns < k; ++turns) {
      const double cycles = (strongest + turns) / k, energy = lines.left(cycles);
      if (energy > much_less * least) continue;
      found = {cycles, k};
      least = energy;
    }
  }
  return found;
}

/// The equations of a circle for its unknowns x, and the tangents at its points.
struct Turned {
  BranchEquations::Value value;
  std::vector<Mat> tangents{};
  Vec x{};
  double residual = std::numeric_limits<double>::infinity();
};
Turned turned(const Flow& flow, const Vec& scale, const Vec& x, int period, Eigen::Index coordinate,
              WithTangent wanted, double most_tail) {
  const Eigen::Index n = scale.size(), size = x.size() - 1, N = size / n;
  const Mat scaled = x.head(size).reshaped(n, N);
  if (const double tail = tail_of(scaled); tail > most_tail) {
    return Turned{
        {.failure = fmt::format("the highest harmonics are {:.0e} of the largest: the circle "
                                "breaks up or locks",
                                tail)}};
  }
  std::vector<Vec> starts;
  for (Eigen::Index j = 0; j < N; ++j) starts.push_back(scale.cwiseProduct(scaled.col(j)));
  const std::vector<FlowResult> passages = flow.go(starts, period, wanted);
  Mat ends(n, N);
  Turned at;
  for (Eigen::Index j = 0; j < N; ++j) {
    const FlowResult& p = passages[static_cast<std::size_t>(j)];
    if (p.failure) return Turned{{.failure = p.failure}};
    ends.col(j) = p.end.cwiseQuotient(scale);
    if (wanted == WithTangent::no) continue;
    at.tangents.push_back(scale.cwiseInverse().asDiagonal() * p.tangent * scale.asDiagonal());
  }
  const Shift shift(N, turn * x(size));
  at.value.residual.resize(size + 1);
  at.value.residual.head(size) = (ends - scaled * shift.value.transpose()).reshaped();
  const CVec c = harmonics_of(scaled.row(coordinate)).row(0);
  at.value.residual(size) = c(1).imag();
  at.x = x;
  at.residual = at.value.residual.lpNorm<Eigen::Infinity>();
  if (wanted == WithTangent::no) return at;
  at.value.jacobian = Mat::Zero(size + 1, size + 1);
  for (Eigen::Index i = 0; i < N; ++i) {
    at.value.jacobian.block(i * n, i * n, n, n) = at.tangents[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < N; ++j) {
      at.value.jacobian.block(i * n, j * n, n, n).diagonal().array() -= shift.value(i, j);
    }
    at.value.jacobian(size, i * n + coordinate) =
        -std::sin(turn * static_cast<double>(i) / static_cast<double>(N)) / static_cast<double>(N);
  }
  at.value.jacobian.col(size).head(size) = -turn * (scaled * shift.rate.transpose()).reshaped();
  return at;
}

/// Memory of Newton's method for a circle.
double bytes_of(Eigen::Index states, int harmonics) {
  const double unknowns = static_cast<double>(states) * (2.0 * harmonics + 1.0) + 1.0;
  return matrices * sizeof(double) * unknowns * unknowns;
}

}  // namespace

Vec circle_unknowns(const InvariantCircle& circle, const Vec& scale) {
  const Mat scaled = scale.cwiseInverse().asDiagonal() * circle.points;
  Vec x(scaled.size() + 1);
  x << scaled.reshaped(), circle.rotation;
  return x;
}

InvariantCircle circle_of(const Vec& unknowns, const Vec& scale, int period) {
  const Eigen::Index n = scale.size();
  const Mat scaled = unknowns.head(unknowns.size() - 1).reshaped(n, (unknowns.size() - 1) / n);
  return {.points = scale.asDiagonal() * scaled,
          .rotation = unknowns(unknowns.size() - 1),
          .period = period,
          .tail = tail_of(scaled)};
}

BranchEquations circle_equations(FlowAt flow_at, Vec scale, int period, Eigen::Index coordinate) {
  return {[=, flow_at = std::move(flow_at)](const Vec& x, double value, WithTangent wanted) {
    Turned at = turned(flow_at(value), scale, x, period, coordinate, wanted, broken);
    at.value.multipliers = [tangents = std::move(at.tangents),
                            rotation = x(x.size() - 1)]() -> CVec {
      return across(exponents_of(tangents, rotation)).first.array().exp().cast<Complex>();
    };
    return std::move(at.value);
  }};
}

std::optional<InvariantCircle> guessed_circle(const Mat& sections, const Vec& scale, int period,
                                              int harmonics) {
  const Eigen::Index count = sections.cols();
  if (count < 200) throw OptionError("a circle needs 200 sections or more");
  const Mat scaled = scale.cwiseInverse().asDiagonal() * sections;
  const Vec mean = scaled * smooth_weights(count);
  const Mat moving = scaled.colwise() - mean;
  Eigen::Index most = 0;
  if (moving.rowwise().squaredNorm().maxCoeff(&most) < moves * moves * static_cast<double>(count)) {
    return std::nullopt;
  }
  // among more and more sections, as lines are sharper there
  Lines lines(moving, most, std::min<Eigen::Index>(count, scanned_sections));
  auto [best, part] = own_line(lines, lines.sharpened(lines.strongest(), 1));
  for (;; lines.use(std::min(2 * lines.used(), count))) {
    best = lines.sharpened(best, part);
    if (lines.used() == count) break;
  }
  InvariantCircle circle{.rotation = best, .period = period};
  const Eigen::Index N = 2 * harmonics + 1;
  circle.points = scale.cwiseProduct(mean).replicate(1, N);
  for (int k = 1; k <= harmonics; ++k) {
    const CVec c = lines(k * circle.rotation);
    for (Eigen::Index j = 0; j < N; ++j) {
      const double angle = turn * static_cast<double>(k * j % N) / static_cast<double>(N);
      circle.points.col(j) += scale.cwiseProduct((2.0 * c * std::polar(1.0, angle)).real());
    }
  }
  return circle;
}

InvariantCircle find_circle(const Flow& flow, const InvariantCircle& guess,
                            const CircleOptions& options) {
  const Vec& scale = flow.scale;
  InvariantCircle circle = guess;
  require_memory(
      "harmonics", bytes_of(scale.size(), options.harmonics),
      fmt::format("a circle with {} harmonics of {} states", options.harmonics, scale.size()),
      "reduce the rotor to fewer coordinates");
  for (int K = options.harmonics;; K *= 2) {
    Eigen::Index coordinate = 0;  // that which moves most
    harmonics_of(scale.cwiseInverse().asDiagonal() * circle.points)
        .col(1)
        .cwiseAbs()
        .maxCoeff(&coordinate);
    // the same polynomial at more angles, begun where the first harmonic is real
    const Eigen::Index N = 2 * K + 1;
    const CMat c = harmonics_of(circle.points);
    const double begin = -std::arg(c(coordinate, 1));
    Mat points = c.col(0).real().replicate(1, N);
    for (Eigen::Index k = 1; k < std::min<Eigen::Index>(c.cols(), K + 1); ++k) {
      for (Eigen::Index j = 0; j < N; ++j) {
        const double theta = turn * static_cast<double>(j) / static_cast<double>(N) + begin;
        points.col(j) += (2.0 * c.col(k) * std::polar(1.0, static_cast<double>(k) * theta)).real();
      }
    }
    circle.points = points;
    const auto at_unknowns = [&](const Vec& x) {
      return turned(flow, scale, x, options.period, coordinate, WithTangent::yes, 1.0);
    };
    Turned at = at_unknowns(circle_unknowns(circle, scale));
    const NewtonSearch search = newton(
        at, [](const Turned& t) { return newton_step(t.value.jacobian, t.value.residual); },
        [&](const Turned& t, const Vec& step) { return at_unknowns(t.x - step); },
        {.most_steps = options.most_steps, .largest_growth = 1e3});
    if (search.end == NewtonEnd::undefined) {
      circle.failure = at.value.failure;
      return circle;
    }
    circle = circle_of(at.x, scale, options.period);
    circle.coordinate = coordinate;
    circle.residual = at.residual;
    if (!search.has_converged()) {
      circle.failure = search.failure("no circle", "its equations are singular");
      return circle;
    }
    std::tie(circle.exponents, circle.along) = across(exponents_of(at.tangents, circle.rotation));
    const bool fits = bytes_of(scale.size(), 2 * K) < least_of(memory_limits());
    if (circle.tail < options.smooth || 2 * K > options.most_harmonics || !fits) {
      if (circle.tail > broken) {
        circle.failure = fmt::format(
            "no circle: the highest of {} harmonics are {:.0e} of the largest", K, circle.tail);
      }
      return circle;
    }
  }
}

}  // namespace whirl::inline dyn

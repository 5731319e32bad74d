#include "libfe/analyses/response_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"
#include "libfe/analyses/campbell.hpp"

namespace whirl::inline fe {

namespace {

constexpr double visible_peak =
    1e-3;                        ///< of a point's largest motion: below, its phase is not looked at
constexpr double finest = 1e-8;  ///< relative distance of speeds; a sharper turn has no damping
constexpr double tolerance = 1e-10;  ///< of peaks and their sides, relative
constexpr double flat_peak = 1e-9;   ///< relative height of a peak that may be rounding
constexpr double beside_resonance =
    1e-3;  ///< relative distance around an undamped resonance that is left out
constexpr int campbell_steps = 20;  ///< along which modes are followed
constexpr int first_modes = 8;      ///< looked at, before more are needed

using Samples = std::map<double, CVec>;  ///< x of all points, then y

double major(const CVec& u, Eigen::Index p) {
  return Orbit(u(p), u(p + u.size() / 2)).major();
}

class CurveBuilder {
 public:
  CurveBuilder(const Assembler& assembler, const std::vector<Point>& points,
               const ResponseCurveOptions& options)
      : solver_(options.load ? UnbalanceSolver(assembler, *options.load)
                             : UnbalanceSolver(assembler)),
        points_(points),
        options_(options) {}

  /// A sample at a speed; false where the response is unbounded.
  bool add(double Omega) {
    const auto next = samples_.lower_bound(Omega * (1.0 - same_speed));
    if (next != samples_.end() && next->first <= Omega * (1.0 + same_speed)) return true;
    const auto u = at(Omega);
    if (!u) return false;
    largest_ = largest_.size() == 0 ? Vec(u->cwiseAbs()) : Vec(largest_.cwiseMax(u->cwiseAbs()));
    samples_.emplace(Omega, *u);
    return true;
  }

  /// Tells of a mode without damping, whose resonance no speed comes near enough to.
  void expect_unbounded(double Omega) { undamped_.push_back(Omega); }

  /// Adds speeds until no phase turns by more than the step between neighbors.
  void smooth() {
    std::vector<double> speeds;
    for (const auto& [Omega, u] : samples_) speeds.push_back(Omega);
    for (std::size_t i = 0; i + 1 < speeds.size(); ++i) divide(speeds[i], speeds[i + 1]);
  }

  /// Removes the samples that were added beside undamped resonances, which tell nothing.
  void thin_out(const std::vector<double>& keep) {
    for (const double Omega : unbounded_) {
      for (auto s = samples_.lower_bound((1.0 - beside_resonance) * Omega);
           s != samples_.end() && s->first < (1.0 + beside_resonance) * Omega;) {
        const bool stays = std::binary_search(keep.begin(), keep.end(), s->first);
        s = stays ? std::next(s) : samples_.erase(s);
      }
    }
  }

  std::vector<ResponsePeak> peaks() {
    std::vector<double> speeds;
    std::vector<double> largest;
    std::vector<Eigen::Index> row;
    for (const auto& [Omega, u] : samples_) {
      speeds.push_back(Omega);
      row.push_back(0);
      for (Eigen::Index p = 0; p < count(); ++p) {
        if (major(u, p) > major(u, row.back())) row.back() = p;
      }
      largest.push_back(count() > 0 ? major(u, row.back()) : 0.0);
    }
    std::vector<ResponsePeak> found;
    for (std::size_t k = 1; k + 1 < speeds.size(); ++k) {
      if (!(largest[k] > largest[k - 1] && largest[k] >= largest[k + 1])) continue;
      if (has_unbounded(speeds[k - 1], speeds[k + 1])) continue;
      const ResponsePeak peak = refined(speeds, k, row[k]);
      if (peak.amplitude > (1.0 + flat_peak) * std::max(largest[k - 1], largest[k + 1]))
        found.push_back(peak);
    }
    found = highest_peaks(std::move(found), options_.most_peaks);
    for (const ResponsePeak& peak : found) {
      for (const double Omega : {peak.below, peak.speed, peak.above}) {
        if (std::isfinite(Omega)) add(Omega);
      }
    }
    return found;
  }

  const std::vector<double>& unbounded() const { return unbounded_; }

  UnbalanceResponse response() const {
    const auto n = static_cast<Eigen::Index>(samples_.size());
    UnbalanceResponse response{{}, points_, CMat(count(), n), CMat(count(), n), {}, {}};
    Eigen::Index s = 0;
    for (const auto& [Omega, u] : samples_) {
      response.speeds.push_back(Omega);
      response.x.col(s) = u.head(count());
      response.y.col(s++) = u.tail(count());
    }
    return response;
  }

 private:
  Eigen::Index count() const { return static_cast<Eigen::Index>(points_.size()); }

  std::optional<CVec> at(double Omega) { return solver_.at(Omega, points_); }

  double amplitude(double Omega, Eigen::Index p) {
    const auto u = at(Omega);
    return u ? major(*u, p) : std::numeric_limits<double>::infinity();
  }

  bool turns(const CVec& a, const CVec& b) const {
    for (Eigen::Index i = 0; i < a.size(); ++i) {
      if (std::max(std::abs(a(i)), std::abs(b(i))) < visible_peak * largest_(i)) continue;
      if (a(i) == 0.0 || b(i) == 0.0) continue;
      if (std::abs(std::arg(b(i) / a(i))) > options_.phase_step * degree) return true;
    }
    return false;
  }

  void divide(double low, double high) {
    if (samples_.size() >= options_.most || !turns(samples_.at(low), samples_.at(high))) return;
    const double middle = 0.5 * (low + high);
    if (high - low < beside_resonance * high) {
      const auto undamped = std::find_if(undamped_.begin(), undamped_.end(), [&](double Omega) {
        return low <= Omega && Omega <= high;
      });
      if (undamped != undamped_.end()) return add_unbounded(*undamped);
    }
    if (high - low < finest * high || !add(middle)) return add_unbounded(middle);
    divide(low, middle);
    divide(middle, high);
  }

  void add_unbounded(double Omega) {
    const bool is_known = std::any_of(unbounded_.begin(), unbounded_.end(), [&](double u) {
      return std::abs(u - Omega) < beside_resonance * u;
    });
    if (!is_known) unbounded_.push_back(Omega);
  }

  bool has_unbounded(double low, double high) const {
    return std::any_of(unbounded_.begin(), unbounded_.end(),
                       [&](double u) { return low <= u && u <= high; });
  }

  /// The peak around the sample number k of a point.
  ResponsePeak refined(const std::vector<double>& speeds, std::size_t k, Eigen::Index p) {
    ResponsePeak peak =
        refined_peak([&](double Omega) { return amplitude(Omega, p); }, speeds,
                     [&](std::size_t i) { return major(samples_.at(speeds[i]), p); }, k);
    peak.row = p;
    return peak;
  }

  UnbalanceSolver solver_;
  const std::vector<Point>& points_;
  const ResponseCurveOptions& options_;
  Samples samples_;
  Vec largest_;  ///< magnitudes of the entries of samples
  std::vector<double> undamped_, unbounded_;
};

/// How many of the lowest modes may come below the line frequency = speed up to a speed. Of two
/// modes that are one pair at rest the forward one may never do, so that twice as many are
/// followed.
int modes_to_follow(const Assembler& assembler, double last, double order) {
  const ModeFinder finder(assembler);
  for (int count = first_modes;; count *= 2) {
    const Modes modes = finder.at(last, count);
    const auto below = std::count_if(modes.oscillatory.begin(), modes.oscillatory.end(),
                                     [&](const Mode& m) { return m.frequency() <= order * last; });
    if (below < count) return 2 * static_cast<int>(below) + 2;
  }
}

}  // namespace

ResponsePeak refined_peak(const SizeAt& size_at, const std::vector<double>& speeds,
                          const std::function<double(std::size_t i)>& known, std::size_t k) {
  const Maximum top =
      bracketed_maximum(size_at, speeds[k - 1], speeds[k], speeds[k + 1], tolerance * speeds[k]);
  ResponsePeak peak{.speed = top.at, .amplitude = top.value, .below = nan, .above = nan};
  const double half_power = top.value / std::numbers::sqrt2;
  const auto gap = [&](double Omega) { return size_at(Omega) - half_power; };
  double inner = top.at;
  for (std::size_t i = k; i-- > 0; inner = speeds[i]) {
    if (known(i) > half_power) continue;
    peak.below = bracketed_root(gap, speeds[i], inner, tolerance * top.at);
    break;
  }
  inner = top.at;
  for (std::size_t i = k + 1; i < speeds.size(); inner = speeds[i++]) {
    if (known(i) > half_power) continue;
    peak.above = bracketed_root(gap, inner, speeds[i], tolerance * top.at);
    break;
  }
  return peak;
}

std::vector<ResponsePeak> refined_peaks(const SizeAt& size_at, const ResponseCurve& curve,
                                        const Vec& sizes, std::size_t most) {
  const std::vector<double>& speeds = curve.response.speeds;
  const auto known = [&](std::size_t i) { return sizes(static_cast<Eigen::Index>(i)); };
  std::vector<ResponsePeak> found;
  for (std::size_t k = 1; k + 1 < speeds.size(); ++k) {
    if (!(known(k) > known(k - 1) && known(k) >= known(k + 1))) continue;
    const bool is_unbounded =
        std::any_of(curve.unbounded.begin(), curve.unbounded.end(),
                    [&](double u) { return speeds[k - 1] <= u && u <= speeds[k + 1]; });
    if (is_unbounded) continue;
    const ResponsePeak peak = refined_peak(size_at, speeds, known, k);
    if (peak.amplitude > (1.0 + flat_peak) * std::max(known(k - 1), known(k + 1)))
      found.push_back(peak);
  }
  return highest_peaks(std::move(found), most);
}

std::vector<LargestResponse> largest_responses(const UnbalanceResponse& response) {
  std::vector<LargestResponse> all;
  const auto n = response.x.cols();
  for (Eigen::Index p = 0; p < response.x.rows(); ++p) {
    const auto size = [&](Eigen::Index s) {
      return Orbit(response.x(p, s), response.y(p, s)).major();
    };
    Eigen::Index top = 0;
    for (Eigen::Index s = 1; s < n; ++s) {
      if (size(s) > size(top)) top = s;
    }
    if (n == 0) break;
    LargestResponse largest{response.speeds[static_cast<std::size_t>(top)], size(top)};
    if (top > 0 && top + 1 < n && size(top - 1) > 0.0 && size(top + 1) > 0.0) {
      const auto at = [&](Eigen::Index s) {
        return response.speeds[static_cast<std::size_t>(s)] - largest.speed;
      };
      const auto inverse = [&](Eigen::Index s) { return 1.0 / (size(s) * size(s)); };
      const double h0 = at(top - 1), h1 = at(top + 1), middle = inverse(top);  // h0 < 0 < h1
      const double d0 = (inverse(top - 1) - middle) / h0, d1 = (inverse(top + 1) - middle) / h1;
      const double curvature = (d1 - d0) / (h1 - h0), slope = d0 - curvature * h0;
      const double step = std::clamp(-0.5 * slope / curvature, h0, h1);
      const double lowest = middle + step * (slope + curvature * step);
      if (curvature > 0.0 && lowest > 0.0) {
        largest = {largest.speed + step, 1.0 / std::sqrt(lowest)};
      }
    }
    all.push_back(largest);
  }
  return all;
}

std::vector<Resonance> resonances_between(const Assembler& assembler, double first, double last,
                                          double order) {
  std::vector<double> speeds;
  for (int k = 0; k <= campbell_steps; ++k) {
    speeds.push_back(first + (last - first) * k / campbell_steps);
  }
  const Campbell diagram =
      campbell(assembler, speeds, modes_to_follow(assembler, last, order), order);
  std::vector<Resonance> found;
  for (const Crossing& crossing : diagram.crossings) {
    const auto after = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        std::upper_bound(speeds.begin(), speeds.end(), crossing.speed) - speeds.begin(), 1,
        std::ssize(speeds) - 1));
    const std::vector<double>& decrement =
        diagram.branches[static_cast<std::size_t>(crossing.branch)].log_decrement;
    const double share = (crossing.speed - speeds[after - 1]) / (speeds[after] - speeds[after - 1]);
    const double there = (1.0 - share) * decrement[after - 1] + share * decrement[after];
    found.push_back({crossing.speed, std::abs(there) * crossing.speed / (2.0 * std::numbers::pi)});
  }
  return found;
}

ResponseCurve response_curve(const Assembler& assembler, const std::vector<double>& at_least,
                             const std::vector<Point>& points,
                             const ResponseCurveOptions& options) {
  ResponseCurve curve;
  CurveBuilder builder(assembler, points, options);
  for (const double Omega : at_least) builder.add(Omega);
  if (at_least.size() > 1) {
    const double first = at_least.front(), last = at_least.back();
    for (int k = 1; k < options.steps; ++k) {
      builder.add(first + (last - first) * k / options.steps);
    }
    try {
      const std::vector<Resonance> resonances =
          options.resonances ? *options.resonances
                             : resonances_between(assembler, first, last,
                                                  options.load ? options.load->order : 1.0);
      for (const Resonance& r : resonances) {
        if (r.half_width < finest * r.speed) {
          builder.expect_unbounded(r.speed);
          continue;
        }
        for (const double Omega : {r.speed - r.half_width, r.speed, r.speed + r.half_width}) {
          if (Omega > first && Omega < last) builder.add(Omega);
        }
      }
    } catch (const NumericalError& error) {
      curve.failure = error.what();
    }
    builder.smooth();
    builder.thin_out(at_least);
    curve.peaks = builder.peaks();
  }
  curve.unbounded = builder.unbounded();
  curve.response = builder.response();
  return curve;
}

}  // namespace whirl::inline fe

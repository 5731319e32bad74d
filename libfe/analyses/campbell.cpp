#include "libfe/analyses/campbell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"
#include "libbase/system/memory.hpp"
#include "libfe/analyses/followed_modes.hpp"

namespace whirl::inline fe {

namespace {

constexpr double sure = 0.8;            ///< MAC from which a match needs no second look
constexpr double lost = 0.1;            ///< MAC below which modes are others
constexpr double lost_at_last = 0.3;    ///< the same at speeds as near as can be
constexpr double jump_at_last = 0.5;    ///< relative distance of eigenvalues that are others there
constexpr int deepest = 6;              ///< halvings of a speed interval
constexpr int spare_modes = 2;          ///< computed beyond those followed, for newcomers
constexpr double clear = 1e-8;          ///< real part over size from which a mode grows, or decays
constexpr double rootless = 1e-6;       ///< real part over size that is no root
constexpr double crossing_tol = 1e-10;  ///< of the speed at a crossing; eigenvalues have 1e-11

/// Shapes with their eigenvalues, in the order of the branches.
struct Front {
  double Omega = 0.0;
  std::vector<Mode> modes;
  std::vector<bool> is_alive;
  std::vector<Mode> others{};        ///< modes found that no branch is
  std::vector<Complex> eigenvalues;  ///< of all oscillatory modes found, the fastest growing first
  bool is_gap = false;  ///< nothing could be computed; the modes are those of a neighbor
};

/// Assigns modes to branches, best agreement first. Returns the poorest agreement that was used.
/// @param is_last  whether no speeds between will tell more: modes that differ much are others
double follow(const Front& from, const std::vector<Mode>& found, const Sparse& M, bool is_last,
              Front& to) {
  const std::size_t branches = from.modes.size(), candidates = found.size();
  struct Pair {
    double score, agreement;
    std::size_t branch, candidate;
  };
  std::vector<Pair> pairs;
  std::vector<double> inertia;
  for (const Mode& a : from.modes) inertia.push_back(a.shape.dot(CVec(M * a.shape)).real());
  for (std::size_t c = 0; c < candidates; ++c) {
    const Mode& z = found[c];
    const CVec Mz = M * z.shape;
    const double own = z.shape.dot(Mz).real();
    for (std::size_t b = 0; b < branches; ++b) {
      if (!from.is_alive[b]) continue;
      const Mode& a = from.modes[b];
      const double agreement = std::norm(a.shape.dot(Mz)) / (inertia[b] * own);
      const double distance = std::abs(a.lambda - z.lambda) / std::abs(a.lambda);
      if (agreement < (is_last ? lost_at_last : lost)) continue;
      if (is_last && distance > jump_at_last) continue;
      pairs.push_back({agreement - 0.2 * std::min(distance, 1.0), agreement, b, c});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.score > b.score; });
  std::vector<bool> is_taken(candidates, false);
  to.modes = from.modes;
  to.is_alive.assign(branches, false);
  double poorest = 1.0;
  for (const Pair& p : pairs) {
    if (to.is_alive[p.branch] || is_taken[p.candidate]) continue;
    to.is_alive[p.branch] = is_taken[p.candidate] = true;
    to.modes[p.branch] = found[p.candidate];
    poorest = std::min(poorest, p.agreement);
  }
  for (std::size_t b = 0; b < branches; ++b) {
    if (from.is_alive[b] && !to.is_alive[b]) poorest = 0.0;
  }
  for (std::size_t c = 0; c < candidates; ++c) {
    if (!is_taken[c]) to.others.push_back(found[c]);
  }
  return poorest;
}

/// Eigenvalues of oscillatory modes, the largest real part first.
std::vector<Complex> by_growth(const std::vector<Mode>& modes) {
  std::vector<Complex> all;
  for (const Mode& mode : modes) all.push_back(mode.lambda);
  std::stable_sort(all.begin(), all.end(),
                   [](Complex a, Complex b) { return a.real() > b.real(); });
  return all;
}

class Tracker {
 public:
  /// @param adds  whether modes that begin to oscillate become branches
  Tracker(FollowedModes& modes, int branches, bool adds)
      : modes_(modes), branches_(branches), adds_(adds) {}

  const FollowedModes& modes() const { return modes_; }

  Front start(double Omega) const {
    const std::vector<Mode>& found = modes_.at(Omega);
    Front front{.Omega = Omega, .modes = found, .eigenvalues = by_growth(found)};
    if (static_cast<int>(front.modes.size()) > branches_) front.modes.resize(branches_);
    front.is_alive.assign(front.modes.size(), true);
    return front;
  }

  /// Follows all branches to another speed, halving the way where shapes change much.
  Front advance(const Front& from, double Omega) const { return advance(from, look(Omega), 0); }

  /// Makes branches of other modes that are among the lowest, as many as are followed.
  void add_others(Front& front) const {
    if (!adds_) return;
    for (const Mode& mode : front.others) {
      const auto lower =
          std::count_if(front.eigenvalues.begin(), front.eigenvalues.end(),
                        [&](Complex lambda) { return lambda.imag() < mode.frequency(); });
      if (lower >= branches_) continue;
      front.modes.push_back(mode);
      front.is_alive.push_back(true);
    }
  }

 private:
  /// What there is at a speed.
  struct Look {
    double Omega = 0.0;
    const std::vector<Mode>& modes;
    const Sparse& M;
  };

  Look look(double Omega) const { return {Omega, modes_.at(Omega), modes_.mass(Omega)}; }

  Front advance(const Front& from, const Look& end, int depth) const {
    Front to{.Omega = end.Omega, .eigenvalues = by_growth(end.modes)};
    // at rest equal pairs of planar modes match either sense of whirl by half: nothing to refine
    const bool is_degenerate = from.Omega == 0.0 || end.Omega == 0.0;
    const bool is_last = depth == deepest && !is_degenerate;
    const double poorest = follow(from, end.modes, end.M, is_last, to);
    if (poorest >= sure || depth == deepest || is_degenerate) return to;
    const Look middle = look(0.5 * (from.Omega + end.Omega));
    return advance(advance(from, middle, depth + 1), end, depth + 1);
  }

  FollowedModes& modes_;
  int branches_;
  bool adds_;
};

/// Fronts at all speeds. Numbers are those at the first speed that spins; rest is reached from
/// there. Speeds that cannot be computed are gaps.
std::vector<Front> all_fronts(const Tracker& tracker, const std::vector<double>& speeds,
                              std::vector<CampbellGap>& gaps) {
  std::vector<Front> fronts(speeds.size());
  const bool starts_at_rest = speeds.front() == 0.0 && speeds.size() > 1;
  std::optional<std::size_t> last, first;  // that could be computed
  const auto compute = [&](std::size_t i) {
    try {
      fronts[i] = last ? tracker.advance(fronts[*last], speeds[i]) : tracker.start(speeds[i]);
      if (speeds[i] > 0.0) tracker.add_others(fronts[i]);  // rest comes last: none begins there
      last = i;
      if (!first) first = i;
    } catch (const NumericalError& error) {
      fronts[i].is_gap = true;
      gaps.push_back({speeds[i], error.what()});
    }
  };
  for (std::size_t i = starts_at_rest ? 1 : 0; i < speeds.size(); ++i) compute(i);
  if (starts_at_rest) {
    last = first;
    compute(0);
  }
  if (!first) throw NumericalError(gaps.front().why);
  std::sort(gaps.begin(), gaps.end(),
            [](const CampbellGap& a, const CampbellGap& b) { return a.speed < b.speed; });
  for (Front& front : fronts) {
    if (!front.is_gap) continue;
    front.modes = fronts[*first].modes;
    front.is_alive.assign(front.modes.size(), false);
  }
  const std::vector<Mode> all =
      std::max_element(fronts.begin(), fronts.end(), [](const Front& a, const Front& b) {
        return a.modes.size() < b.modes.size();
      })->modes;
  for (Front& front : fronts) {  // branches begin at any speed
    front.is_alive.resize(all.size(), false);
    for (std::size_t b = front.modes.size(); b < all.size(); ++b) front.modes.push_back(all[b]);
  }
  return fronts;
}

/// Speed between two fronts at which a branch meets the line frequency = order * Omega; NaN if it
/// ends between them.
double crossing(const Tracker& tracker, const Front& low, const Front& high, std::size_t branch,
                double order) {
  const Mode &below = low.modes[branch], &above = high.modes[branch];
  Front near = low;  // the last one
  Mode mode = below;
  const auto gap = [&](double Omega) {
    if (Omega == low.Omega || Omega == high.Omega) {
      near = Omega == low.Omega ? low : high;
    } else if (const auto own = tracker.modes().like(mode, below, above, Omega)) {
      mode = *own;
      return mode.frequency() - order * Omega;
    } else {
      near = tracker.advance(near, Omega);
    }
    if (!near.is_alive[branch]) return nan;
    mode = near.modes[branch];
    return mode.frequency() - order * Omega;
  };
  try {
    return bracketed_root(gap, low.Omega, high.Omega, crossing_tol * high.Omega);
  } catch (const NumericalError&) {
    return nan;
  }
}

/// How many modes grow.
std::size_t growing(const std::vector<Complex>& by_growth) {
  return static_cast<std::size_t>(
      std::count_if(by_growth.begin(), by_growth.end(),
                    [](Complex lambda) { return lambda.real() > clear * std::abs(lambda); }));
}

/// The threshold between two fronts of the eigenvalue that grows fastest but `number`, if it decays
/// at one of them and grows at the other.
std::optional<Threshold> threshold(const Tracker& tracker, const Front& low, const Front& high,
                                   std::size_t number) {
  Front near = low;
  const auto growth = [&](double Omega) {
    if (Omega == low.Omega || Omega == high.Omega) {
      near = Omega == low.Omega ? low : high;
    } else {
      near = tracker.advance(near, Omega);
    }
    // a mode that does not oscillate does not whirl by itself, either
    return number < near.eigenvalues.size() ? near.eigenvalues[number].real() : -high.Omega;
  };
  double speed = nan;
  try {
    speed = bracketed_root(growth, low.Omega, high.Omega, crossing_tol * high.Omega);
    if (!std::isfinite(speed)) return std::nullopt;
    if (growth(speed) == -high.Omega) return std::nullopt;
  } catch (const NumericalError&) {
    return std::nullopt;
  }
  const Complex lambda = near.eigenvalues[number];
  if (std::abs(lambda.real()) > rootless * std::abs(lambda)) return std::nullopt;  // a jump
  Threshold found{.speed = speed, .frequency = lambda.imag()};
  for (std::size_t b = 0; b < near.modes.size(); ++b) {
    if (near.is_alive[b] && near.modes[b].lambda == lambda) found.branch = static_cast<int>(b);
  }
  return found;
}

/// Thresholds between neighboring fronts.
std::vector<Threshold> all_thresholds(const Tracker& tracker, const std::vector<Front>& fronts) {
  std::vector<Threshold> found;
  const Front* before = nullptr;
  for (const Front& front : fronts) {
    if (front.is_gap) continue;
    if (before) {
      const std::size_t a = growing(before->eigenvalues), b = growing(front.eigenvalues);
      for (std::size_t number = std::min(a, b); number < std::max(a, b); ++number) {
        if (const auto t = threshold(tracker, *before, front, number)) found.push_back(*t);
      }
    }
    before = &front;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Threshold& a, const Threshold& b) { return a.speed < b.speed; });
  return found;
}

Whirl usual_whirl(const std::vector<Whirl>& seen) {
  std::array<int, 4> count{};
  for (const Whirl w : seen) ++count[static_cast<std::size_t>(w)];
  const auto most =
      std::max_element(count.begin(), count.end() - 1);  // planar only if nothing else
  return *most > 0 ? static_cast<Whirl>(most - count.begin()) : Whirl::planar;
}

}  // namespace

double mac(const CVec& a, const CVec& b, const Sparse& W) {
  const CVec Wb = W * b;
  const double ab = std::norm(a.dot(Wb));
  const double aa = a.dot(CVec(W * a)).real(), bb = b.dot(Wb).real();
  return aa > 0.0 && bb > 0.0 ? ab / (aa * bb) : 0.0;
}

std::vector<double> Campbell::criticals() const {
  std::vector<double> found;
  for (const Crossing& crossing : crossings) found.push_back(crossing.speed);
  return found;
}

Campbell campbell(const Assembler& assembler, const std::vector<double>& speeds, int branches,
                  double order) {
  Campbell result{.speeds = speeds};
  if (speeds.empty()) return result;
  if (!std::is_sorted(speeds.begin(), speeds.end()) || speeds.front() < 0.0) {
    throw OptionError("speeds of a Campbell diagram must ascend from zero or above");
  }
  constexpr double kept =
      4.0 * sizeof(Complex);  // displacements and velocities, with their frequencies
  const double of_speed = kept * (branches + spare_modes) * assembler.dofs().size();
  require_memory(
      "speeds", of_speed * static_cast<double>(speeds.size()),
      fmt::format("the shapes of {} modes at {} speeds", branches + spare_modes, speeds.size()),
      "give fewer speeds, or fewer modes");
  const ModeFinder finder(assembler);
  FollowedModes modes(assembler, finder, speeds, branches + spare_modes);
  const Tracker tracker(modes, branches, assembler.depends_on_speed());

  const std::vector<Front> fronts = all_fronts(tracker, speeds, result.gaps);
  const std::size_t branch_count = fronts.back().modes.size();
  for (std::size_t b = 0; b < branch_count; ++b) {
    CampbellBranch branch;
    std::vector<Whirl> seen;
    for (const Front& front : fronts) {
      const Mode& mode = front.modes[b];
      branch.frequency.push_back(front.is_alive[b] ? mode.frequency() : nan);
      branch.log_decrement.push_back(front.is_alive[b] ? mode.log_decrement() : nan);
      if (front.is_alive[b]) seen.push_back(mode.whirl);
    }
    branch.whirl = usual_whirl(seen);
    for (std::size_t i = 0; i < fronts.size(); ++i) {
      std::size_t next = i + 1;
      while (next < fronts.size() && fronts[next].is_gap) ++next;
      if (next == fronts.size() || !fronts[i].is_alive[b] || !fronts[next].is_alive[b]) continue;
      const double before = branch.frequency[i] - order * speeds[i];
      const double after = branch.frequency[next] - order * speeds[next];
      if (before * after > 0.0 || before == 0.0) continue;
      const double speed = crossing(tracker, fronts[i], fronts[next], b, order);
      if (std::isfinite(speed)) result.crossings.push_back({speed, static_cast<int>(b)});
    }
    result.branches.push_back(std::move(branch));
  }
  result.thresholds = all_thresholds(tracker, fronts);
  std::stable_sort(result.crossings.begin(), result.crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.speed < b.speed; });
  return result;
}

}  // namespace whirl::inline fe

#include "libfe/campbell.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libbase/roots.hpp"

namespace whirl::inline fe {

namespace {

constexpr double sure = 0.8;            ///< MAC from which a match needs no second look
constexpr int deepest = 6;              ///< halvings of a speed interval
constexpr int spare_modes = 2;          ///< computed beyond those followed, for newcomers
constexpr double crossing_tol = 1e-10;  ///< of the speed at a crossing; eigenvalues have 1e-11

/// Shapes with their eigenvalues, in the order of the branches.
struct Front {
  double Omega = 0.0;
  std::vector<Mode> modes;
  std::vector<bool> is_alive;
  bool is_gap = false;  ///< nothing could be computed; the modes are those of a neighbor
};

/// Assigns modes to branches, best agreement first. Returns the poorest agreement that was used.
double follow(const Front& from, const Modes& found, const Sparse& M, Front& to) {
  const std::size_t branches = from.modes.size(), candidates = found.oscillatory.size();
  struct Pair {
    double score, agreement;
    std::size_t branch, candidate;
  };
  std::vector<Pair> pairs;
  std::vector<double> inertia;
  for (const Mode& a : from.modes) inertia.push_back(a.shape.dot(CVec(M * a.shape)).real());
  for (std::size_t c = 0; c < candidates; ++c) {
    const Mode& z = found.oscillatory[c];
    const CVec Mz = M * z.shape;
    const double own = z.shape.dot(Mz).real();
    for (std::size_t b = 0; b < branches; ++b) {
      if (!from.is_alive[b]) continue;
      const Mode& a = from.modes[b];
      const double agreement = std::norm(a.shape.dot(Mz)) / (inertia[b] * own);
      const double distance = std::abs(a.lambda - z.lambda) / std::abs(a.lambda);
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
    if (to.is_alive[p.branch] || is_taken[p.candidate] || p.agreement < 0.1) continue;
    to.is_alive[p.branch] = is_taken[p.candidate] = true;
    to.modes[p.branch] = found.oscillatory[p.candidate];
    poorest = std::min(poorest, p.agreement);
  }
  for (std::size_t b = 0; b < branches; ++b) {
    if (from.is_alive[b] && !to.is_alive[b]) poorest = 0.0;
  }
  return poorest;
}

class Tracker {
 public:
  Tracker(const ModeFinder& finder, int branches) : finder_(finder), branches_(branches) {}

  Front start(double Omega) const {
    Front front{.Omega = Omega, .modes = modes(Omega).oscillatory};
    if (static_cast<int>(front.modes.size()) > branches_) front.modes.resize(branches_);
    front.is_alive.assign(front.modes.size(), true);
    return front;
  }

  /// Follows all branches to another speed, halving the way where shapes change much.
  Front advance(const Front& from, double Omega) const { return advance(from, look(Omega), 0); }

 private:
  /// What there is at a speed.
  struct Look {
    double Omega = 0.0;
    Modes modes;
    Sparse M;
  };

  Modes modes(double Omega) const { return finder_.at(Omega, branches_ + spare_modes); }
  Look look(double Omega) const { return {Omega, modes(Omega), finder_.system(Omega).M}; }

  Front advance(const Front& from, const Look& end, int depth) const {
    Front to{.Omega = end.Omega};
    const double poorest = follow(from, end.modes, end.M, to);
    // at rest equal pairs of planar modes match either sense of whirl by half: nothing to refine
    const bool is_degenerate = from.Omega == 0.0 || end.Omega == 0.0;
    if (poorest >= sure || depth == deepest || is_degenerate) return to;
    const Look middle = look(0.5 * (from.Omega + end.Omega));
    return advance(advance(from, middle, depth + 1), end, depth + 1);
  }

  const ModeFinder& finder_;
  int branches_;
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
  return fronts;
}

/// Speed between two fronts at which a branch meets the line frequency = order * Omega; NaN if it
/// ends between them.
double crossing(const Tracker& tracker, const Front& low, const Front& high, std::size_t branch,
                double order) {
  Front near = low;  // the last one
  const auto gap = [&](double Omega) {
    if (Omega == low.Omega || Omega == high.Omega) {
      near = Omega == low.Omega ? low : high;
    } else {
      near = tracker.advance(near, Omega);
    }
    return near.is_alive[branch] ? near.modes[branch].frequency() - order * Omega : nan;
  };
  try {
    return bracketed_root(gap, low.Omega, high.Omega, crossing_tol * high.Omega);
  } catch (const NumericalError&) {
    return nan;
  }
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
  const ModeFinder finder(assembler);
  const Tracker tracker(finder, branches);

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
  std::stable_sort(result.crossings.begin(), result.crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.speed < b.speed; });
  return result;
}

}  // namespace whirl::inline fe

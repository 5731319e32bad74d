#include "libfe/analyses/followed_modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "libbase/error.hpp"
#include "libfe/eigen/newton.hpp"

namespace whirl::inline fe {

namespace {

constexpr std::size_t longest_span = 100;  ///< speeds, then all modes are looked at again
constexpr std::size_t memory = 5;          ///< speeds that an extrapolation uses
constexpr double settled = 1e-7;  ///< relative step of Newton's iteration: the next is its square
constexpr double alike_nearby = 0.9;      ///< MAC of a mode at neighboring speeds
constexpr double near_step = 0.3;         ///< relative step of its eigenvalue
constexpr double same_eigenvalue = 1e-7;  ///< relative distance
constexpr double same_shape = 0.99;       ///< MAC
constexpr double exactly_own = 1e-12;  ///< relative distance of a frequency from that of its system
constexpr int most_halved_ways = 5;    ///< halvings of the way to the next speed
constexpr int most_owns = 12;          ///< systems until a frequency is its own

/// Nothing is known for sure about a span.
struct Doubt {};

/// Whether eigenpairs, shapes of length one, agree.
bool agree(const EigenPair& a, const EigenPair& b, double distance, double mac) {
  return std::abs(a.lambda - b.lambda) <= distance * std::abs(b.lambda) &&
         std::norm(a.q.dot(b.q)) >= mac;
}
bool is_same(const EigenPair& a, const EigenPair& b) {
  return agree(a, b, same_eigenvalue, same_shape);
}
bool is_like(const EigenPair& a, const EigenPair& b) {
  return agree(a, b, near_step, alike_nearby);
}

/// Gives a shape the phase of another, so that shapes change smoothly.
void align(EigenPair& pair, const EigenPair& other) {
  pair.q *= std::polar(1.0, -std::arg(other.q.dot(pair.q)));
}

EigenPair pair_of(const Mode& mode) {
  return {mode.lambda, mode.shape.normalized()};
}
std::vector<EigenPair> pairs_of(const std::vector<Mode>& modes) {
  std::vector<EigenPair> pairs;
  for (const Mode& mode : modes) pairs.push_back(pair_of(mode));
  return pairs;
}

/// The equations at one speed, for eigenpairs that are near to guesses.
class AtSpeed {
 public:
  AtSpeed(const Assembler& assembler, const ModeFinder& finder, double Omega)
      : assembler_(assembler), Omega_(Omega) {
    if (assembler.depends_on_whirl()) return;
    system_ = finder.system(Omega);
    newton_.emplace(system_.M, system_.D(), system_.stiffness());
  }

  const DofMap& dofs() const { return system_.dofs; }
  const Sparse& M() const { return system_.M; }

  /// The eigenpair that a guess leads to; none: it is not like the one at the speed before.
  std::optional<EigenPair> pair(EigenPair guess, const EigenPair& before) {
    if (guess.q.size() != before.q.size()) return std::nullopt;
    const bool is_found =
        assembler_.depends_on_whirl() ? converge_to_own(guess) : newton_->converge(guess, settled);
    if (!is_found || !is_like(guess, before)) return std::nullopt;
    align(guess, before);
    return guess;
  }

 private:
  /// Of coefficients that depend on the frequency: secants until it is that of the system.
  bool converge_to_own(EigenPair& pair) {
    double omega = pair.lambda.imag(), last_omega = 0.0, last_gap = 0.0;
    for (int i = 0; i < most_owns; ++i) {
      system_ = assembler_.at(Omega_, omega);
      PairNewton newton(system_.M, system_.D(), system_.stiffness());
      if (!newton.converge(pair, settled)) return false;
      const double gap = pair.lambda.imag() - omega;
      if (std::abs(gap) <= exactly_own * omega) return true;
      const double slope = i == 0 ? -1.0 : (gap - last_gap) / (omega - last_omega);
      last_omega = omega, last_gap = gap;
      omega -= gap / std::min(slope, -0.1);
      if (!(omega > 0.0)) return false;
    }
    return false;
  }

  const Assembler& assembler_;
  double Omega_;
  System system_;
  std::optional<PairNewton> newton_;
};

/// The equations at speeds, each assembled once.
class Looks {
 public:
  Looks(const Assembler& assembler, const ModeFinder& finder)
      : assembler_(assembler), finder_(finder) {}

  AtSpeed& at(double Omega) {
    return speeds_.try_emplace(Omega, assembler_, finder_, Omega).first->second;
  }

 private:
  const Assembler& assembler_;
  const ModeFinder& finder_;
  std::map<double, AtSpeed> speeds_;
};

/// One mode on its way through speeds.
class Track {
 public:
  Track(double Omega, EigenPair pair) { add(Omega, std::move(pair)); }

  const EigenPair& last() const { return pairs_.back(); }
  bool is_over() const { return is_over_; }

  /// To another speed, by halves of the way where the mode changes much.
  void advance(Looks& looks, double Omega, int depth = 0) {
    if (is_over_) return;
    if (auto pair = looks.at(Omega).pair(guess(Omega), last())) {
      add(Omega, *std::move(pair));
      is_over_ = !oscillates(last().lambda);
      return;
    }
    if (depth == most_halved_ways) throw Doubt{};
    advance(looks, 0.5 * (speeds_.back() + Omega), depth + 1);
    advance(looks, Omega, depth + 1);
  }

 private:
  void add(double Omega, EigenPair pair) {
    speeds_.push_back(Omega);
    pairs_.push_back(std::move(pair));
    if (speeds_.size() <= memory) return;
    speeds_.erase(speeds_.begin());
    pairs_.erase(pairs_.begin());
  }

  /// Where the polynomial through the last pairs leads.
  EigenPair guess(double Omega) const {
    EigenPair sum{0.0, CVec::Zero(last().q.size())};
    for (std::size_t i = 0; i < speeds_.size(); ++i) {
      double share = 1.0;
      for (std::size_t k = 0; k < speeds_.size(); ++k) {
        if (k != i) share *= (Omega - speeds_[k]) / (speeds_[i] - speeds_[k]);
      }
      sum.lambda += share * pairs_[i].lambda;
      sum.q += share * pairs_[i].q;
    }
    sum.q.normalize();
    return sum;
  }

  std::vector<double> speeds_;
  std::vector<EigenPair> pairs_;
  bool is_over_ = false;
};

std::vector<Track> tracks_from(double Omega, const std::vector<EigenPair>& pairs) {
  std::vector<Track> tracks;
  for (const EigenPair& pair : pairs) tracks.emplace_back(Omega, pair);
  return tracks;
}

/// The lowest eigenpairs at a speed of those that were followed to it; there must be enough.
std::vector<Mode> lowest_modes(std::vector<EigenPair> pairs, const DofMap& dofs, std::size_t count,
                               std::size_t enough) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (is_same(pairs[i], pairs[k])) throw Doubt{};
    }
  }
  if (pairs.size() < enough) throw Doubt{};
  std::stable_sort(pairs.begin(), pairs.end(), [](const EigenPair& a, const EigenPair& b) {
    return a.lambda.imag() < b.lambda.imag();
  });
  std::vector<Mode> modes;
  for (const EigenPair& pair : pairs) {
    if (modes.size() < count) modes.push_back(mode_of(pair.lambda, pair.q, dofs));
  }
  return modes;
}

/// Takes out of the list at the end of a span what tracks have arrived at. What is not in it must
/// be above all that it has.
std::vector<EigenPair> not_reached(std::vector<EigenPair> list, const std::vector<Track>& tracks,
                                   std::size_t count) {
  const bool is_all = list.size() < count;
  const double top = list.empty() ? 0.0 : list.back().lambda.imag() * (1.0 - same_eigenvalue);
  for (const Track& track : tracks) {
    if (track.is_over()) continue;
    const auto same = std::find_if(list.begin(), list.end(),
                                   [&](const EigenPair& p) { return is_same(p, track.last()); });
    if (same != list.end()) {
      list.erase(same);
    } else if (is_all || track.last().lambda.imag() < top) {
      throw Doubt{};
    }
  }
  return list;
}

}  // namespace

FollowedModes::FollowedModes(const Assembler& assembler, const ModeFinder& finder,
                             const std::vector<double>& speeds, int count)
    : assembler_(assembler),
      finder_(finder),
      count_(static_cast<std::size_t>(count)),
      is_large_(assembler.dofs().T.cols() >= dense_below) {
  std::vector<double> spinning;
  std::unique_copy(std::upper_bound(speeds.begin(), speeds.end(), 0.0), speeds.end(),
                   std::back_inserter(spinning));
  if (!is_large_ || spinning.empty()) return;
  const std::size_t last = spinning.size() - 1, spans = last / longest_span + 1;
  compute(spinning.front());
  for (std::size_t s = 0; s < spans && last > 0; ++s) {
    const auto from = spinning.begin() + static_cast<std::ptrdiff_t>(s * last / spans);
    const auto to = spinning.begin() + static_cast<std::ptrdiff_t>((s + 1) * last / spans);
    compute(*to);
    follow_span({from, to + 1});
  }
}

const FollowedModes::Known& FollowedModes::compute(double Omega) {
  Known known;
  try {
    known.modes = finder_.at(Omega, static_cast<int>(count_)).oscillatory;
    known.M = finder_.system(Omega).M;
  } catch (const NumericalError& error) {
    known.why_not = error.what();
  }
  return known_.insert_or_assign(Omega, std::move(known)).first->second;
}

std::vector<FollowedModes::Known> FollowedModes::followed(const std::vector<double>& speeds) const {
  const Known &low = known_.at(speeds.front()), &high = known_.at(speeds.back());
  if (!low.why_not.empty() || !high.why_not.empty()) throw Doubt{};
  const std::vector<EigenPair> first = pairs_of(low.modes);
  std::vector<std::vector<EigenPair>> pairs(speeds.size());
  std::vector<DofMap> dofs(speeds.size());
  std::vector<Sparse> M(speeds.size());
  const auto advance = [&](std::vector<Track>& tracks, std::size_t i) {
    if (tracks.empty()) return;
    Looks looks(assembler_, finder_);
    for (Track& track : tracks) {
      track.advance(looks, speeds[i]);
      if (!track.is_over()) pairs[i].push_back(track.last());
    }
    dofs[i] = looks.at(speeds[i]).dofs();
    M[i] = looks.at(speeds[i]).M();
  };
  std::vector<Track> upward = tracks_from(speeds.front(), first);
  for (std::size_t i = 1; i < speeds.size(); ++i) advance(upward, i);
  std::vector<Track> downward =
      tracks_from(speeds.back(), not_reached(pairs_of(high.modes), upward, count_));
  for (std::size_t i = speeds.size() - 1; i-- > 0;) advance(downward, i);
  if (not_reached(first, downward, count_).size() < first.size()) throw Doubt{};
  const std::size_t enough = std::min(low.modes.size(), high.modes.size());
  std::vector<Known> between;
  for (std::size_t i = 1; i + 1 < speeds.size(); ++i) {
    between.push_back(
        {lowest_modes(std::move(pairs[i]), dofs[i], count_, enough), std::move(M[i]), {}});
  }
  return between;
}

void FollowedModes::follow_span(const std::vector<double>& speeds) {
  if (speeds.size() < 3) return;
  try {
    std::vector<Known> between = followed(speeds);
    for (std::size_t i = 0; i < between.size(); ++i) {
      known_.insert_or_assign(speeds[i + 1], std::move(between[i]));
    }
  } catch (const Doubt&) {
    const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
    compute(*middle);
    follow_span({speeds.begin(), middle + 1});
    follow_span({middle, speeds.end()});
  }
}

FollowedModes::Known FollowedModes::between(double below, double above, double Omega) const {
  const Known &low = known_.at(below), &high = known_.at(above);
  if (!low.why_not.empty() || !high.why_not.empty()) throw Doubt{};
  std::vector<EigenPair> others = pairs_of(high.modes), found;
  AtSpeed there(assembler_, finder_, Omega);
  const double share = (Omega - below) / (above - below);
  const auto follow = [&](const EigenPair& guess, const EigenPair& before) {
    std::optional<EigenPair> pair = there.pair(guess, before);
    if (!pair) throw Doubt{};
    if (oscillates(pair->lambda)) found.push_back(*std::move(pair));
  };
  for (const EigenPair& pair : pairs_of(low.modes)) {
    const auto other = std::find_if(others.begin(), others.end(),
                                    [&](const EigenPair& o) { return is_like(o, pair); });
    EigenPair guess = pair;
    if (other != others.end()) {
      align(*other, pair);
      guess.lambda += share * (other->lambda - pair.lambda);
      guess.q = (guess.q + share * (other->q - pair.q)).normalized();
      others.erase(other);
    }
    follow(guess, pair);
  }
  for (const EigenPair& pair : others) follow(pair, pair);
  return {lowest_modes(std::move(found), there.dofs(), count_,
                       std::min(low.modes.size(), high.modes.size())),
          there.M(),
          {}};
}

std::optional<Mode> FollowedModes::like(const Mode& guess, const Mode& below, const Mode& above,
                                        double Omega) const {
  if (!is_large_) return std::nullopt;
  AtSpeed there(assembler_, finder_, Omega);
  const std::optional<EigenPair> pair = there.pair(pair_of(guess), pair_of(below));
  if (!pair || !oscillates(pair->lambda) || !is_like(*pair, pair_of(above))) return std::nullopt;
  return mode_of(pair->lambda, pair->q, there.dofs());
}

const FollowedModes::Known& FollowedModes::known_at(double Omega) {
  const auto above = known_.lower_bound(Omega);
  if (above != known_.end() && above->first == Omega) return above->second;
  if (above == known_.end() || above == known_.begin()) return compute(Omega);
  const double below = std::prev(above)->first;
  if (!is_large_ || below == 0.0) return compute(Omega);
  try {
    return known_.insert_or_assign(Omega, between(below, above->first, Omega)).first->second;
  } catch (const Doubt&) {
    return compute(Omega);
  }
}

const std::vector<Mode>& FollowedModes::at(double Omega) {
  const Known& known = known_at(Omega);
  if (!known.why_not.empty()) throw NumericalError(known.why_not);
  return known.modes;
}

}  // namespace whirl::inline fe

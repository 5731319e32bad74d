#include "libdyn/linear/frequency_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/system/memory.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/connection_forces.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/assembly/states_apart.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int shown_modes = 8;
constexpr int even_frequencies = 400;
constexpr double silent_share = 1e-10;  ///< of the largest response, with room for large rotors

/// What a direction is made of: factors of x, y, theta_x, theta_y.
std::array<Complex, 4> force_parts(Direction direction) {
  const Complex i(0.0, 1.0);
  switch (direction) {
    case Direction::x:
      return {1.0, 0.0, 0.0, 0.0};
    case Direction::y:
      return {0.0, 1.0, 0.0, 0.0};
    case Direction::theta_x:
      return {0.0, 0.0, 1.0, 0.0};
    case Direction::theta_y:
      return {0.0, 0.0, 0.0, 1.0};
    case Direction::forward:
      return {1.0, -i, 0.0, 0.0};
    case Direction::backward:
      return {1.0, i, 0.0, 0.0};
  }
  return {};
}

std::array<Complex, 4> force_parts(const ResponseEnd& end) {
  if (!end.probe) return force_parts(end.direction);
  std::array<Complex, 4> parts;
  for (int c = 0; c < 4; ++c) {
    parts[static_cast<std::size_t>(c)] =
        end.probe->reading([&](int k) { return k == c ? 1.0 : 0.0; });
  }
  return parts;
}

/// Of a motion they are told by half the conjugates where it whirls.
std::array<Complex, 4> motion_parts(const ResponseEnd& end) {
  std::array<Complex, 4> parts = force_parts(end);
  const bool whirls = end.direction == Direction::forward || end.direction == Direction::backward;
  for (Complex& part : parts) part = std::conj(part) * (whirls ? 0.5 : 1.0);
  return parts;
}

/// Full vector of a force or moment of size one.
CVec load_of(const ResponseEnd& end, const DofMap& dofs) {
  CVec load = CVec::Zero(dofs.full_size);
  const auto parts = force_parts(end);
  for (int c = 0; c < 4; ++c) {
    const int k = dofs.full_index(end.at.point, c);
    if (k >= 0) load(k) = parts[static_cast<std::size_t>(c)];
  }
  return load;
}

Complex motion_of(const ResponseEnd& end, const DofMap& dofs, const CVec& full) {
  Complex sum = 0.0;
  const auto parts = motion_parts(end);
  for (int c = 0; c < 4; ++c) {
    const int k = dofs.full_index(end.at.point, c);
    if (k >= 0) sum += parts[static_cast<std::size_t>(c)] * full(k);
  }
  return sum;
}

bool is_tilt(Direction direction) {
  return direction == Direction::theta_x || direction == Direction::theta_y;
}

/// Largest responses of any point to a force, over all frequencies.
struct LargestResponse {
  double displacement = 0.0, tilt = 0.0;  ///< [m, rad]

  double seen_by(const ResponseEnd& end) const {
    if (end.probe) return end.probe->is_axial() ? end.probe->face_radius * tilt : displacement;
    return is_tilt(end.direction) ? tilt : displacement;
  }

  void take(const CVec& full, const DofMap& dofs) {
    for (const Point& point : dofs.points()) {
      for (const Component c : {X, Y, THETA_X, THETA_Y}) {
        const int k = dofs.full_index(point, c);
        double& largest = c < THETA_X ? displacement : tilt;
        if (k >= 0) largest = std::max(largest, std::abs(full(k)));
      }
    }
  }
};

/// Makes a response zero that is rounding; where it is not bounded it stays so.
void silence(ResponsePair& pair, double largest) {
  const auto is_heard = [&](const Complex& H) { return std::abs(H) > silent_share * largest; };
  if (std::any_of(pair.receptance.begin(), pair.receptance.end(), is_heard)) return;
  for (CVec* response : {&pair.receptance, &pair.mobility, &pair.accelerance}) {
    for (Complex& H : *response) {
      if (std::isfinite(std::abs(H))) H = 0.0;
    }
  }
}

bool is_tilt(const std::string& end) {
  return end.ends_with(fmt::format(" {}", name_of(Direction::theta_x))) ||
         end.ends_with(fmt::format(" {}", name_of(Direction::theta_y)));
}

}  // namespace

std::string ResponseEnd::label() const {
  return probe ? probe->name : fmt::format("{} {}", at.label(), name_of(direction));
}

std::vector<ResponseEnd> select_ends(const Model& model, const Assembler& assembler,
                                     const std::string& list) {
  std::vector<ResponseEnd> ends;
  if (list.empty()) {
    for (const NamedPoint& point : select_points(model, assembler, "")) {
      ends.push_back({point, Direction::x});
      ends.push_back({point, Direction::y});
    }
    return ends;
  }
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    const std::string entry = list.substr(at, comma - at);
    at = comma + 1;
    const std::vector<Probe>& probes = model.structure.probes;
    const auto probe =
        std::find_if(probes.begin(), probes.end(), [&](const Probe& p) { return p.name == entry; });
    if (probe != probes.end()) {
      ends.push_back({{assembler.point(probe->at), probe->name}, Direction::x, *probe});
      continue;
    }
    const std::size_t colon = entry.rfind(':');
    Direction direction = Direction::x;
    if (colon != std::string::npos) {
      const auto known = value_named<Direction>(entry.substr(colon + 1));
      if (!known) {
        throw ModelError({}, entry,
                         "expected x, y, theta_x, theta_y, forward or backward behind the colon");
      }
      direction = *known;
    }
    for (const NamedPoint& point : select_points(model, assembler, entry.substr(0, colon))) {
      if (is_tilt(direction) && assembler.dofs().full_index(point.point, THETA_X) < 0) {
        throw ModelError({}, entry, "this body does not tilt; give it tilts = true");
      }
      ends.push_back({point, direction});
    }
  }
  return ends;
}

FrequencyResponse frequency_response(const Assembler& assembler, double Omega,
                                     const std::vector<double>& frequencies,
                                     const std::vector<ResponseEnd>& from,
                                     const std::vector<ResponseEnd>& to) {
  FrequencyResponse result{.speed = Omega, .frequencies = frequencies};
  const auto count = static_cast<Eigen::Index>(frequencies.size());
  constexpr double of_value =
      450.0;  // bytes that three complex numbers take, with their JSON; measured
  const auto pairs = static_cast<double>(from.size() * to.size());
  require_memory("frequencies", of_value * pairs * static_cast<double>(count),
                 fmt::format("{} frequency responses at {} frequencies", pairs, count),
                 "give fewer frequencies, or fewer stations");
  const System system = assembler.uncondensed(Omega);
  const DofMap& dofs = system.dofs;
  CMat loads(dofs.size(), static_cast<Eigen::Index>(from.size()));
  for (std::size_t f = 0; f < from.size(); ++f) {
    loads.col(static_cast<Eigen::Index>(f)) = dofs.T.transpose() * load_of(from[f], dofs);
    for (const ResponseEnd& end : to) {
      const CVec none = CVec::Zero(count);
      result.pairs.push_back({from[f].label(), end.label(), none, none, none});
    }
  }
  const std::vector<CarryingPart> parts = carrying_parts(assembler);
  for (const ResponseEnd& end : from) {
    for (const CarryingPart& part : parts) {
      result.transmitted.push_back(
          {end.label(), std::string(part.kind), part.name, CVec::Zero(count), CVec::Zero(count)});
    }
  }
  std::optional<ConnectionForces> forces;
  std::vector<LargestResponse> largest(from.size());
  DynamicStiffness stiffness(system);
  // what holds nothing moves without end under a steady force, whatever rounding leaves of K
  const bool is_held = is_held_at_rest(assembler.uncondensed(Omega, 0.0));
  for (Eigen::Index k = 0; k < count; ++k) {
    const double w = frequencies[static_cast<std::size_t>(k)];
    if (assembler.depends_on_whirl()) {
      stiffness = DynamicStiffness(assembler.uncondensed(Omega, w));
    }
    if (!forces || assembler.depends_on_whirl()) forces.emplace(assembler, Omega, w);
    bool is_bounded = true;
    for (std::size_t f = 0; f < from.size(); ++f) {
      std::optional<CVec> q;
      if (w != 0.0 || is_held) {
        q = stiffness.solve(w, Omega, loads.col(static_cast<Eigen::Index>(f)));
      }
      is_bounded = is_bounded && q.has_value();
      const CVec full = q ? CVec(dofs.T * *q) : CVec();
      if (q) largest[f].take(full, dofs);
      const CVec carried = q ? forces->at(w, full, load_of(from[f], dofs))
                             : CVec::Constant(std::ssize(parts) * 2, Complex(nan, nan));
      for (std::size_t p = 0; p < parts.size(); ++p) {
        TransmittedForce& to_part = result.transmitted[f * parts.size() + p];
        to_part.x(k) = carried(static_cast<Eigen::Index>(2 * p));
        to_part.y(k) = carried(static_cast<Eigen::Index>(2 * p + 1));
      }
      for (std::size_t t = 0; t < to.size(); ++t) {
        const Complex H = q ? motion_of(to[t], dofs, full) : Complex(nan, nan);
        ResponsePair& pair = result.pairs[f * to.size() + t];
        pair.receptance(k) = H;
        pair.mobility(k) = Complex(0.0, w) * H;
        pair.accelerance(k) = -w * w * H;
      }
    }
    if (!is_bounded) result.unbounded.push_back(w);
  }
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    const LargestResponse& all = largest[i / to.size()];
    silence(result.pairs[i], all.seen_by(to[i % to.size()]));
  }
  return result;
}

std::vector<bool> FrequencyResponse::silent_pairs() const {
  const auto group_of = [](const ResponsePair& pair) {
    return std::pair(pair.from, is_tilt(pair.to));
  };
  std::vector<double> sizes;
  std::map<std::pair<std::string, bool>, double> largest;
  for (const ResponsePair& pair : pairs) {
    double size = nan;
    for (const Complex& H : pair.receptance) size = std::fmax(size, std::abs(H));
    double& top = largest.try_emplace(group_of(pair), nan).first->second;
    top = std::fmax(top, size);
    sizes.push_back(size);
  }
  std::vector<bool> silent;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    silent.push_back(sizes[i] <= silent_share * largest.at(group_of(pairs[i])));
  }
  return silent;
}

std::vector<double> usual_frequencies(const Assembler& assembler, double Omega) {
  const Modes modes = complex_modes(assembler, Omega, shown_modes);
  if (modes.oscillatory.empty()) {
    throw NumericalError("no mode oscillates: give the frequencies of the response");
  }
  const double top = 1.2 * modes.oscillatory.back().frequency();
  std::vector<double> all;
  for (int i = 0; i <= even_frequencies; ++i) all.push_back(top * i / even_frequencies);
  for (const Mode& mode : modes.oscillatory) {
    all.push_back(mode.frequency());
    for (const double widths : {0.25, 0.5, 1.0, 2.0, 4.0}) {
      for (const double side : {-1.0, 1.0}) {
        const double w = mode.frequency() + side * widths * std::abs(mode.lambda.real());
        if (w > 0.0 && w < top) all.push_back(w);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace whirl::inline dyn

#include "libdyn/studies/basins.hpp"

#include <cmath>
#include <random>

#include "libbase/random.hpp"

namespace whirl {

namespace {

constexpr double same = 1e-5;    ///< distance of sections [length scales]
constexpr int most_draws = 100;  ///< until a start is inside its bearings

/// Whether the last section of one orbit is any of another.
bool is_on(const ContactSystem& system, const Ending& one, const Ending& other) {
  const int size = system.size();
  const auto count = static_cast<int>(other.sections.size()) / size;
  const Eigen::Map<const Vec> last(one.sections.data(), size);
  for (int i = 0; i < count; ++i) {
    const Eigen::Map<const Vec> section(other.sections.data() + i * size, size);
    if (distance(system, last, section) < same) return true;
  }
  return false;
}

bool is_same(const ContactSystem& system, const Ending& a, const Ending& b) {
  if (a.kind != b.kind || a.period != b.period || a.is_proven != b.is_proven ||
      a.regimes != b.regimes) {
    return false;
  }
  return !a.is_proven || is_on(system, a, b);
}

}  // namespace

std::vector<int> attractors(const ContactSystem& system, std::span<const Ending> endings) {
  std::vector<int> numbers;
  std::vector<const Ending*> found;
  for (const Ending& ending : endings) {
    std::size_t i = 0;
    while (i < found.size() && !is_same(system, ending, *found[i])) ++i;
    if (i == found.size()) found.push_back(&ending);
    numbers.push_back(static_cast<int>(i));
  }
  return numbers;
}

MotionState random_start(const ContactSystem& system, const MotionState& around, double size,
                         std::uint64_t seed, std::uint64_t number) {
  std::seed_seq sequence{seed & 0xffffffffu, seed >> 32, number & 0xffffffffu, number >> 32};
  std::mt19937_64 random(sequence);
  MotionState start = around;
  for (int draw = 0; draw < most_draws; ++draw) {
    start.y = around.y;
    for (Eigen::Index i = 0; i < start.y.size(); ++i) {
      start.y(i) += size * (2.0 * random_share(random) - 1.0) * system.state_scale()(i);
    }
    if (!system.left_bearing(start.y.data())) break;
  }
  return start;
}

}  // namespace whirl

// How often the largest exponent of a motion is as near to its limit as is said: motions of random
// rotors that are no proven orbits, averaged over T revolutions and over far more. Chaos that ends
// in a regular motion meanwhile has no limit of its own, and is counted apart.
//
//   whirl_exponent_coverage [motions] [revolutions of the limit]
//
// prints the table of docs/validation.md

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <vector>

#include "libdyn/studies/classify.hpp"
#include "libdyn/studies/exponents.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/text/table.hpp"
#include "tests/support/scenes.hpp"

namespace whirl {
namespace {

constexpr long transient = 300;
constexpr long averaged[] = {50, 100, 200, 400};
constexpr std::size_t together = 64;  ///< motions of a batch
constexpr int every = 10;             ///< one in so many is a two-disk rotor that bounces
constexpr double regular = 0.004;     ///< limits of exponents that count as none [1/revolution]

/// A rotor in a stator anywhere in the planes of the atlas, or two disks about their 3:1 resonance.
Model random_rotor(std::mt19937& random, int number) {
  const auto share = [&] { return std::ldexp(static_cast<double>(random()), -32); };
  if (number % every != 0) {
    const double Omega = 130.0 + 35.0 * share(), kC = 2e6 + 198e6 * share();
    return test::RotorStator{.Omega = Omega, .kC = kC, .mu = 0.3 * share()}.model();
  }
  const double speed = (4360.0 + 150.0 * share()) * test::rpm;
  return test::TwoDiskRub{.speed = speed,
                          .k = 8e6,
                          .mu = 0.02 * share(),
                          .start = {{.mode = 1, .amplitude = 4e-3}, {.mode = 2, .amplitude = 3e-3}}}
      .model();
}

/// What the motions of one averaging time say.
struct Coverage {
  long motions = 0, within = 0, regular_ones = 0, within_zero = 0, plain = 0;
  std::vector<double> resolutions{};

  void add(const Mat& growths, long T, double limit) {
    const ExponentEstimate e = estimate_exponents(growths.leftCols(T));
    ++motions;
    within += std::abs(e.exponents(0) - limit) <= e.resolution;
    resolutions.push_back(e.resolution);
    plain += std::abs(growths.col(T - 1).maxCoeff() / static_cast<double>(T) - limit) <= e.zero;
    if (std::abs(limit) > regular) return;
    ++regular_ones;
    within_zero += e.exponents(0) <= e.zero;
  }
};

/// Whether a motion is chaotic for long and a regular one at the end.
bool is_ending_chaos(const Mat& growths) {
  const ExponentEstimate early = estimate_exponents(growths.leftCols(averaged[3]));
  if (early.exponents(0) <= early.zero) return false;
  const Eigen::Index all = growths.cols(), from = all - all / 4;
  const Vec late = growths.col(all - 1) - growths.col(from - 1);
  return late.maxCoeff() <= regular * static_cast<double>(all / 4);
}

/// The growth of tangents of those motions of some rotors that are no proven orbits.
std::vector<Mat> growths_of(const std::vector<Model>& models, long revolutions) {
  std::vector<Scene> scenes;
  for (const Model& m : models) scenes.push_back(make_scene(m, ReductionEstimate::no));
  std::vector<ClassifyCandidate> subjects;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    subjects.push_back({.system = &scenes[i].contacts});
    subjects.back().found.end = test::start_of(models[i], scenes[i]);
  }
  settle(subjects, {.discard = transient});
  std::map<int, std::vector<Trajectory>> by_size;
  for (const ClassifyCandidate& s : subjects) {
    if (!s.found.is_good() || s.found.is_proven) continue;
    by_size[s.system->size()].push_back(
        {.system = s.system, .state = s.found.end, .revolutions = revolutions});
  }
  std::vector<Mat> all;
  for (auto& [size, trajectories] : by_size) {
    integrate_batch(trajectories, {.threads = 1, .exponents = true, .growths = true});
    for (const Trajectory& t : trajectories) {
      if (t.outcome != Outcome::reached_end) continue;
      all.emplace_back(Eigen::Map<const Mat>(t.growths.data(), size, revolutions));
    }
  }
  return all;
}

void run(long motions, long revolutions) {
  std::mt19937 random(1);
  std::vector<Coverage> coverage(std::size(averaged));
  long ending = 0;
  for (int number = 0; coverage[0].motions < motions;) {
    std::vector<Model> models;
    while (models.size() < together) models.push_back(random_rotor(random, number++));
    for (const Mat& growths : growths_of(models, revolutions)) {
      if (is_ending_chaos(growths)) {
        ++ending;
        continue;
      }
      const double limit = estimate_exponents(growths).exponents(0);
      for (std::size_t i = 0; i < coverage.size(); ++i)
        coverage[i].add(growths, averaged[i], limit);
    }
  }
  Table table({"revolutions", "motions", "within the resolution", "median resolution",
               "regular ones", "not above zero", "all growth over time within (1 + ln T) / T"});
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    Coverage& c = coverage[i];
    const auto middle = c.resolutions.begin() + std::ssize(c.resolutions) / 2;
    std::nth_element(c.resolutions.begin(), middle, c.resolutions.end());
    const auto percent = [](long part, long all) {
      return fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
    };
    table.row({std::to_string(averaged[i]), std::to_string(c.motions), percent(c.within, c.motions),
               fmt::format("{:.3f}", *middle), std::to_string(c.regular_ones),
               percent(c.within_zero, c.regular_ones), percent(c.plain, c.motions)});
  }
  fmt::print("limits: means over {} revolutions; chaos that ends meanwhile, left out: {}\n\n{}",
             revolutions, ending, table.text());
}

}  // namespace
}  // namespace whirl

int main(int argc, char** argv) {
  whirl::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 1000,
             argc > 2 ? std::max(400, std::atoi(argv[2])) : 6000);
}

// Twin experiments: a rotor's own motion with noise, and the parameters that a fit finds in it.
//
//   whirl_fit_twins [records] [how far off the starts are, 0 to 1] [twin]
//
// prints a table of docs/benchmarks.md

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/random.hpp"
#include "libdata/fit/fit.hpp"
#include "libdata/fit/model_source.hpp"
#include "libdata/fit/steady_record.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/system/probes.hpp"
#include "libdyn/taylor/motion_slopes.hpp"
#include "libio/model/model_family.hpp"
#include "libio/model/model_file.hpp"
#include "libio/text/table.hpp"

namespace whirl {
namespace {

/// A rotor that is measured, and what is looked for.
struct Twin {
  std::string name, file;
  std::vector<std::string> sets;
  std::vector<Point> points;  ///< with a probe along x and one along y each
  double revolutions = 10.0;
  std::vector<std::string> paths;
  std::vector<double> truth;
  int period = 0;          ///< of a steady motion, averaged to one [revolutions]
  double settled = 300.0;  ///< revolutions before
};

constexpr int per_revolution = 64;
constexpr double noise = 0.01;  ///< standard deviation, of that of the readings

std::vector<Twin> twins() {
  const auto node = [](int number) { return Point{Point::Kind::node, number - 1}; };
  const std::vector<std::string> ring{"contact.ring.stiffness", "contact.ring.friction",
                                      "contact.ring.clearance"};
  return {{.name = "two disks",
           .file = "two_disk_mac.toml",
           .sets = {"contact.ring.friction=0.05"},
           .points = {node(4), node(9)},
           .paths = ring,
           .truth = {4e6, 0.05, 5e-3}},
          {.name = "bouncing",
           .file = "two_disk_mac.toml",
           .sets = {"contact.ring.friction=0.01"},
           .points = {node(4), node(9)},
           .paths = ring,
           .truth = {4e6, 0.01, 5e-3}},
          {.name = "chaos",
           .file = "jeffcott_stator.toml",
           .sets = {},
           .points = {Point{Point::Kind::body, 0}},
           .revolutions = 20.0,
           .paths = {"contact.ring.friction"},
           .truth = {0.1}},
          {.name = "steady",
           .file = "jeffcott_stator.toml",
           .sets = {"contact.ring.stiffness=20e6"},
           .points = {Point{Point::Kind::body, 0}, Point{Point::Kind::body, 1}},
           .revolutions = 40.0,
           .paths = ring,
           .truth = {20e6, 0.1, 6e-3},
           .period = 1},
          {.name = "doubled",
           .file = "jeffcott_stator.toml",
           .sets = {"operation.speed='138.4 rad/s'", "contact.ring.stiffness=64e6",
                    "contact.ring.friction=0.12"},
           .points = {Point{Point::Kind::body, 0}, Point{Point::Kind::body, 1}},
           .revolutions = 40.0,
           .paths = ring,
           .truth = {64e6, 0.12, 6e-3},
           .period = 2,
           .settled = 2000.0}};
}

/// A twin ready to be measured.
struct Measured {
  ModelFamily family;
  std::shared_ptr<const Scene> scene;
  Mat rows;
  FitRecord record;  ///< without noise
  long touches = 0;
};

Mat rows_of(const Scene& scene, const std::vector<Point>& points) {
  const Mat map = scene.displacement_map();
  Mat rows(2 * std::ssize(points), map.cols());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int along = 0; along < 2; ++along) {
      rows.row(static_cast<Eigen::Index>(2 * i) + along) =
          map.row(scene.reduced.dofs.full_index(points[i], along));
    }
  }
  return rows;
}

Measured measure(const Twin& twin) {
  const Model model = read_model(WHIRL_MODELS "/" + twin.file, twin.sets);
  std::vector<ParameterAxis> axes(twin.paths.size());
  for (std::size_t p = 0; p < axes.size(); ++p) axes[p].path = twin.paths[p];
  Measured found{ModelFamily(model, axes), {}, {}, {}};
  found.scene = found.family.scene(twin.truth);
  found.rows = rows_of(*found.scene, twin.points);

  const ContactSystem& system = found.scene->contacts;
  const SlopeOptions alone{.by_start = false};
  const std::vector<double> before{twin.settled * system.period()};
  MotionState state = start_state(model, *found.scene, std::optional<EarlierEnd>());
  state = motion_slopes(system, state, before, {}, alone).end;
  const auto samples = static_cast<int>(twin.revolutions) * per_revolution + 1;
  std::vector<double> times;
  for (int i = 0; i < samples; ++i) times.push_back(system.period() * i / per_revolution);
  const MotionSlopes motion = motion_slopes(system, state, times, {}, alone);
  for (const MotionEvent& event : motion.events) {
    found.touches += event.kind == EventKind::touch ? 1 : 0;
  }
  found.record = {.name = twin.name,
                  .times = Vec::Map(times.data(), samples),
                  .readings = found.rows * motion.states.topRows(found.rows.cols()),
                  .noise = Vec(found.rows.rows()),
                  .phase = state.phase};
  for (Eigen::Index probe = 0; probe < found.rows.rows(); ++probe) {
    const auto row = found.record.readings.row(probe).array();
    found.record.noise(probe) = noise * std::sqrt((row - row.mean()).square().mean());
  }
  return found;
}

FitRecord with_noise(FitRecord record, std::mt19937_64& random) {
  for (Eigen::Index probe = 0; probe < record.readings.rows(); ++probe) {
    for (double& reading : record.readings.row(probe)) {
      reading += record.noise(probe) * random_normal(random);
    }
  }
  return record;
}

/// Fits to so many records of a twin. Statistics are of all that say that they converged.
/// @param off  starts are drawn from (1 - off) to (1 + off) times the truth
void fit_twin(const Twin& twin, int seeds, double off) {
  const Measured measured = measure(twin);
  const auto count = std::ssize(twin.paths);
  Mat errors = Mat::Zero(count, seeds);  // over their standard deviations
  Vec deviation = Vec::Zero(count);
  int converged = 0, wrong = 0;
  double iterations = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937_64 random(static_cast<unsigned>(seed) + 1);
    FitRecord record = with_noise(measured.record, random);
    if (twin.period > 0) {
      const double speed = measured.scene->contacts.phase_rate();
      record = steady_record(record, speed, {.revolutions = twin.period}).period;
    }
    std::vector<FreeParameter> free;
    for (std::size_t p = 0; p < twin.paths.size(); ++p) {
      const double start = twin.truth[p] * (1.0 + off * (2.0 * random_share(random) - 1.0));
      free.push_back({.path = twin.paths[p], .start = start, .size = start, .lower = 0.0});
    }
    const FitSource source =
        model_source(record, measured.scene, measured.rows, free, [&](const Vec& values) {
          return measured.family.model({values.data(), static_cast<std::size_t>(values.size())});
        });
    const Fit found = fit({source}, free);
    iterations += found.iterations;
    if (!found.has_converged) continue;
    bool is_near = true;
    for (Eigen::Index p = 0; p < count; ++p) {
      const FittedParameter& parameter = found.parameters[static_cast<std::size_t>(p)];
      const double error = parameter.value - twin.truth[static_cast<std::size_t>(p)];
      is_near = is_near && std::abs(error) < 5.0 * parameter.standard_deviation;
      errors(p, converged) = error / parameter.standard_deviation;
      deviation(p) += parameter.standard_deviation;
    }
    ++converged;
    if (!is_near) ++wrong;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  fmt::print(
      "{}: {:.0f} revolutions, {} probes, {} samples a revolution, {} touches, noise {:.3g} %, {} "
      "records, starts up to {:.0f} % off\n",
      twin.name, twin.revolutions, measured.rows.rows(), per_revolution, measured.touches,
      100.0 * noise, seeds, 100.0 * off);
  Table table(
      {"parameter", "truth", "predicted deviation", "rms error / predicted", "within two [%]"});
  for (Eigen::Index p = 0; p < count; ++p) {
    const auto row = errors.row(p).head(converged).array();
    const auto at = static_cast<std::size_t>(p);
    table.row({twin.paths[at], fmt::format("{:.6g}", twin.truth[at]),
               fmt::format("{:.3g}", deviation(p) / converged),
               fmt::format("{:.3f}", std::sqrt(row.square().mean())),
               fmt::format("{:.1f}", 100.0 * (row.abs() < 2.0).cast<double>().mean())});
  }
  fmt::print(
      "{}\n{} of {} converge, of which {} end farther than five deviations from the truth; {:.0f} "
      "iterations and {:.2f} s each\n\n",
      table.text(), converged, seeds, wrong, iterations / seeds, took.count() / seeds);
}

int run(int seeds, double off, const std::string& only) {
  for (const Twin& twin : twins()) {
    if (only.empty() || only == twin.name) fit_twin(twin, seeds, off);
  }
  return 0;
}

}  // namespace
}  // namespace whirl

int main(int argc, char** argv) {
  return whirl::run(argc > 1 ? std::atoi(argv[1]) : 20, argc > 2 ? std::atof(argv[2]) : 0.0,
                    argc > 3 ? argv[3] : "");
}

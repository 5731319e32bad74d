#include "libio/results/motion_results.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libfe/analyses/critical_map.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/result_schema.hpp"

namespace whirl::inline io {

namespace {

void write_end(ResultWriter& file, const Model& model, const Scene& scene, const MotionEnd& end) {
  file.attribute("/", "speed", model.speed);
  write_points(file, model, scene.assembler);
  write_result(file, end);
}

void write_run(ResultWriter& file, const Run& run, const Model& model, const MotionEnd& end) {
  write_end(file, model, run.scene, end);
  write_result(file, run_facts(run.simulation));
  if (!run.has_motion()) return;
  const Recording& r = run.simulation.recording;
  write_result(file, contact_shares(r.contacts, r.revolutions, r.rubbing));
  write_result(file, recorded_motion(run));
  if (!run.stations.empty()) write_result(file, spectra_of(run));
}

ContactMeasure measure_of(const ContactShare& share, long revolutions) {
  return {.name = share.name,
          .duty = share.duty,
          .impacts = std::round(share.impacts_per_rev * static_cast<double>(revolutions)),
          .sticking = share.sticking,
          .max_normal = share.max_normal,
          .max_tangential = share.max_tangential,
          .mean_slip = share.mean_slip};
}

/// Motions in the coordinates of a scene; those of the same program are there as they were.
/// @throws ModelError  naming the file, if they are none of this rotor
Mat coordinates_in(const Scene& scene, MotionRecord motion, const std::string& path) {
  constexpr double same = 1e-6;  // of displacements, computed on two machines
  const Mat map = scene.displacement_map();
  const Mat& basis = motion.basis;
  if (basis.rows() == map.rows()) {
    if (basis.cols() == map.cols() && basis == map) return std::move(motion.coordinates);
    const Mat turned = DenseLu<Mat>(map.transpose() * map).solve(map.transpose() * basis);
    if ((map * turned - basis).norm() <= same * basis.norm()) return turned * motion.coordinates;
  }
  throw ModelError({path}, "", "its motion is of another rotor than this model");
}

/// @throws ModelError  naming the file, if it is no recording of this rotor
Recording stored_recording(const ResultReader& file, const Scene& scene, std::size_t contacts,
                           const RunFacts& facts, MotionRecord motion) {
  Recording r{.samples = facts.samples_per_revolution,
              .revolutions = std::lround(facts.revolutions),
              .clock = scene.contacts.clock(),
              .first_revolution = std::lround(motion.time(0) / facts.period),
              .time = motion.time,
              .normal = std::move(motion.normal),
              .friction = std::move(motion.friction),
              .begins = motion.begins};
  r.on_supports.resize(std::ssize(motion.supports) * 2, r.time.size());
  for (std::size_t i = 0; i < motion.supports.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    r.on_supports.row(row) = motion.supports[i].x.transpose();
    r.on_supports.row(row + 1) = motion.supports[i].y.transpose();
  }
  r.eta = coordinates_in(scene, std::move(motion), file.path());
  for (const ContactShare& share : read_result<ContactShares>(file).contacts) {
    r.contacts.push_back(measure_of(share, r.revolutions));
    r.rubbing.push_back(share.rubbing);
  }
  if (r.eta.cols() != r.revolutions * r.samples || r.contacts.size() != contacts) {
    throw ModelError({file.path()}, "", "its motion is no simulation of this model");
  }
  return r;
}

}  // namespace

void write_rest(ResultWriter& file, const StaticStudy& study) {
  write_result(file, study.at_rest);
  if (!study.on_films.films.empty()) write_result(file, study.on_films);
  if (!study.on_elements.bearings.empty()) write_result(file, study.on_elements);
  if (study.line.z.size() > 0) write_result(file, study.line);
}

void write_criticals(ResultWriter& file, const Structure& structure, const CriticalSpeeds& found) {
  write_result(file, found);
  try {
    const CriticalMap map = critical_map_of(structure, found);
    if (!map.branches.empty()) write_result(file, map);
  } catch (const NumericalError&) {
    return;
  }
}

void write_points(ResultWriter& file, const Model& model, const Assembler& assembler) {
  write_result(file, point_names(model, assembler));
}

void write_end(ResultWriter& file, const Model& model, const Scene& scene,
               const MotionState& state) {
  write_end(file, model, scene, motion_end(scene, state));
}

void write_end(ResultWriter& file, const Model& model, const Scene& scene, const Vec& state) {
  MotionState end;
  end.y = state;
  write_end(file, model, scene, end);
}

void write_run(ResultWriter& file, const Run& run, const Model& model) {
  write_run(file, run, model, motion_end(run.scene, run.simulation.end));
}

void write_run(ResultWriter& file, const StoredRun& stored, const Model& model) {
  write_run(file, stored.run, model, stored.end);
}

StoredRun stored_run(const std::string& path, const Model& model, const std::string& stations,
                     const std::string& method) {
  const auto file = open_result(path);
  if (!file->has("/trajectory/coordinates")) {
    throw ModelError({path}, "", "holds no motion; simulate and identify record one");
  }
  const auto facts = read_result<RunFacts>(*file);
  Scene scene = make_scene(model);
  auto record = read_result<MotionRecord>(*file);
  std::vector<SupportLoads::Part> supports;
  for (const SupportForce& s : record.supports) supports.push_back({s.kind, s.name});
  Simulation motion{
      .recording = stored_recording(*file, scene, model.contacts.size(), facts, std::move(record))};
  motion.integration = {
      .outcome = facts.failure ? Outcome::step_too_small : Outcome::reached_end,  // or another one
      .cost = {.steps = std::lround(facts.steps),
               .evaluations = std::lround(facts.evaluations),
               .events = std::lround(facts.events)},
      .failure = facts.failure};
  auto spectra = std::make_shared<const ResponseSpectra>(scene, motion.recording);
  std::vector<NamedPoint> points = select_points(model, scene.assembler, stations);
  std::string integrator =
      !method.empty() ? method : std::string(name_of_method(suitable_method(scene.contacts)));
  return {.run = {std::move(scene), std::move(motion), std::move(points), std::move(integrator),
                  std::move(spectra), std::move(supports)},
          .end = read_result<MotionEnd>(*file)};
}

void write_resonances(ResultWriter& file, const Model& model, const Assembler& assembler,
                      const ResonanceStudy& study) {
  const auto first = std::find_if(study.places.begin(), study.places.end(),
                                  [](const auto& place) { return place.bouncing.has_value(); });
  if (first != study.places.end()) {
    MotionState on_it;
    on_it.y = first->bouncing->cycle.state;
    write_end(file, model, *scene_at_speed(model, first->bouncing->speed), on_it);
  } else {
    write_points(file, model, assembler);
  }
  write_result(file, study.diagram);
  write_result(file, study);
}

EarlierEnd earlier_end(const std::string& path) {
  const auto file = open_result(path);
  if (!file->has("/trajectory/end_displacement")) {
    throw ModelError({path}, "",
                     "holds no motion to start from; simulate, identify and classify write one");
  }
  const auto ended = read_result<MotionEnd>(*file);
  EarlierEnd end{{ended.displacement, ended.velocity}, ended.phase};
  constexpr double most = 1e15;  // of a file that may come from a stranger
  end.revolution = static_cast<long>(std::clamp(ended.revolution.value_or(0.0), 0.0, most));
  if (!end.state.displacement.allFinite() || !end.state.velocity.allFinite()) {
    throw ModelError(
        {path}, "",
        "its motion failed and ends in no finite numbers: there is nothing to start from");
  }
  return end;
}

std::optional<EarlierEnd> earlier_end(const Start& start) {
  if (start.from != StartFrom::file) return std::nullopt;
  return earlier_end(start.file);
}

}  // namespace whirl::inline io

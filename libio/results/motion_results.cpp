#include "libio/results/motion_results.hpp"

#include <algorithm>

#include "libbase/error.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/result_schema.hpp"

namespace whirl::inline io {

void write_points(ResultWriter& file, const Model& model, const Assembler& assembler) {
  write_result(file, point_names(model, assembler));
}

void write_end(ResultWriter& file, const Model& model, const Scene& scene,
               const MotionState& state) {
  file.attribute("/", "speed", model.speed);
  write_points(file, model, scene.assembler);
  write_result(file, motion_end(scene, state));
}

void write_end(ResultWriter& file, const Model& model, const Scene& scene, const Vec& state) {
  MotionState end;
  end.y = state;
  write_end(file, model, scene, end);
}

void write_run(ResultWriter& file, const Run& run, const Model& model) {
  write_end(file, model, run.scene, run.simulation.end);
  write_result(file, run_facts(run.simulation));
  if (!run.has_motion()) return;
  const Recording& r = run.simulation.recording;
  write_result(file, contact_shares(r.contacts, r.revolutions));
  write_result(file, recorded_motion(run));
  if (!run.stations.empty()) write_result(file, spectra_of(run));
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

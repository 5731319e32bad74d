#include "libio/export/scene_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"

namespace whirl::inline io {

SceneSource::SceneSource(Model of_model, std::unique_ptr<ResultReader> of)
    : result(std::move(of)),
      model(std::move(of_model)),
      assembler(linear_structure(model)),
      scene(vtk_scene(model, assembler)) {}

MotionSamples SceneSource::samples(const MotionWindow& window, double usual) const {
  MotionSamples samples = samples_of(window, recorded_motion(*result), usual);
  // both ends of the last revolutions are the same phase, of which a video in a loop shows one
  const bool is_end = !window.from_revolution && !window.times;
  if (is_end && samples.first > 0) ++samples.first;
  return samples;
}

std::vector<VtkFrame> SceneSource::motion(const MotionSamples& samples, long most) const {
  const auto recorded = read_result<MotionRecord>(*result);
  const auto count = samples.size();
  const auto frames = std::min<Eigen::Index>(count, most);
  const auto contacts = static_cast<Eigen::Index>(model.contacts.size());
  Mat normal = Mat::Zero(contacts, recorded.time.size()), friction = normal;
  if (recorded.normal.size() > 0) normal = recorded.normal, friction = recorded.friction;
  const int dofs = assembler.dofs().full_size;
  if (recorded.basis.rows() != dofs || normal.rows() != contacts) {
    throw ModelError({}, "",
                     fmt::format("the motion is of another rotor ({} degrees of freedom, {} "
                                 "contacts) than the model as set "
                                 "({}, {}): leave out --set",
                                 recorded.basis.rows(), normal.rows(), dofs, contacts));
  }
  std::vector<VtkFrame> list;
  for (Eigen::Index k = 0; k < frames; ++k) {
    const auto j = samples.first + k * count / frames;
    list.push_back(vtk_frame(model, assembler, recorded.time(j),
                             recorded.basis * recorded.coordinates.col(j), normal.col(j),
                             friction.col(j)));
  }
  return list;
}

void SceneSource::each_mode(
    long count, int frames,
    const std::function<void(int, const Mode&, const std::vector<VtkFrame>&)>& use) const {
  const System system = assembler.at(model.speed);
  const Modes modes = complex_modes(assembler, model.speed, static_cast<int>(count));
  int number = 0;
  for (const Mode& mode : modes.oscillatory) {
    ++number;
    use(number, mode, vtk_mode_frames(mode, system.dofs, scene, frames));
  }
}

std::string told(int number, const Mode& mode) {
  return fmt::format("mode {} at {:.1f} rpm, {}", number, mode.frequency() / rpm,
                     name_of(mode.whirl));
}

}  // namespace whirl::inline io

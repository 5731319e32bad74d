#include "libio/page/motion_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libio/export/vtk_scene.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

constexpr Eigen::Index most_numbers = 400'000;  ///< of a motion: 1.6 MB
constexpr double most_revolutions = 24.0;

/// How far the surface of a stator is from its middle, all around [m].
Record reaches(const VtkStator& s) {
  constexpr int directions = 64;  // those of web/space.js
  Record all = Record::array();
  for (int i = 0; i < directions; ++i) {
    const double angle = turn * i / directions;
    all.add(reach_of(s.geometry, s.clearance, {std::cos(angle), std::sin(angle)}));
  }
  return all;
}

Record scene_record(const VtkScene& scene) {
  Record shaft = Record::array(), disks = Record::array(), stators = Record::array();
  for (const VtkShaftPiece& p : scene.shaft) {
    Record r;
    r.set("left", p.left).set("right", p.right);
    shaft.add(r.set("left_radius", p.left_radius).set("right_radius", p.right_radius));
  }
  for (const VtkDisk& d : scene.disks) {
    Record r;
    r.set("name", d.name).set("point", d.point).set("outer", d.outer_radius);
    if (!d.not_given.empty()) r.set("not_given", d.not_given);
    disks.add(r.set("inner", d.inner_radius).set("width", d.width));
  }
  for (std::size_t i = 0; i < scene.stators.size(); ++i) {
    const VtkStator& s = scene.stators[i];
    Record r;
    r.set("name", s.name).set("point", s.point).set("z", s.z);
    r.set("x", s.offset(0)).set("y", s.offset(1)).set("radius", s.rotor_radius);
    r.set("clearance", s.clearance).set("rotor", scene.contacts[i].point);
    if (const auto n = direction_of(s.geometry)) {
      r.set("direction", Record::Array{(*n)(0), (*n)(1)});
    }
    if (is_wall(s.geometry)) r.set("reach", reaches(s));
    stators.add(r);
  }
  Record supports = Record::array();
  for (const VtkSupport& s : scene.supports) {
    Record r;
    r.set("name", s.name).set("from", s.from).set("to", s.to).set("z", s.z);
    supports.add(r.set("tip", s.tip).set("foot", s.foot).set("width", s.width));
  }
  Record r;
  r.set("z", scene.z).set("shaft", shaft).set("disks", disks).set("supports", supports);
  if (const std::string told = symbols_told(scene); !told.empty()) r.set("symbols", told);
  return r.set("stators", stators);
}

/// Rows of full vectors (x, y, theta_x, theta_y of every point), -1 where there is none.
std::vector<int> rows_of(const DofMap& dofs) {
  std::vector<int> rows;
  for (const Point& p : dofs.points()) {
    for (int c = 0; c < 4; ++c) rows.push_back(dofs.full_index(p, c));
  }
  return rows;
}

/// The last revolutions of a trajectory.
Record trajectory_record(const ResultView& result, const std::vector<int>& rows, int full_size,
                         ArrayStore& arrays) {
  Record r;
  const auto& motion = figures::result_of<MotionRecord>(result);
  const Vec& time = motion.time;
  if (motion.basis.rows() != full_size || time.size() == 0) return r;
  const double samples = figures::result_of<RunFacts>(result).samples_per_revolution;
  const auto per_frame = static_cast<Eigen::Index>(rows.size());
  const Eigen::Index count =
      std::min({time.size(), static_cast<Eigen::Index>(most_revolutions * samples),
                most_numbers / std::max<Eigen::Index>(1, per_frame)});
  const Eigen::Index first = time.size() - count;
  std::vector<double> places, times, forces;
  for (Eigen::Index j = first; j < time.size(); ++j) {
    const Vec q = motion.basis * motion.coordinates.col(j);
    for (const int row : rows) places.push_back(row < 0 ? 0.0 : q(row));
    times.push_back(time(j));
    for (Eigen::Index c = 0; c < motion.normal.rows(); ++c) forces.push_back(motion.normal(c, j));
  }
  r.set("name", "the end of the motion").set("kind", "motion");
  r.set("times", arrays.add(times)).set("places", arrays.add(places));
  r.set("forces", arrays.add(forces));
  r.set("samples", samples);
  return r;
}

/// Responses to unbalance at their peaks, of the model at all points; tilts are the slopes of the
/// displacements from node to node.
void add_responses(const ResultView& result, const DofMap& dofs, Record& motions,
                   ArrayStore& arrays) {
  const auto& study = figures::result_of<UnbalanceStudy>(result);
  Mat major(std::ssize(study.stations), std::ssize(study.speeds));
  for (Eigen::Index i = 0; i < major.rows(); ++i) {
    major.row(i) = study.stations[static_cast<std::size_t>(i)].major;
  }
  std::vector<double> speeds;
  for (const Eigen::Index k : figures::deflection_peaks(major)) {
    const double speed = study.speeds[static_cast<std::size_t>(k)];
    if (speed > 0.0) speeds.push_back(speed);
  }
  const std::vector<Point> points = dofs.points();
  const UnbalanceResponse response = unbalance_response(*result.assembler, speeds, points);
  const Mesh& mesh = result.assembler->mesh();
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    const auto column = static_cast<Eigen::Index>(s);
    CMat motion = CMat::Zero(static_cast<Eigen::Index>(points.size()), 4);
    motion.col(0) = response.x.col(column);
    motion.col(1) = response.y.col(column);
    for (const std::vector<int>& order : mesh.lines()) {
      for (std::size_t i = 0; order.size() > 1 && i < order.size(); ++i) {
        const auto left = static_cast<std::size_t>(order[i > 0 ? i - 1 : 0]);
        const auto right = static_cast<std::size_t>(order[std::min(i + 1, order.size() - 1)]);
        const double length = mesh.z[right] - mesh.z[left];
        const auto slope = [&](int c) {
          return (motion(static_cast<Eigen::Index>(right), c) -
                  motion(static_cast<Eigen::Index>(left), c)) /
                 length;
        };
        motion(order[i], 2) = -slope(1);
        motion(order[i], 3) = slope(0);
      }
    }
    std::vector<double> re, im;
    double forward = 0.0, backward = 0.0;
    for (Eigen::Index p = 0; p < motion.rows(); ++p) {
      for (int c = 0; c < 4; ++c) {
        re.push_back(motion(p, c).real());
        im.push_back(motion(p, c).imag());
      }
      forward += std::norm(motion(p, 0) + Complex(0, 1) * motion(p, 1));
      backward += std::norm(motion(p, 0) - Complex(0, 1) * motion(p, 1));
    }
    Record r;
    r.set("kind", "mode").set("whirl", forward >= backward ? "forward" : "backward");
    r.set("name", "Unbalance response at " + shown_value(speeds[s], "rpm", ".0f"));
    r.set("about", "One revolution of the steady motion, without contacts.");
    motions.add(r.set("re", arrays.add(re)).set("im", arrays.add(im)));
  }
}

}  // namespace

Record motion_record(const ResultView& result, ArrayStore& arrays) {
  Record r, motions = Record::array();
  if (!result.assembler) return r;
  const DofMap& dofs = result.assembler->dofs();
  const std::vector<int> rows = rows_of(dofs);
  bool moves = false;
  if (result.file.has(dataset_of<MotionRecord>(&MotionRecord::coordinates))) {
    motions.add(trajectory_record(result, rows, dofs.full_size, arrays));
    moves = true;
  }
  if (result.file.has(dataset_of<ModesAtPoints>(&ModesAtPoints::shape))) {
    const auto& modes = figures::result_of<ModesAtPoints>(result);
    const CMat& shapes = modes.shape;
    for (Eigen::Index k = 0; k < shapes.cols() && shapes.rows() == dofs.full_size; ++k) {
      std::vector<double> re, im;
      for (const int row : rows) {
        re.push_back(row < 0 ? 0.0 : shapes(row, k).real());
        im.push_back(row < 0 ? 0.0 : shapes(row, k).imag());
      }
      const Mode& of = modes.oscillatory.at(static_cast<std::size_t>(k));
      const std::string_view sense = name_of(of.whirl);
      Record mode;
      mode.set("kind", "mode").set("whirl", sense);
      mode.set("about", "One cycle of the mode, damping left out; it has no amplitude of its own.");
      mode.set("name", fmt::format("Mode {} | {:.2f} Hz ({:.0f} cpm) | {} | log dec {:.3f}", k + 1,
                                   of.frequency() / rpm / 60.0, of.frequency() / rpm, sense,
                                   of.log_decrement()));
      motions.add(mode.set("re", arrays.add(re)).set("im", arrays.add(im)));
      moves = true;
    }
  }
  if (result.file.has(dataset_of<UnbalanceStudy>(&StationResponse::major))) {
    add_responses(result, dofs, motions, arrays);
    moves = true;
  }
  if (!moves) return r;
  return scene_record(vtk_scene(*result.model, *result.assembler)).set("motions", motions);
}

}  // namespace whirl::inline io

#include "libdata/measured/measured_identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdata/measured/record_doubts.hpp"
#include "libdyn/motions/motion_lines.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/campbell.hpp"

namespace whirl::inline data {

namespace {

constexpr Eigen::Index fewest_samples = 16;

/// Positions along the shaft; of probes at bodies NaN.
Vec positions_of(const std::vector<Probe>& probes, const Assembler& assembler) {
  Vec z(std::ssize(probes));
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto position = assembler.mesh().position_of(assembler.point(probes[i].at));
    z(static_cast<Eigen::Index>(i)) = position.value_or(std::nan(""));
  }
  return z;
}

/// Readings of modes, those that no probe sees as none at all: what is left of these is rounding,
/// and would be like something.
CMat seen(CMat shapes) {
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    if (shapes.col(i).cwiseAbs().maxCoeff() < unseen_reading) shapes.col(i).setZero();
  }
  return shapes;
}

/// What the probes cannot tell of modes.
/// @param shapes  as they are seen
void add_doubts(MeasuredIdentification& result, const CMat& shapes, const Sparse& weights) {
  const Eigen::Index modes = shapes.cols();
  std::vector<bool> is_seen;
  for (Eigen::Index i = 0; i < modes; ++i) {
    is_seen.push_back(!shapes.col(i).isZero(0.0));
    if (!is_seen.back()) result.unseen.push_back(static_cast<int>(i) + 1);
  }
  result.auto_mac.resize(modes, modes);
  for (Eigen::Index i = 0; i < modes; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double alike = mac(shapes.col(i), shapes.col(j), weights);
      result.auto_mac(i, j) = result.auto_mac(j, i) = alike;
      const auto first = static_cast<std::size_t>(j), second = static_cast<std::size_t>(i);
      if (i == j || !(alike > indistinct_mac) || !is_seen[first] || !is_seen[second]) continue;
      result.indistinct.push_back({static_cast<int>(j) + 1, static_cast<int>(i) + 1, alike});
    }
  }
}

void note_probes(const std::vector<ProbedStation>& stations, std::vector<std::string>& notes) {
  std::string names;
  for (const ProbedStation& s : stations) {
    if (s.is_planar) names += (names.empty() ? "" : ", ") + s.name;
  }
  if (names.empty()) return;
  notes.push_back(
      fmt::format("at {} probes see one direction only: forward and backward motions "
                  "look alike there",
                  names));
}

}  // namespace

CMat readings_of(const std::vector<Mode>& modes, const std::vector<Probe>& probes,
                 const Scene& scene) {
  const DofMap& dofs = scene.system.dofs;
  CMat readings(std::ssize(probes), std::ssize(modes));
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const CVec full = dofs.T.cast<Complex>() * modes[m].shape;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const Point point = scene.assembler.point(probes[i].at);
      readings(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(m)) =
          probes[i].reading([&](int c) { return full(dofs.full_index(point, c)); });
    }
  }
  return readings;
}

MeasuredIdentification identify(const Model& model, const Scene& scene,
                                const ProbeReadings& readings, const IdentifyOptions& options) {
  if (readings.probes.empty()) {
    throw OptionError("probes", "there are none: expected some of a file or of the model");
  }
  if (readings.displacement.rows() < fewest_samples) {
    throw OptionError(fmt::format("the record has {} samples, expected {} or more",
                                  readings.displacement.rows(), fewest_samples));
  }
  MeasuredIdentification result{.speed = model.speed, .notes = readings.notes};
  result.probes.assign(readings.probes.begin(), readings.probes.end());
  result.probe_z = positions_of(readings.probes, scene.assembler);
  const std::vector<ProbedStation> stations = probed_stations(readings.probes, scene.assembler);
  const MeasuredSpectra spectra = spectra_of(readings, stations, model.speed);
  const Eigen::Index n = spectra.probes.rows();
  result.duration = static_cast<double>(n) / readings.rate;
  note_probes(stations, result.notes);
  add_doubts(readings, stations, spectra, model.speed, result.notes);

  result.is_in_one_direction = std::all_of(stations.begin(), stations.end(),
                                           [](const ProbedStation& s) { return s.is_planar; });
  MotionLines lines{.bin = spectra.bin, .total = spectra.stations.rowwise().norm()};
  // what moves along lines alone has two equal halves, which are one motion without a sense
  if (result.is_in_one_direction) lines.total.tail((n - 1) / 2).setZero();
  const double halves = result.is_in_one_direction ? 2.0 : 1.0;
  lines.radius = [&](Eigen::Index k) {
    return halves * spectra.stations.row(spectra.row(k)).cwiseAbs().maxCoeff();
  };
  lines.shape = [&](Eigen::Index k) -> CVec {
    const double halves_of_line = k == 0 || 2 * std::abs(k) == n ? 1.0 : 2.0;
    return halves_of_line * spectra.probes.row(spectra.row(std::abs(k))).transpose();
  };
  std::vector<Mode> modes = compared_modes(model, scene, options);
  const CMat read = readings_of(modes, readings.probes, scene), shapes = seen(read);
  Sparse weights(shapes.rows(), shapes.rows());
  weights.setIdentity();
  result.found = identify(lines, std::move(modes), shapes, weights,
                          forced_lines(scene.assembler, model.speed), model.speed, options);
  if (result.is_in_one_direction) {  // what the rotor would see is of senses
    result.found.resonance.reset();
    for (IdentifiedPeak& peak : result.found.peaks) peak.frequency_rotating = std::nan("");
  }
  result.mode_readings = read.transpose();
  add_doubts(result, shapes, weights);

  result.deflection.resize(std::ssize(result.found.peaks), shapes.rows());
  for (std::size_t i = 0; i < result.found.peaks.size(); ++i) {
    const auto k = std::lround(result.found.peaks[i].frequency / spectra.bin);
    result.deflection.row(static_cast<Eigen::Index>(i)) = lines.shape(k).transpose();
  }
  const Eigen::Index half = n / 2;  // backward to the left
  result.frequency = spectra.bin * Vec::LinSpaced(n, -static_cast<double>(half),
                                                  static_cast<double>(n - 1 - half));
  for (std::size_t s = 0; s < stations.size(); ++s) {
    Vec amplitude(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      amplitude(k) =
          std::abs(spectra.stations(spectra.row(k - half), static_cast<Eigen::Index>(s)));
    }
    result.stations.push_back({stations[s].name, amplitude});
  }
  return result;
}

}  // namespace whirl::inline data

#include "libdyn/measured/measured_identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libbase/statistics.hpp"
#include "libdyn/measured/station_motion.hpp"
#include "libdyn/motions/motion_lines.hpp"
#include "libfe/campbell.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double even_drift = 0.02;  ///< of a spectral line, that uneven revolutions may make
constexpr Eigen::Index fewest_samples = 16;
constexpr double hardly_there = 0.02;   ///< of the largest line, below which one may be noise
constexpr double turns_backward = 3.0;  ///< times the forward part of a line, from which it is said
constexpr double too_high = 0.8;      ///< of half the samples per second, above which little may be
constexpr double alias_share = 0.05;  ///< of the largest line, for one that is too high
constexpr double unlike_size = 10.0;  ///< times what another probe of the station reads
constexpr double no_line = 3.0;       ///< times the lines about it, that a line stands out by

/// How many samples at the end of a record are transformed.
Eigen::Index transformed_samples(const ProbeReadings& readings, double Omega) {
  const Eigen::Index all = readings.displacement.rows();
  const double per_turn = turn * readings.rate / Omega;
  const double whole = std::round(per_turn);
  const double turns = static_cast<double>(all) / whole;
  if (Omega > 0.0 && turns >= 1.0 && std::abs(per_turn / whole - 1.0) * turns < even_drift) {
    const auto samples = static_cast<Eigen::Index>(whole);
    return smooth_length(all / samples) * samples;
  }
  return smooth_length(all);
}

/// Spectra of the readings of probes and of the motion of stations.
struct MeasuredSpectra {
  double bin = 0.0;
  CMat probes;    ///< lines x probes
  CMat stations;  ///< lines x stations, of x + i y

  Eigen::Index row(Eigen::Index k) const {
    return (k % probes.rows() + probes.rows()) % probes.rows();
  }
};

MeasuredSpectra spectra_of(const ProbeReadings& readings,
                           const std::vector<ProbedStation>& stations, double Omega) {
  const Eigen::Index n = transformed_samples(readings, Omega);
  MeasuredSpectra spectra;
  spectra.probes.resize(n, readings.displacement.cols());
  for (Eigen::Index i = 0; i < readings.displacement.cols(); ++i) {
    const Vec samples = readings.displacement.col(i).tail(n);
    const Spectrum s = hann_spectrum((samples.array() - samples.mean()).matrix().cast<Complex>(),
                                     1.0 / readings.rate);
    spectra.probes.col(i) = s.lines;
    spectra.bin = s.bin;
  }
  spectra.stations.setZero(n, std::ssize(stations));
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const Mat& to_plane = stations[s].to_plane;
    for (std::size_t i = 0; i < stations[s].probes.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      spectra.stations.col(static_cast<Eigen::Index>(s)) +=
          Complex(to_plane(0, c), to_plane(1, c)) * spectra.probes.col(stations[s].probes[i]);
    }
  }
  return spectra;
}

/// What the probes read of the modes, probes x modes.
CMat readings_of(const std::vector<Mode>& modes, const std::vector<Probe>& probes,
                 const Scene& scene) {
  const DofMap& dofs = scene.system.dofs;
  CMat readings(std::ssize(probes), std::ssize(modes));
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const CVec full = dofs.T.cast<Complex>() * modes[m].shape;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const Point point = scene.assembler.point(probes[i].at);
      readings(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(m)) =
          probes[i].along(full(dofs.full_index(point, X)), full(dofs.full_index(point, Y)));
    }
  }
  return readings;
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

/// Notes stations where the speed's own line turns backward: in most cases that is a mistake.
void note_backward(const MeasuredSpectra& spectra, const std::vector<ProbedStation>& stations,
                   double Omega, std::vector<std::string>& notes) {
  const auto line = static_cast<Eigen::Index>(std::lround(Omega / spectra.bin));
  if (line < 2) return;
  std::string names;
  std::size_t backward = 0, open = 0;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    if (stations[s].is_planar) continue;
    ++open;
    const auto c = static_cast<Eigen::Index>(s);
    const double f = std::abs(spectra.stations(spectra.row(line), c));
    const double b = std::abs(spectra.stations(spectra.row(-line), c));
    const double largest = spectra.stations.col(c).cwiseAbs().maxCoeff();
    if (!(b > turns_backward * f) || b < hardly_there * largest) continue;
    ++backward;
    names += (names.empty() ? "" : ", ") + stations[s].name;
  }
  if (backward == 0) return;
  notes.push_back(fmt::format(
      "1X turns backward at {}: {}", names,
      backward == open
          ? "probes are swapped, an angle or gain has the wrong sign, the rotor turns the other "
            "way, or the speed is between criticals of anisotropic supports"
          : "and forward elsewhere: are probes swapped there, or has an angle or gain the wrong "
            "sign?"));
}

/// Notes what says that the samples were taken too slowly.
void note_aliases(const MeasuredSpectra& spectra, double rate, double Omega,
                  std::vector<std::string>& notes) {
  const double per_turn = turn * rate / Omega;
  if (Omega > 0.0 && per_turn < 2.0) {
    notes.push_back(fmt::format(
        "{:.3g} samples per revolution: the speed and all above it stand at wrong, lower "
        "frequencies",
        per_turn));
    return;
  }
  const Eigen::Index n = spectra.probes.rows();
  const auto begin = static_cast<Eigen::Index>(0.5 * too_high * static_cast<double>(n));
  const Vec lines = spectra.stations.rowwise().norm();
  Eigen::Index at = 0;
  const double largest = lines.segment(begin, n - 2 * begin).maxCoeff(&at);
  if (largest < alias_share * lines.maxCoeff()) return;
  const Eigen::Index k = std::min(begin + at, n - begin - at);
  notes.push_back(fmt::format(
      "{:.6g} rpm is near half the samples per second: what is faster than that stands at wrong, "
      "lower frequencies, unless a filter was before the sampling",
      spectra.bin * static_cast<double>(k) / rpm));
}

/// Notes probes of a station of which one reads much less than another.
void note_sizes(const ProbeReadings& readings, const std::vector<ProbedStation>& stations,
                std::vector<std::string>& notes) {
  const Mat& u = readings.displacement;
  const Vec size = (u.rowwise() - u.colwise().mean()).colwise().norm().transpose();
  for (const ProbedStation& s : stations) {
    const auto [small, large] = std::minmax_element(
        s.probes.begin(), s.probes.end(), [&](int a, int b) { return size(a) < size(b); });
    if (!(size(*small) > 0.0) || size(*large) < unlike_size * size(*small)) continue;
    const auto name = [&](int i) { return readings.probes[static_cast<std::size_t>(i)].name; };
    notes.push_back(fmt::format(
        "probe \"{}\" reads {:.3g} times what \"{}\" at its station does: are their gains and "
        "units right, and both connected?",
        name(*large), size(*large) / size(*small), name(*small)));
  }
}

/// Notes that nothing in the record turns with a speed that no key-phasor told.
void note_speed(const MeasuredSpectra& spectra, double Omega, std::vector<std::string>& notes) {
  const Vec lines = spectra.stations.rowwise().norm();
  const Eigen::Index n = lines.size(), near = 2, far = 12;
  const auto line = static_cast<Eigen::Index>(std::lround(Omega / spectra.bin));
  if (line <= far || line + far >= n / 2) return;
  const auto about = [&](Eigen::Index k) {  // forward and backward
    return std::hypot(lines(spectra.row(k)), lines(spectra.row(-k)));
  };
  double there = 0.0;
  std::vector<double> beside;
  for (Eigen::Index k = line - far; k <= line + far; ++k) {
    if (std::abs(k - line) <= near) {
      there = std::max(there, about(k));
    } else {
      beside.push_back(about(k));
    }
  }
  if (there > no_line * median_of(std::move(beside))) return;
  notes.push_back(fmt::format(
      "nothing in the record turns with {:.6g} rpm: is that its speed? A key-phasor tells it",
      Omega / rpm));
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
  const std::vector<ProbedStation> stations = probed_stations(readings.probes, scene.assembler);
  const MeasuredSpectra spectra = spectra_of(readings, stations, model.speed);
  const Eigen::Index n = spectra.probes.rows();
  result.duration = static_cast<double>(n) / readings.rate;
  note_probes(stations, result.notes);
  note_sizes(readings, stations, result.notes);
  note_aliases(spectra, readings.rate, model.speed, result.notes);
  if (!readings.clock) note_speed(spectra, model.speed, result.notes);
  note_backward(spectra, stations, model.speed, result.notes);

  MotionLines lines{.bin = spectra.bin, .total = spectra.stations.rowwise().norm()};
  lines.radius = [&](Eigen::Index k) {
    return spectra.stations.row(spectra.row(k)).cwiseAbs().maxCoeff();
  };
  lines.shape = [&](Eigen::Index k) -> CVec {
    return 2.0 * spectra.probes.row(spectra.row(std::abs(k))).transpose();
  };
  std::vector<Mode> modes = compared_modes(model, scene, options);
  const CMat read = readings_of(modes, readings.probes, scene), shapes = seen(read);
  Sparse weights(shapes.rows(), shapes.rows());
  weights.setIdentity();
  result.found = identify(lines, std::move(modes), shapes, weights,
                          forced_lines(scene.assembler, model.speed), model.speed, options);
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

}  // namespace whirl::inline dyn

#include "libdata/measured/record_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/statistics.hpp"

namespace whirl::inline data {

namespace {

constexpr double hardly_there = 0.02;   ///< of the largest line, below which one may be noise
constexpr double turns_backward = 3.0;  ///< times the forward part of a line, from which it is said
constexpr double too_high = 0.8;      ///< of half the samples per second, above which little may be
constexpr double alias_share = 0.05;  ///< of the largest line, for one that is too high
constexpr double unlike_size = 10.0;  ///< times what another probe of the station reads
constexpr double no_line = 3.0;       ///< times the lines about it, that a line stands out by

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
    // else it is the foot of another line
    const auto beside = [&](Eigen::Index k) {
      return std::abs(spectra.stations(spectra.row(-line + k), c));
    };
    if (!(b > beside(-2) && b > beside(2))) continue;
    ++backward;
    names += (names.empty() ? "" : ", ") + stations[s].name;
  }
  if (backward == 0) return;
  notes.push_back(fmt::format(
      "1X turns backward at {}: {}", names,
      backward == open
          ? "probes are swapped, an angle or gain has the wrong sign, the rotor turns the other "
            "way, a rub drives it back, or the speed is between criticals of anisotropic supports"
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

}  // namespace

void add_doubts(const ProbeReadings& readings, const std::vector<ProbedStation>& stations,
                const MeasuredSpectra& spectra, double Omega, std::vector<std::string>& notes) {
  note_sizes(readings, stations, notes);
  note_aliases(spectra, readings.rate, Omega, notes);
  if (!readings.clock) note_speed(spectra, Omega, notes);
  note_backward(spectra, stations, Omega, notes);
}

void add_doubts(const ProbeReadings& readings, const Assembler& assembler, double Omega,
                std::vector<std::string>& notes) {
  const std::vector<ProbedStation> stations = probed_stations(readings.probes, assembler);
  add_doubts(readings, stations, spectra_of(readings, stations, Omega), Omega, notes);
}

}  // namespace whirl::inline data

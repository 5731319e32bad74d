#pragma once
/// Which complex modes make up a measured motion, as far as the probes can tell.

#include <string>
#include <vector>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/motions/identify.hpp"
#include "libdyn/system/probes.hpp"

namespace whirl::inline data {

/// Two modes that look alike where the probes are.
struct IndistinctModes {
  int first = 0, second = 0;  ///< from 1
  double mac = 0.0;           ///< of their readings

  static constexpr auto columns() {
    using I = IndistinctModes;
    return ColumnList{column("first", &I::first, "", "number of a mode"),
                      column("second", &I::second, "", "number of another one"),
                      column("mac", &I::mac, "", "of what probes read of both")};
  }
};

/// Full spectrum of a station: of x + i y, or along the one direction that its probes see.
struct StationFullSpectrum {
  std::string station;  ///< its probes
  Vec amplitude;        ///< per line [m]

  static constexpr auto columns() {
    using S = StationFullSpectrum;
    return ColumnList{column("station", &S::station, "", "probes of a station").axis(),
                      column("amplitude", &S::amplitude, "m",
                             "radius of the circle at a signed frequency (Hann window)")
                          .along("measured_lines")};
  }
};

/// What is measured and compared with a model; group /measured. Peaks are an Identification.
struct MeasuredIdentification {
  Identification found;
  double speed = 0.0;     ///< of the rotor in the record [rad/s]
  double duration = 0.0;  ///< of what was transformed [s]
  /// Whether every station is seen in one direction only. Peaks then have no sense of whirl, their
  /// frequencies are positive, and their amplitudes are those along the directions.
  bool is_in_one_direction = false;
  std::vector<ProbeLabel> probes;
  Vec probe_z;    ///< positions of the probes along the shaft; NaN: at a body [m]
  Vec frequency;  ///< signed, ascending [rad/s]
  std::vector<StationFullSpectrum> stations;
  CMat deflection;     ///< peaks x probes: readings Re(u e^(i |w| t)) [m]
  CMat mode_readings;  ///< modes x probes, of shapes whose largest radius is one
  Mat auto_mac;        ///< modes x modes, of their readings
  std::vector<IndistinctModes> indistinct;
  std::vector<int> unseen;  ///< numbers of modes that move no probe, from 1
  std::vector<std::string> notes;

  static constexpr std::string_view group = "/measured";
  static constexpr auto columns() {
    using enum Written;
    using M = MeasuredIdentification;
    return ColumnList{
        column("speed", &M::speed, "rad/s", "speed of the rotor in the record").only(in_file),
        column("duration", &M::duration, "s", "length of the record that was transformed"),
        column("one_direction", &M::is_in_one_direction, "",
               "1: stations are seen in one direction only, peaks have no sense of whirl")
            .only(in_json),
        rows(&M::probes, "probes").prefixed("probe_"),
        column("probe_z", &M::probe_z, "m", "position of a probe along the shaft; NaN: at a body")
            .along("probes")
            .only(in_file)
            .maybe(),
        column("spectrum_frequency", &M::frequency, "rad/s", "signed frequency, forward > 0")
            .axis("measured_lines+")
            .within(valid::finite)
            .only(in_file),
        rows(&M::stations, "measured_stations+").only(in_file),
        column("deflection", &M::deflection, "m", "complex readings of the probes at the peaks")
            .along("/mac/frequency probes")
            .maybe(),
        column("mode_reading", &M::mode_readings, "", "complex readings of the probes in the modes")
            .along("/modes/number probes")
            .maybe()
            .only(in_file),
        column("auto_mac", &M::auto_mac, "", "MAC of the modes among themselves at the probes")
            .along("/modes/number /modes/number")
            .maybe(),
        rows(&M::indistinct, "indistinct_modes").only(in_json),
        column("unseen_modes", &M::unseen, "", "numbers of modes that move no probe")
            .only(in_json)};
  }
};

/// MAC of two modes at the probes from which on they cannot be told apart.
constexpr double indistinct_mac = 0.9;
/// Largest reading of a mode, over its largest radius, below which the probes do not see it.
constexpr double unseen_reading = 1e-3;

/// What the probes read of modes, complex, probes x modes.
/// @param scene  whose points the shapes are of
CMat readings_of(const std::vector<Mode>& modes, const std::vector<Probe>& probes,
                 const Scene& scene);

/// Identifies the modes in a steady measured motion.
///
/// Peaks are those of the full spectra of all stations together, under a Hann window over the
/// longest part at the end of the record with whole revolutions, where samples go evenly into
/// these; else over all but a few samples. Deflection shapes are complex readings of the probes,
/// and so are the modes. If probes along x and y of every node and body read a motion of the model,
/// its MAC is the same as without probes.
///
/// @param model    with its speed, at which the record was taken
/// @param scene    of it
/// @throws OptionError  for a record of fewer than 16 samples, or without probes
MeasuredIdentification identify(const Model& model, const Scene& scene,
                                const ProbeReadings& readings, const IdentifyOptions& options);

}  // namespace whirl::inline data

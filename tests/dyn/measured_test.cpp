// Measured motions: pulses and phase of a key-phasor, stations from probes at any angles, what is
// noticed of bad records, and modes that few probes cannot tell apart.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "libbase/error.hpp"
#include "libbase/numerics/random.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libdata/measured/turned_samples.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::measured_test {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;

bool has_note(const std::vector<std::string>& notes, const std::string& part) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

// ---- key-phasor ---------------------------------------------------------------------------------

// A straight edge between two samples crosses the threshold where the line does, at any offset.
TEST(KeyPhasor, LocatesPulsesBetweenSamples) {
  MeasuredRecord record{.rate = 1000.0, .start = 2.0};
  constexpr double first = 0.01234, apart = 0.05071;  // [s] after the start
  Vec samples = Vec::Zero(1000);
  for (Eigen::Index j = 0; j < samples.size(); ++j) {
    const double t = static_cast<double>(j) / record.rate;
    const double since = std::fmod(t - first + apart / 2 + apart, apart) - apart / 2;
    samples(j) =
        std::clamp(0.5 + since / 0.004, 0.0, 1.0) - std::clamp((since - 0.01) / 0.004, 0.0, 1.0);
  }
  const std::vector<double> times = pulse_times(samples, record, {});
  ASSERT_EQ(times.size(), 20u);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], 2.0 + first + apart * static_cast<double>(i), 1e-12);
  }
}

TEST(KeyPhasor, CountsNoPulseTwiceBecauseOfNoise) {
  const MeasuredRecord record{.rate = 100.0};
  Vec samples(12);
  samples << 0.0, 0.49, 0.51, 0.49, 0.52, 1.0, 1.0, 0.0, 0.0, 0.6, 1.0, 0.0;
  EXPECT_EQ(pulse_times(samples, record, {}).size(), 2u);
}

// Phase 2 pi (f t + r t^2 / 2) of a rotor that speeds up evenly: exact between any pulses.
TEST(TurnClock, IsExactWhereSpeedChangesEvenly) {
  constexpr double f = 10.0, r = 8.0;  // [1/s], [1/s^2]
  std::vector<double> pulses, quiet;
  for (int i = 0; i < 30; ++i) {
    pulses.push_back((-f + std::sqrt(f * f + 2.0 * r * i)) / r);
    quiet.push_back(0.1 * i);
  }
  std::vector<std::string> notes;
  const TurnClock clock(pulses, {.angle = 0.3}, notes);
  // the cubic takes its slopes from parabolas of pulses over time, which these are
  for (const double t : {0.03, 0.5, 1.0, 1.63}) {
    EXPECT_NEAR(clock.angle(t), 0.3 + 2.0 * pi * (f * t + 0.5 * r * t * t), 1e-9);
    EXPECT_NEAR(clock.speed(t), 2.0 * pi * (f + r * t), 1e-8);
  }
  EXPECT_TRUE(notes.empty());
  EXPECT_NEAR(TurnClock(quiet, {.pulses = 2}, notes).mean_speed(), 2.0 * pi * 5.0, 1e-9);
}

/// Pulses of a speed that rises slowly, but some.
std::vector<double> pulses_but(const std::vector<int>& left_out, double extra) {
  std::vector<double> pulses;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.1 * i - 1e-4 * i * i;
    if (std::find(left_out.begin(), left_out.end(), i) == left_out.end()) pulses.push_back(t);
    if (pulses.size() == 30 && extra > 0.0) pulses.push_back(pulses.back() + extra);
  }
  return pulses;
}

// The clock is that of all pulses: where some are missing to the fourth power of an interval over
// the time in which the speed changes.
TEST(TurnClock, PutsMissingPulsesBackAndLeavesExtraOnesOut) {
  std::vector<std::string> notes;
  const TurnClock all(pulses_but({}, 0.0), {}, notes);
  EXPECT_TRUE(notes.empty());
  const TurnClock mended(pulses_but({7, 20, 21, 58}, 0.0), {.channel = "key"}, notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("4 pulses are missing, the first at 0.695"), std::string::npos)
      << notes[0];
  EXPECT_EQ(mended.turns().size(), all.turns().size());
  EXPECT_NEAR(mended.angle(5.0), all.angle(5.0), 1e-9);
  EXPECT_NEAR(mended.mean_speed(), all.mean_speed(), 1e-12 * all.mean_speed());
  for (const double extra : {0.01, 0.045, 0.08}) {
    notes.clear();
    const TurnClock less(pulses_but({}, extra), {.channel = "key"}, notes);
    ASSERT_EQ(notes.size(), 1u) << extra;
    EXPECT_NE(notes[0].find("1 pulse is too many"), std::string::npos) << notes[0];
    EXPECT_NEAR(less.angle(3.0), all.angle(3.0), 1e-12) << extra;
  }
}

TEST(TurnClock, NotesPulsesThatItCannotMend) {
  std::vector<std::string> notes;
  const TurnClock clock({0.0, 0.1, 0.2, 0.4, 0.5, 0.6}, {}, notes);  // too few to say what is usual
  EXPECT_TRUE(has_note(notes, "pulses jumps"));
  EXPECT_THROW(TurnClock({0.0, 0.1}, {.channel = "key"}, notes), OptionError);
}

// ---- records ------------------------------------------------------------------------------------

TEST(MeasuredRecord, FillsGapsByStraightLines) {
  const MeasuredRecord record{.rate = 10.0};
  Vec samples = Vec::LinSpaced(101, 0.0, 100.0);
  samples(0) = samples(40) = samples(41) = samples(100) = std::nan("");
  std::vector<Gaps> gaps;
  const Vec filled = without_gaps(samples, record, "x", gaps);
  EXPECT_EQ(filled(0), 1.0);
  EXPECT_DOUBLE_EQ(filled(40), 40.0);
  EXPECT_DOUBLE_EQ(filled(41), 41.0);
  EXPECT_EQ(filled(100), 99.0);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].text(record), "channel \"x\": 4 of 101 samples are missing, the first at 0 s");
  samples.head(10).setConstant(std::nan(""));
  EXPECT_THROW(without_gaps(samples, record, "x", gaps), OptionError);
}

TEST(MeasuredRecord, TellsClippedSignalsFromCoarseOnes) {
  const Vec t = Vec::LinSpaced(4000, 0.0, 100.0);
  const Vec signal = t.array().sin();
  EXPECT_FALSE(is_clipped(signal));
  EXPECT_TRUE(is_clipped(signal.cwiseMin(0.9)));
  EXPECT_TRUE(is_clipped(signal.cwiseMax(-0.7)));
  EXPECT_FALSE(is_clipped((64.0 * signal.array()).round() / 64.0)) << "digitized in 128 steps";
}

// A spike stands out alone; a ball that bounces, noise and coarse steps have none.
TEST(MeasuredRecord, TellsSpikesFromSharpMotions) {
  const Vec t = Vec::LinSpaced(4000, 0.0, 100.0);
  Vec signal = t.array().sin();
  EXPECT_EQ(spikes_in(signal).count, 0);
  EXPECT_EQ(spikes_in(signal.cwiseAbs()).count, 0);
  EXPECT_EQ(spikes_in((8.0 * signal.array()).round() / 8.0).count, 0);
  EXPECT_EQ(spikes_in(Vec::Zero(100)).count, 0);
  EXPECT_EQ(spikes_in(Vec::Ones(2)).count, 0);
  signal(1000) += 8.0;
  signal(2000) -= 8.0;
  const Spikes spikes = spikes_in(signal);
  EXPECT_EQ(spikes.count, 2);
  EXPECT_EQ(spikes.first, 1000);
}

// ---- probes -------------------------------------------------------------------------------------

/// A forward ellipse of a rotor on springs, seen by probes at two angles.
struct SeenEllipse {
  double first = 0.0, second = 90.0;  ///< angles [deg]
  double forward = 2e-5, backward = 5e-6;
  bool is_swapped = false;
  double share_of_first = 1.0;  ///< samples of the first probe are cut off there

  const test::RotorStator rotor{};

  ProbeReadings readings() const {
    constexpr int samples = 64, turns = 20;
    ProbeReadings r{.rate = samples * rotor.Omega / (2.0 * pi)};
    r.probes = {{"a", test::body("rotor"), first * degree},
                {"b", test::body("rotor"), second * degree}};
    r.displacement.resize(samples * turns, 2);
    for (Eigen::Index j = 0; j < r.displacement.rows(); ++j) {
      const double angle = 2.0 * pi * static_cast<double>(j) / samples;
      const Complex z = forward * std::polar(1.0, angle) + backward * std::polar(1.0, 0.4 - angle);
      for (Eigen::Index i = 0; i < 2; ++i) {
        r.displacement(j, is_swapped ? 1 - i : i) = r.probes[static_cast<std::size_t>(i)].reading(
            [&](int c) { return c == 0 ? z.real() : z.imag(); });
      }
    }
    return r;
  }
  MeasuredIdentification found() const {
    const Model model = rotor.model();
    return identify(model, make_scene(model), readings(), {.modes = 4});
  }
};

// Full spectrum: the circles of an ellipse, whatever the angles of the probes.
TEST(MeasuredIdentification, FindsForwardAndBackwardCirclesByProbesAtAnyAngles) {
  for (const auto& [first, second] :
       {std::pair{0.0, 90.0}, {45.0, 135.0}, {10.0, 50.0}, {30.0, 200.0}}) {
    const SeenEllipse ellipse{.first = first, .second = second};
    const MeasuredIdentification found = ellipse.found();
    ASSERT_EQ(found.stations.size(), 1u);
    const auto at = [&](double frequency) {
      Eigen::Index line = 0;
      (found.frequency.array() - frequency).abs().minCoeff(&line);
      return found.stations[0].amplitude(line);
    };
    EXPECT_NEAR(at(ellipse.rotor.Omega), ellipse.forward, 1e-12) << first;
    EXPECT_NEAR(at(-ellipse.rotor.Omega), ellipse.backward, 1e-12) << first;
    ASSERT_FALSE(found.found.peaks.empty());
    EXPECT_NEAR(found.found.peaks[0].frequency, ellipse.rotor.Omega, 1e-6);
    EXPECT_EQ(found.found.peaks[0].forced, "1X");
    EXPECT_FALSE(has_note(found.notes, "backward"));
  }
}

TEST(MeasuredIdentification, NotesProbesThatSeeTheRotorTurnBackward) {
  EXPECT_TRUE(
      has_note(SeenEllipse{.is_swapped = true}.found().notes, "1X turns backward at a + b"));
  // read at +90, said to be at -90
  SeenEllipse ellipse;
  ProbeReadings readings = ellipse.readings();
  readings.probes[1].angle = -90.0 * degree;
  const Model model = ellipse.rotor.model();
  EXPECT_TRUE(has_note(identify(model, make_scene(model), readings, {}).notes, "an angle or gain"));
}

// Probes at the rotor see nothing of a stator that it does not touch. Along one direction a
// backward and a forward mode look alike.
TEST(MeasuredIdentification, SaysWhichModesTheProbesCannotTellApart) {
  const MeasuredIdentification found = SeenEllipse{}.found();
  ASSERT_EQ(found.auto_mac.rows(), 4);
  EXPECT_EQ(found.auto_mac, Mat(found.auto_mac.transpose()));
  EXPECT_EQ(found.unseen, (std::vector<int>{3, 4}));
  ASSERT_FALSE(found.found.peaks.empty());
  for (const IdentifiedPeak& peak : found.found.peaks) {  // nor is any motion like them
    ASSERT_EQ(peak.mac.size(), 4u);
    EXPECT_EQ(peak.mac[2] + peak.mac[3], 0.0);
    EXPECT_LT(peak.mode, 2);
  }
  EXPECT_NEAR(found.auto_mac(0, 0), 1.0, 1e-12);
  const SeenEllipse along_one{.first = 30.0, .second = 210.0};
  const MeasuredIdentification planar = along_one.found();
  EXPECT_TRUE(has_note(planar.notes, "one direction only"));
  ASSERT_EQ(planar.indistinct.size(), 1u);
  EXPECT_EQ(planar.indistinct[0].first, 1);
  EXPECT_EQ(planar.indistinct[0].second, 2);
}

TEST(ProbeReadings, TakesChannelsByGainAndUnit) {
  MeasuredRecord record{.rate = 100.0};
  record.channels = {{"x", "V"}, {"y", "m"}, {"3", ""}};
  record.samples = Mat::Ones(20, 3) * 2.0;
  record.samples.row(7) *= 1.5;
  MeasurementSetup setup;
  setup.probes = {{{"px", test::node(1)}, "x", {ProbeGain::Of::voltage, -8000.0}},
                  {{"py", test::node(1)}, "2", {ProbeGain::Of::length, -1.0}},
                  {{"pz", test::node(1)}, "3", {}, 1e-6}};
  const ProbeReadings readings = probe_readings(record, setup);
  EXPECT_DOUBLE_EQ(readings.displacement(0, 0), -2.0 / 8000.0);
  EXPECT_DOUBLE_EQ(readings.displacement(7, 1), -3.0);
  EXPECT_DOUBLE_EQ(readings.displacement(0, 2), 2e-6);
  EXPECT_TRUE(has_note(readings.notes, "read the same samples"));
  setup.probes = {{{"px", test::node(1)}, "w"}};
  EXPECT_THROW(probe_readings(record, setup), OptionError);
  setup.probes = {{{"px", test::node(1)}, "x"}};
  EXPECT_THROW(probe_readings(record, setup), OptionError) << "a voltage without a gain";
}

// Full scale is the recorder's: a recorder of 20 V gave displacements 20 times too small, with a
// note that 1 V was taken.
TEST(ProbeReadings, AskForTheFullScaleOfShares) {
  MeasuredRecord record{.rate = 100.0};
  record.channels = {{"1", share_of_full_scale}};
  record.samples = 0.5 * Mat::Ones(20, 1);
  record.samples(7, 0) = -0.25;
  const auto reading = [&](const MeasuredProbe& probe) {
    return probe_readings(record, {.probes = {probe}});
  };
  MeasuredProbe probe{{"px", test::node(1)}, "1", {ProbeGain::Of::voltage, -8000.0}};
  try {
    reading(probe);
    ADD_FAILURE() << "nobody said what full scale is";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("probe \"px\": samples of channel \"1\" are shares of "
                        "full scale"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("full_scale = \"10 V\""), std::string::npos);
  }
  probe.full_scale = FullScale{10.0, "V"};
  EXPECT_DOUBLE_EQ(reading(probe).displacement(0, 0), -5.0 / 8000.0);
  EXPECT_TRUE(reading(probe).notes.empty());
  probe.gain = {};
  EXPECT_THROW(reading(probe), OptionError) << "volts without a gain of them";
  probe.full_scale = FullScale{2e-3, "m"};
  EXPECT_DOUBLE_EQ(reading(probe).displacement(0, 0), 1e-3);
  probe.full_scale.reset();
  probe.is_unit_given = true;
  EXPECT_THROW(reading(probe), OptionError) << "a unit is not yet what full scale is";
  probe.gain = {ProbeGain::Of::number, 1000.0};
  EXPECT_DOUBLE_EQ(reading(probe).displacement(0, 0), 0.5e-3);
}

// A threshold in volts is none of shares: -10 V of 20 V are -0.5.
TEST(ProbeReadings, TakeThresholdsOfKeyPhasorsByTheirFullScale) {
  MeasuredRecord record{.rate = 100.0};
  record.channels = {{"x", "m"}, {"key", share_of_full_scale}};
  record.samples = 1e-6 * Mat::Random(200, 2);
  for (Eigen::Index j = 0; j < 200; ++j) record.samples(j, 1) = j % 20 < 2 ? -0.7 : -0.3;
  MeasurementSetup setup{{{{"px", test::node(1)}, "x"}},
                         KeyPhasor{.channel = "key", .threshold = -10.0}};
  setup.key_phasor->slope = PulseEdge::falling;
  setup.key_phasor->threshold_unit = "V";
  EXPECT_THROW(probe_readings(record, setup), OptionError);
  setup.key_phasor->full_scale = FullScale{20.0, "V"};
  const ProbeReadings readings = probe_readings(record, setup);
  EXPECT_NEAR(readings.clock->mean_speed(), 2.0 * std::numbers::pi * 5.0, 1e-9);
  record.channels[1].unit = "m";
  EXPECT_THROW(probe_readings(record, setup), OptionError);
}

// A gain in volts does not say that the numbers of the file are volts and not millivolts.
TEST(ProbeReadings, SayThatNumbersWithoutUnitAreTakenAsVolts) {
  MeasuredRecord record{.rate = 100.0};
  record.channels = {{"a", ""}};
  record.samples = Mat::Random(20, 1);
  const MeasuredProbe probe{{"px", test::node(1)}, "a", {ProbeGain::Of::voltage, 8000.0}};
  const ProbeReadings found = probe_readings(record, {.probes = {probe}});
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_EQ(found.notes[0], "no unit in the record for a: taken as V");
}

TEST(ProbeReadings, TellRowsThatAreLeftOutOnce) {
  MeasuredRecord record{.rate = 100.0};
  record.channels = {{"x", "m"}, {"y", "m"}, {"z", "m"}};
  record.samples = 1e-4 * Mat::Random(200, 3);
  record.samples.row(7).setConstant(std::nan(""));
  record.samples.row(9).setConstant(std::nan(""));
  MeasurementSetup setup;
  for (const char* name : {"x", "y", "z"}) {
    setup.probes.push_back({{name, test::node(1)}, name, {ProbeGain::Of::length, 1.0}});
  }
  const auto told = [&] {
    std::string lines;
    for (const std::string& note : probe_readings(record, setup).notes) lines += note + "\n";
    return lines;
  };
  EXPECT_EQ(told(),
            "channels \"x\", \"y\", \"z\": 2 of 200 samples are missing, the first at 0.07 s; "
            "straight lines are in their place\n");
  record.samples(3, 1) = std::nan("");  // of one channel more
  EXPECT_EQ(told(),
            "channels \"x\", \"z\": 2 of 200 samples are missing, the first at 0.07 s; straight "
            "lines are in their place\n"
            "channel \"y\": 3 of 200 samples are missing, the first at 0.03 s; straight lines are "
            "in their place\n");
}

// ---- orders -------------------------------------------------------------------------------------

/// Readings of a run-up whose orders are known: a quadratic phase, sampled without regard to it.
struct RunUp {
  double rate = 2000.0, length = 20.0;  ///< [1/s], [s]
  double slow = 5.0, rise = 2.0;        ///< [1/s], [1/s^2]
  bool has_late_pulses = false;         ///< at the next sample, as a logger has them

  double angle(double t) const { return 2.0 * pi * (slow * t + 0.5 * rise * t * t); }
  ProbeReadings readings(const std::function<double(double)>& reading) const {
    ProbeReadings r{.rate = rate};
    r.probes = {{"a", test::node(1)}};
    r.displacement.resize(static_cast<Eigen::Index>(rate * length), 1);
    for (Eigen::Index j = 0; j < r.displacement.rows(); ++j) {
      r.displacement(j, 0) = reading(angle(r.time(j)));
    }
    std::vector<double> pulses;
    for (int i = 0;; ++i) {
      const double t = (-slow + std::sqrt(slow * slow + 2.0 * rise * i)) / rise;
      if (t > length) break;
      pulses.push_back(has_late_pulses ? std::ceil(t * rate - 1e-9) / rate : t);
    }
    r.clock.emplace(pulses, KeyPhasor{}, r.notes);
    return r;
  }
};

// Pulses may lie before the first sample and behind the last one.
TEST(OrderTracking, TurnsSamplesOfTheRecordOnly) {
  ProbeReadings readings{.rate = 10.0, .displacement = Mat::Zero(40, 1)};
  const TurnClock beyond({-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0}, KeyPhasor{}, readings.notes);
  const TurnedSamples all = turned_samples(readings, beyond);
  EXPECT_EQ(all.first, 0);
  EXPECT_EQ(all.angle.size(), 40);
  const TurnClock within({0.5, 1.5, 2.5}, KeyPhasor{}, readings.notes);
  const TurnedSamples some = turned_samples(readings, within);
  EXPECT_EQ(some.first, 5);
  ASSERT_EQ(some.angle.size(), 21);
  EXPECT_NEAR(some.angle(20) - some.angle(0), 4.0 * pi, 1e-12);
}

// Orders that do not change along a run-up are found exactly, whatever their number, as the least
// squares know them all.
TEST(OrderTracking, FindsConstantOrdersOfARunUpExactly) {
  const Complex first = std::polar(3e-5, 0.7), second = std::polar(1e-5, -2.0),
                half = std::polar(2e-5, 1.1);
  const ProbeReadings readings = RunUp{}.readings([&](double a) {
    const auto turned = [&](const Complex& c, double q) {
      return (c * std::polar(1.0, q * a)).real();
    };
    return 4e-4 + turned(first, 1.0) + turned(second, 2.0) + turned(half, 0.5);
  });
  const OrderTracking found = track_orders(readings, {.orders = {1.0, 2.0, 0.5}});
  ASSERT_EQ(found.curves.size(), 3u);
  EXPECT_GT(found.speed.size(), 50);
  for (const auto& [curve, expected] : {std::pair{0, first}, {1, second}, {2, half}}) {
    for (const Complex& c : found.curves[static_cast<std::size_t>(curve)].response) {
      EXPECT_NEAR(std::abs(c - expected), 0.0, 1e-14);
    }
  }
  EXPECT_NEAR(found.speed(0), 2.0 * pi * (5.0 + 2.0 * found.time(0)), 1e-6);
}

// The resonance of a Jeffcott rotor, passed slowly, with runout that the slow roll takes off:
// r^2 / (1 - r^2 + 2 i zeta r).
TEST(OrderTracking, TakesTheSlowRollOffAResonance) {
  constexpr double zeta = 0.1, omega = 2.0 * pi * 20.0;
  const RunUp run{.length = 60.0, .slow = 1.0, .rise = 1.0};
  const Complex runout = std::polar(0.5, 2.0);
  const auto response = [&](double speed) {
    const double r = speed / omega;
    return r * r / Complex(1.0 - r * r, 2.0 * zeta * r);
  };
  const ProbeReadings readings = run.readings([&](double a) {
    const double speed = 2.0 * pi * std::sqrt(run.slow * run.slow + run.rise * a / pi);
    return ((response(speed) + runout) * std::polar(1.0, a)).real();
  });
  const OrderTracking found =
      track_orders(readings, {.orders = {1.0}, .slow_roll = 2.0 * pi * 2.0});
  ASSERT_TRUE(found.slow_roll.has_value());
  const CVec& c = found.curves[0].response;
  constexpr double window = 0.02;  // of the peak of 5: what eight revolutions average
  for (Eigen::Index k = 0; k < c.size(); ++k) {
    const Complex expected = response(found.speed(k)) - response(*found.slow_roll);
    EXPECT_NEAR(std::abs(c(k) - expected), 0.0, window * 5.0) << found.speed(k) / (2.0 * pi);
  }
}

// Pulses that are told at the next sample: the speed ascends all the same to a thousandth, and the
// resonance is one peak, as high and as sharp as with exact ones.
TEST(OrderTracking, PulsesAtSamplesMakeNoPeaks) {
  constexpr double zeta = 0.03, omega = 2.0 * pi * 40.0;
  const RunUp run{
      .rate = 5000.0, .length = 60.0, .slow = 8.0, .rise = 1.2, .has_late_pulses = true};
  std::mt19937_64 random(5);
  const ProbeReadings readings = run.readings([&](double a) {
    const double speed = 2.0 * pi * std::sqrt(run.slow * run.slow + run.rise * a / pi);
    const double r = speed / omega;
    const Complex response = r * r / Complex(1.0 - r * r, 2.0 * zeta * r);
    return (response * std::polar(1.0, a)).real() + 0.05 * random_normal(random);
  });
  const OrderTracking found = track_orders(readings, {.orders = {1.0}});
  for (Eigen::Index k = 1; k < found.speed.size(); ++k) {
    EXPECT_GT(found.speed(k), 0.999 * found.speed(k - 1)) << found.time(k);
  }
  ASSERT_EQ(found.peaks.size(), 1u);
  const OrderPeak& peak = found.peaks[0];
  EXPECT_NEAR(peak.speed, omega, 0.02 * omega);
  EXPECT_LT(peak.amplitude, 1.02 * found.curves[0].response.cwiseAbs().maxCoeff());
  EXPECT_NEAR(peak.amplification(), 0.5 / zeta, 0.15 * 0.5 / zeta);
}

// Noise alone has no peaks.
TEST(OrderTracking, NoiseAloneHasNoPeaks) {
  std::mt19937_64 random(6);
  const RunUp run{.length = 60.0, .has_late_pulses = true};
  const ProbeReadings readings = run.readings([&](double) { return random_normal(random); });
  EXPECT_TRUE(track_orders(readings, {.orders = {1.0, 2.0}}).peaks.empty());
}

TEST(OrderTracking, SaysWhatIsTooShort) {
  const RunUp run;
  ProbeReadings readings = run.readings([](double) { return 0.0; });
  EXPECT_THROW(track_orders(readings, {.revolutions = 1e6}), OptionError);
  EXPECT_THROW(track_orders(readings, {.orders = {300.0}}), OptionError);
}

}  // namespace whirl::measured_test

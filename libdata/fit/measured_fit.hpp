#pragma once
/// Parameters of a model found in records of a rig.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libdata/fit/fit.hpp"
#include "libdata/fit/fit_runout.hpp"
#include "libdata/measured/probe_readings.hpp"
#include "libdyn/system/probes.hpp"

namespace whirl::inline data {

/// The part of a record that a model is fitted to.
struct FitSpan {
  Eigen::Index first = 0, samples = 0;
  double speed = 0.0;  ///< of the rotor there [rad/s]
  double phase = 0.0;  ///< of the rotor at the first sample [rad]
};

/// Some revolutions of a record.
///
/// Speed and phase are those of the key-phasor; without one the speed is the one given, and the
/// phase at the first sample is zero.
///
/// @param from         revolutions of the record before the span
/// @param revolutions  of the span at most; 0: all that there are
/// @param notes        receives what is odd: a speed that changes, a phase that nobody knows
/// @throws OptionError  for fewer than two revolutions, or two samples in each
FitSpan fit_span(const ProbeReadings& readings, double speed, double from, double revolutions,
                 std::vector<std::string>& notes);

/// What a model is fitted to: readings, and the models that could have made them.
struct FitMeasurement {
  std::string name;  ///< of its file
  ProbeReadings readings;
  FitSpan span;
  std::shared_ptr<const Scene>
      scene;  ///< at the starts of the parameters and the speed of the span
  std::function<Model(const Vec& values)> model_at;  ///< as of model_source
};

/// Standard deviation of the noise of probes. Left out, the noise of each probe is what the fit
/// leaves of its readings.
struct ProbeNoise {
  double value = 0.0;  ///< [m]; if relative, over the deviation of what a probe reads
  bool is_relative = false;
};

struct MeasuredFitOptions {
  std::optional<ProbeNoise> noise{};
  /// Revolutions after which the motions repeat: records are averaged over such periods, and the
  /// noise is what differs between periods, see steady_record. 0: motions need not repeat.
  int period = 0;
  bool finds_offsets = false;  ///< of the probes, see FitRecord::is_offset_known
  int runout_orders = 0;       ///< at which each probe has a vector of runout, see FitRecord
  int starts = 1;              ///< first the model's values, then values between the bounds
  std::uint64_t seed = 1;
  int threads = 1;  ///< that take starts
  FitOptions search{};
};

/// A probe in a record that was fitted to. Of shorter records the last samples are NaN.
struct FittedProbe : ProbeLabel {
  FittedProbe() = default;
  FittedProbe(const Probe& probe, int of_record) : ProbeLabel(probe), record(of_record) {}

  int record = 0;         ///< from 0
  double noise = 0.0;     ///< standard deviation that it was weighted with [m]
  double residual = 0.0;  ///< root mean square of reading less measurement [m]
  double floor = 0.0;     ///< noise that the upper half of its spectrum shows, see noise_floor [m]
  double offset = 0.0, offset_deviation = 0.0;  ///< if found, and its standard deviation [m]
  Vec measured, predicted;                      ///< per sample [m]

  static constexpr auto columns() {
    using enum Written;
    using P = FittedProbe;
    return joined(
        ProbeLabel::columns(),
        ColumnList{
            column("record", &P::record, "", "number of its record").from_one(),
            column("noise", &P::noise, "m", "standard deviation that it was weighted with"),
            column("residual", &P::residual, "m", "root mean square of reading less measurement"),
            column("noise_floor", &P::floor, "m", "noise that its upper frequencies show"),
            column("offset", &P::offset, "m", "that it adds to displacements, if it was found"),
            column("offset_deviation", &P::offset_deviation, "m", "standard deviation of that"),
            column("measured", &P::measured, "m", "what it read")
                .along("fit_samples")
                .only(in_file),
            column("predicted", &P::predicted, "m", "what it reads of the motion that was found")
                .along("fit_samples")
                .only(in_file)});
  }
};

/// A station of probes in a record, measured and as it was found.
struct FittedStation {
  std::string station;               ///< names of its probes
  int record = 0;                    ///< from 0
  Vec measured_x, measured_y, x, y;  ///< per sample [m]

  static constexpr auto columns() {
    using S = FittedStation;
    return ColumnList{
        column("station", &S::station, "", "probes of a station").axis(),
        column("record", &S::record, "", "number of its record").from_one(),
        column("measured_x", &S::measured_x, "m", "measured displacement x").along("fit_samples"),
        column("measured_y", &S::measured_y, "m", "measured displacement y").along("fit_samples"),
        column("x", &S::x, "m", "displacement x of the motion that was found").along("fit_samples"),
        column("y", &S::y, "m", "displacement y of the motion that was found")
            .along("fit_samples")};
  }
};

/// A record that was fitted to.
struct FittedRecord {
  std::string file;
  double speed = 0.0;        ///< of the rotor [rad/s]
  double revolutions = 0.0;  ///< of the record that were fitted to
  int period = 0;            ///< of the average of the record [revolutions]; 0: not averaged
  Vec time;                  ///< per sample; of an average since the period began [s]

  static constexpr auto columns() {
    using enum Written;
    using R = FittedRecord;
    return ColumnList{
        column("file", &R::file, "", "a record").axis(),
        column("speed", &R::speed, "rad/s", "speed of the rotor in it"),
        column("revolutions", &R::revolutions, "", "of it that were fitted to"),
        column("period", &R::period, "", "revolutions that it was averaged to; 0: it was not"),
        column("time", &R::time, "s", "time of its samples").along("fit_samples").only(in_file)};
  }
};

/// A model beside others that were fitted to the same records.
struct FitCandidate {
  std::string model;  ///< its file
  bool has_converged = false;
  int parameters = 0;  ///< that are free
  double residual = 0.0;
  double log_likelihood = 0.0;
  double information = 0.0;  ///< criterion of Bayes [Schwarz1978]: the smallest is the best
  /// Likelihood of this model, punished for its parameters, over the sum of such likelihoods of all
  /// models that converged: if one of those models is right and none was preferred before, the
  /// probability that this one is right. 0: this one did not converge.
  double weight = 0.0;

  static constexpr auto columns() {
    using C = FitCandidate;
    return ColumnList{
        column("model", &C::model, "", "a model that was fitted").axis(),
        column("converged", &C::has_converged, "", "1: the search has ended at a fit"),
        column("parameters", &C::parameters, "", "that are free"),
        column("residual", &C::residual, "", "as of the fit"),
        column("log_likelihood", &C::log_likelihood, "", "of the records"),
        column("information", &C::information, "",
               "Bayesian information criterion, parameters ln readings - 2 log likelihood"),
        column("weight", &C::weight, "",
               "exp(-information / 2) over its sum over the models that converged")};
  }
};

/// What was found in records; group /fit.
struct MeasuredFit : Fit {
  bool is_noise_known = false;  ///< else it is the residuals
  double explained = 0.0;       ///< share of the readings' variance that the motions found have
  int starts = 1;               ///< of the search
  int same_end = 1;             ///< starts that end within a standard deviation of the best one
  std::vector<FittedRecord> files;
  /// Deviations over those of independent noise as large as it is known, or as what is left: errors
  /// of a model hang together.
  double spread = 1.0;
  std::vector<FittedProbe> probes;
  std::vector<FittedRunout> runouts;  ///< if they were found; the same in all records
  std::vector<FittedStation> stations;
  std::vector<FitCandidate> candidates;  ///< this model first; empty: there are no others
  std::vector<std::string> notes;

  static constexpr std::string_view group = "/fit";
  static constexpr auto columns() {
    using enum Written;
    using F = MeasuredFit;
    return ColumnList{
        column("converged", &F::has_converged, "", "1: the search has ended at a fit"),
        column("why_not", &F::why_not, "", "if it has not").maybe(),
        rows(&F::parameters, "parameters").prefixed("parameter_"),
        column("correlation", &F::correlation, "", "of the errors of the parameters")
            .along("parameters parameters"),
        column("residual", &F::residual, "",
               "root mean square of what is left, over the noise of the probes, or if nobody knows "
               "that over their noise floors"),
        column("explained", &F::explained, "",
               "share of the variance of the readings that the motions found have"),
        column("log_likelihood", &F::log_likelihood, "", "of the records, Gaussian noise"),
        column("noise_known", &F::is_noise_known, "", "0: the noise is what is left"),
        column("readings", &F::readings, "", "that were compared"),
        column("windows", &F::windows, "", "of multiple shooting"),
        column("iterations", &F::iterations, "", "of the search"),
        column("starts", &F::starts, "", "of the search"),
        column("same_end", &F::same_end, "",
               "starts that end within a standard deviation of the best one"),
        column("grazes", &F::grazes, "", "of the motions found: derivatives are one-sided there"),
        column("over_least_deviation", &F::over_least_deviation, "",
               "largest standard deviation of a parameter over the least that an estimate without "
               "bias can have (Cramer and Rao)"),
        column("spread", &F::spread, "",
               "standard deviations over those of white noise: more where errors hang together, or "
               "where more than the known noise is left"),
        rows(&F::files, "records").prefixed("record_"),
        rows(&F::runouts, "runouts").prefixed("runout_").maybe(),
        rows(&F::probes, "fitted_probes").prefixed("probe_"),
        rows(&F::stations, "fitted_stations").prefixed("station_").only(in_file),
        rows(&F::candidates, "candidates").prefixed("candidate_").maybe()};
  }
};

/// Standard deviation of the noise in equally spaced samples, as far as the upper half of their
/// spectrum shows it: from the median there, which the lines of a motion do not raise. Motions with
/// much content in that half make the floor larger.
double noise_floor(const Vec& samples);

/// Finds parameters by multiple shooting through some revolutions of records, see fit().
///
/// Probes are weighted by their noise. If the noise is not known, it is first the noise floor of
/// each probe, then what the fit leaves of it. A search that explains less than half of the
/// readings, and leaves more than noise, has not converged.
///
/// @throws ModelError, OptionError  as fit() and model_source()
MeasuredFit fit(const std::vector<FitMeasurement>& measurements,
                const std::vector<FreeParameter>& parameters,
                const MeasuredFitOptions& options = {});

/// Fits of models to the same records, the first one first, with the weight of each.
/// @param names  of their models
/// @source [Schwarz1978]
std::vector<FitCandidate> compared(const std::vector<MeasuredFit>& fits,
                                   const std::vector<std::string>& names);

}  // namespace whirl::inline data

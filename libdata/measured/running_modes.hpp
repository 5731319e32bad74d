#pragma once
/// Modes of a machine while it runs, from its measured motion alone: the forces that drive it need
/// not be known, but must be broadband.

#include <limits>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdata/measured/decomposition.hpp"
#include "libdata/measured/stabilization.hpp"

namespace whirl::inline data {

struct RunningModesOptions {
  std::vector<std::string> channels{};  ///< names; empty: "channel 1", ...
  double most_frequency = 0.0;  ///< of interest, for which samples are thinned out; 0: all [rad/s]
  int block_rows = 0;           ///< of the covariance matrix; 0: see usual_block_rows()
  int most_order = 0;           ///< of models, two for each mode; 0: 60, or what block_rows allow
  StabilityLimits limits{};
  double share = 0.3;  ///< of all orders, in which a mode must be stable
  int stretches = 10;  ///< of the record, for standard deviations; 0: none
  double most_deviation =
      0.5;             ///< standard, of an eigenvalue over its distance from the imaginary axis
  int segment = 2048;  ///< samples of a segment of the spectra, an eighth of the record at most
  double speed = 0.0;  ///< of the rotor, constant; 0: unknown, no harmonics [rad/s]
  Vec phase{};         ///< of the rotor at every sample, by a key-phasor, in place of a speed [rad]
  int harmonics = 10;  ///< of the speed that are marked and removed
  bool removes_harmonics = true;
};

/// A mode that the models of many orders agree on. Its shape has the units of the channels, and its
/// largest entry is one.
struct RunningMode : Pole {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double frequency_deviation = unknown, damping_deviation = unknown;  ///< standard; NaN: not known
  double frequency_scatter = 0.0, damping_scatter = 0.0;              ///< standard, over orders
  int order = 0;                                                      ///< model order of the shape
  int orders = 0;                                                     ///< orders with this mode
  // where there is a model to compare with: see compare()
  std::string whirl{};        ///< sense of whirl; "": no station shows it
  std::vector<double> mac{};  ///< against each mode of the model, by what the probes read
  int model_mode = -1;        ///< mode of the model that it is most like, from 0; -1: none is alike
  double shift = unknown;     ///< frequency over that mode's, less one

  static constexpr auto columns() {
    return ColumnList{
        column("frequency", &RunningMode::frequency, "rad/s", "damped natural frequency"),
        column("frequency_deviation", &RunningMode::frequency_deviation, "rad/s",
               "standard deviation, from stretches of the record")
            .as("frequency_deviation_rpm"),
        column("frequency_scatter", &RunningMode::frequency_scatter, "rad/s",
               "standard deviation over model orders")
            .as("frequency_scatter_rpm"),
        column("damping_ratio", &RunningMode::damping_ratio, "", "damping ratio"),
        column("damping_deviation", &RunningMode::damping_deviation, "",
               "standard deviation, from stretches of the record"),
        column("damping_scatter", &RunningMode::damping_scatter, "",
               "standard deviation over model orders"),
        column("log_decrement", &RunningMode::log_decrement, "", "logarithmic decrement"),
        column("eigenvalue", &RunningMode::lambda, "rad/s", "eigenvalue").as("eigenvalue"),
        column("order", &RunningMode::order, "", "model order that the shape is of"),
        column("orders", &RunningMode::orders, "", "model orders in which the mode is stable"),
        column("shape", &RunningMode::shape, "", "complex shape, the largest entry one")
            .along("channels"),
        column("whirl", &RunningMode::whirl, "", "sense of whirl").maybe(),
        column("mac", &RunningMode::mac, "", "modal assurance criterion")
            .along("/modes/number")
            .maybe(),
        column("model_mode", &RunningMode::model_mode, "", "the mode it is most like; 0: none")
            .from_one(),
        column("shift", &RunningMode::shift, "", "frequency over that mode's, less one")
            .only(Written::in_json)};
  }
};

struct RunningModes {
  std::vector<std::string> channels;
  std::vector<RunningMode> modes;     ///< ascending frequency
  std::vector<DecomposedMode> peaks;  ///< of the first singular value, ascending frequency
  std::vector<OrderPole> poles;       ///< of all orders, ascending
  std::vector<double> lines;          ///< of the spectra [rad/s]
  Mat singular_values;                ///< channels x lines [1/Hz], of channels of variance one
  double duration = 0.0;              ///< of the record [s]
  double rate = 0.0;                  ///< of samples after thinning [1/s]
  double speed = 0.0;                 ///< of the rotor, mean; 0: unknown [rad/s]
  int harmonics = 0;                  ///< of the speed that were marked
  bool are_harmonics_removed = false;
  int block_rows = 0, most_order = 0;

  /// The peak of the decomposition that is the same mode: the nearest one, within 3 % and with a
  /// MAC of 0.8; null: there is none.
  const DecomposedMode* peak_of(const RunningMode& mode) const;

  static constexpr std::string_view group = "/running_modes";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("channel", &RunningModes::channels, "", "name of the channel").axis("channels+"),
        column("duration", &RunningModes::duration, "s", "of the record"),
        column("rate", &RunningModes::rate, "1/s", "samples per second that were used"),
        column("speed", &RunningModes::speed, "rad/s", "mean speed of the rotor; 0: unknown"),
        column("harmonics", &RunningModes::harmonics, "", "harmonics of the speed that are marked"),
        column("harmonics_removed", &RunningModes::are_harmonics_removed, "",
               "1: taken out of the record before"),
        column("block_rows", &RunningModes::block_rows, "", "of the covariance matrix"),
        column("most_order", &RunningModes::most_order, "", "largest model order"),
        rows(&RunningModes::modes, "running_modes").numbered("number", "running mode").maybe(),
        rows(&RunningModes::peaks, "decomposed").prefixed("fdd_").maybe(),
        rows(&RunningModes::poles, "poles").prefixed("pole_").only(in_file).maybe(),
        column("line", &RunningModes::lines, "rad/s", "frequency of the spectral line")
            .axis("spectral_lines+")
            .within(valid::finite)
            .only(in_file),
        column("singular_value", &RunningModes::singular_values, "1/Hz",
               "singular values of the spectral matrix, descending")
            .along("channels spectral_lines")
            .only(in_file)};
  }
};

/// Identifies the modes of a running machine: poles by stochastic subspace identification
/// (SubspaceModels) that are stable over model orders (clustered_modes), and peaks by
/// frequency-domain decomposition (decomposed_modes) to compare with.
///
/// Harmonics of the speed are taken out first (without_harmonics), and what is left of them is
/// marked. Channels are divided by their standard deviations, so that their units do not matter.
///
/// Standard deviations are those of the jackknife: modes are identified again from all stretches of
/// the record but one, for each stretch that is left out. Poles that large models make of noise may
/// be stable over some orders, too, but they move when a stretch is left out. A group of poles is a
/// mode only if
///
///   hypot(deviation of w, |lambda| deviation of zeta) <= most_deviation |Re lambda|
///
/// @param samples  times x channels, at equal distances
/// @param spacing  time between samples [s]
/// @throws ModelError   for samples that are not numbers, channels that do not vary, too few
///                      samples
/// @throws OptionError  for options that mean nothing, or more orders than the data can have
/// @source jackknife over stretches [Kuensch1989]
RunningModes running_modes(const Mat& samples, double spacing, const RunningModesOptions& options);

/// Number of block rows with which the covariance matrix has about 240 rows: 20 to 100. If
/// covariances fall below half of the largest one before that, running_modes() takes fewer, but at
/// least 20.
int usual_block_rows(Eigen::Index channels);

}  // namespace whirl::inline data

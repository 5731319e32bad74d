#pragma once
/// Which complex modes make up a motion: deflection shapes at spectral peaks against modes (MAC).

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/motions/combinations.hpp"
#include "libdyn/motions/response.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline dyn {

struct IdentifyOptions {
  int modes = 8;               ///< compared with
  bool rotations = false;      ///< tilts count too, times a length
  bool mass_weighted = false;  ///< MAC with the mass matrix instead
  bool reduced = false;        ///< modes of the reduced rotor that the motion was computed with
  bool stiffened = false;      ///< modes of the system with its contacts closed for good
  double share = 0.02;         ///< of the largest peak, below which peaks are left out
  int most_peaks = 10;
};

struct IdentifiedPeak {
  double frequency = 0.0;                  ///< signed: forward > 0 [rad/s]
  double amplitude = 0.0;                  ///< largest radius of a point at this frequency [m]
  std::vector<double> mac;                 ///< against each mode
  int mode = 0;                            ///< best one, from 0
  double shift = 0.0;                      ///< |frequency| over that mode's, less one
  std::optional<Combination> combination;  ///< of stronger peaks that are no combinations
  double frequency_rotating = 0.0;         ///< seen from the rotor [rad/s]
  std::string forced{};                    ///< ForcedLine::name of the cause; "": no cause

  /// Number of the best mode, from 1; nothing if there are no modes.
  std::optional<int> mode_number() const {
    return mac.empty() ? std::nullopt : std::optional(mode + 1);
  }
  /// The combination as a file has it; "": none.
  std::string combination_text() const { return combination ? combination->text() : ""; }
  std::optional<std::vector<Combination::Term>> combination_terms() const {
    return combination ? std::optional(combination->terms) : std::nullopt;
  }

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("frequency", &IdentifiedPeak::frequency, "rad/s", "signed frequency of the peak")
            .axis()
            .within(valid::finite),
        column("amplitude", &IdentifiedPeak::amplitude, "m", "largest radius at the peak"),
        column("mac", &IdentifiedPeak::mac, "", "modal assurance criterion").along("/modes/number"),
        column("mode", &IdentifiedPeak::mode_number, "", "the mode it is most alike").only(in_json),
        column("shift", &IdentifiedPeak::shift, "", "frequency over that mode's, less one")
            .only(in_json),
        column("frequency_rotating", &IdentifiedPeak::frequency_rotating, "rad/s",
               "seen from the rotor")
            .only(in_json),
        column("combination", &IdentifiedPeak::combination_text, "",
               "stronger peaks that make up the frequency [rpm]")
            .only(in_file)
            .maybe(),
        column("combination", &IdentifiedPeak::combination_terms, "", "of these frequencies")
            .only(in_json),
        column("forced", &IdentifiedPeak::forced, "", "what drives it").only(in_json).maybe()};
  }
};

/// Number of the mode with the largest MAC, from 0, the first where several are as large; -1: there
/// are no modes.
int most_alike(const std::vector<double>& mac);
/// MAC from which on a shape counts as like a mode: below 0.5, the MAC of a line and a circle.
constexpr double least_likeness = 0.4;

/// Ratio of the two strongest frequencies seen from the rotor.
struct FrequencyRatio {
  int p = 0, q = 0;              ///< p >= q
  double error = 0.0;            ///< |ratio / (p/q) - 1|
  double high = 0.0, low = 0.0;  ///< the frequencies, unsigned [rad/s]

  static constexpr auto columns() {
    constexpr auto ratio = [](const FrequencyRatio& r) { return std::vector<int>{r.p, r.q}; };
    constexpr auto both = [](const FrequencyRatio& r) {
      return std::vector<double>{r.high, r.low};
    };
    return ColumnList{column("ratio", ratio, "", "p:q"),
                      column("error", &FrequencyRatio::error, "", "relative, of the ratio"),
                      column("frequencies", both, "rad/s", "seen from the rotor")};
  }
};

struct Identification {
  std::vector<Mode> modes;
  std::vector<IdentifiedPeak> peaks;  ///< strongest first
  std::optional<FrequencyRatio> resonance;
  double bin = 0.0;  ///< distance of spectral lines [rad/s]

  static constexpr std::string_view group = "/mac";
  static constexpr auto columns() {
    return ColumnList{
        rows(&Identification::peaks, "peaks+").maybe(),
        column("resonance", &Identification::resonance, "", "two strongest, seen from the rotor")
            .only(Written::in_json)};
  }
};

/// Identifies the modes in a steady motion.
///
/// Peaks are those of the spectrum over all points together; at each, the deflection shape is the
/// complex amplitude of every displacement at the frequency's magnitude, so that a mode's forward
/// and backward parts are compared together. Contacts make combinations of the frequencies of a
/// motion: such peaks have the shape of a mode and not its frequency.
Identification identify(const Model& model, const Scene& scene, const Recording& recording,
                        const IdentifyOptions& options);

/// Weights of a MAC over the coordinates of a system: one for translations of every point; for
/// tilts length^2, or nothing if the length is zero.
Sparse mac_weights(const DofMap& dofs, double length);

/// The ratio p:q of small numbers nearest to high / low; smaller numbers win among good ones.
FrequencyRatio ratio_of(double high, double low);

/// A frequency of an excitation, which does not depend on the motion.
struct ForcedLine {
  std::string name;        ///< "1X" for the speed; "2x", "40 Hz" for forces
  double frequency = 0.0;  ///< signed [rad/s]
};

/// The forced lines of a rotor at a speed: the speed itself, and the frequencies of forces with
/// both signs, as a force along a direction drives forward and backward motion.
std::vector<ForcedLine> forced_lines(const Assembler& assembler, double Omega);

/// The forced line nearest to a peak, if their distance is within the width of a spectral line;
/// else null.
///
/// @param bin  distance of spectral lines [rad/s]
const ForcedLine* forced_line_at(double frequency, const std::vector<ForcedLine>& lines,
                                 double bin);

/// The system with the stiffness of its contacts added at their stations, as if all contacts were
/// closed for good: of rings and blades to lateral displacements, of faces to tilts.
System stiffened(const Model& model, const Scene& scene);
/// The same stiffness added to the rotor's matrices at another frequency.
System stiffened(const Model& model, const Scene& scene, System system);

}  // namespace whirl::inline dyn

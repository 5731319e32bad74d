#pragma once
/// Frequency responses of the linear rotor at a speed: receptances, mobilities, accelerances
/// between stations, along x, y or a sense of whirl.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libfe/parts/probe.hpp"

namespace whirl::inline dyn {

/// The direction along which a force acts, or a motion is told.
///
/// A forward force of constant size turns with the spin, f_x + i f_y = F e^(i w t), a backward
/// force against the spin. Of a motion x + i y = r_f e^(i w t) + conj(r_b) e^(-i w t), forward
/// tells r_f and backward r_b.
enum class Direction { x, y, theta_x, theta_y, forward, backward };

constexpr std::array<Choice<Direction>, 6> choices(Direction) {
  using enum Direction;
  return {{{"x", x},
           {"y", y},
           {"theta_x", theta_x},
           {"theta_y", theta_y},
           {"forward", forward},
           {"backward", backward}}};
}

/// A place and a direction, or a probe.
struct ResponseEnd {
  NamedPoint at;
  Direction direction = Direction::x;
  std::optional<Probe> probe{};  ///< whose direction counts instead

  /// "7 seal x", or the name of the probe.
  std::string label() const;
};

/// The ends in a list "left disk:y,7,seal:forward,1X": a station as in select_points with a
/// direction, x if there is none, or the name of a probe. An empty list stands for x and y of all
/// points that select_points gives for an empty list.
/// @throws ModelError  for an unknown station or direction, and for tilts of a body that has none
std::vector<ResponseEnd> select_ends(const Model& model, const Assembler& assembler,
                                     const std::string& list);

/// Complex amplitude of a motion by a force of size one, over frequency: u = Re(H f e^(i w t)).
struct ResponsePair {
  std::string from, to;  ///< the force, the motion
  CVec receptance;       ///< displacement [m/N]; tilts in rad, by moments in N.m
  CVec mobility;         ///< velocity, i w times the receptance [m/(N.s)]
  CVec accelerance;      ///< acceleration, -w^2 times the receptance [1/kg]

  static constexpr auto columns() {
    return ColumnList{
        column("from", &ResponsePair::from, "", "station and direction of the force"),
        column("to", &ResponsePair::to, "", "station and direction of the motion"),
        column("receptance", &ResponsePair::receptance, "m/N", "displacement by force")
            .along("frequencies")
            .as("receptance"),
        column("mobility", &ResponsePair::mobility, "m/(N.s)", "velocity by force")
            .along("frequencies")
            .as("mobility"),
        column("accelerance", &ResponsePair::accelerance, "1/kg", "acceleration by force")
            .along("frequencies")
            .as("accelerance")};
  }
};

/// Force on a bearing, seal, link, oil film or rolling bearing by a force of size one, over
/// frequency.
struct TransmittedForce {
  std::string from;        ///< the force
  std::string kind, name;  ///< of the part that carries
  CVec x, y;               ///< complex amplitudes [N/N]; by moments N/(N.m)

  static constexpr auto columns() {
    using T = TransmittedForce;
    return ColumnList{
        column("from", &T::from, "", "station and direction of the force"),
        column("kind", &T::kind, "", "bearing, seal, link, oil film or rolling bearing"),
        column("name", &T::name, "", "its name"),
        column("force_x", &T::x, "", "force on it along x by force").along("frequencies"),
        column("force_y", &T::y, "", "force on it along y by force").along("frequencies")};
  }
};

/// Frequency responses at a speed; group /frf.
struct FrequencyResponse {
  double speed = 0.0;               ///< [rad/s]
  std::vector<double> frequencies;  ///< [rad/s]
  std::vector<ResponsePair> pairs;
  std::vector<double> unbounded;  ///< undamped resonances, where responses are NaN [rad/s]
  std::vector<TransmittedForce> transmitted{};  ///< force by force

  /// For each pair, whether its response is zero, or only rounding in files of earlier versions:
  /// nowhere above 1e-10 of the largest response to the same force, displacements and tilts each by
  /// themselves.
  std::vector<bool> silent_pairs() const;

  static constexpr std::string_view group = "/frf";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("speed", &FrequencyResponse::speed, "rad/s", "rotor speed").only(in_file),
        column("frequency", &FrequencyResponse::frequencies, "rad/s", "frequency of the force")
            .axis("frequencies+")
            .within(valid::finite)
            .as("frequencies_rpm"),
        rows(&FrequencyResponse::pairs, "pairs+"),
        rows(&FrequencyResponse::transmitted, "transmitted").prefixed("transmitted_").maybe(),
        column("unbounded", &FrequencyResponse::unbounded, "rad/s", "undamped resonances")
            .only(in_json)};
  }
};

/// Solves (K - w^2 M + i w (C + Omega G)) q = f for a force at each end of `from`.
///
/// Coefficients of bearings are those of a journal that whirls with the frequency of the force. A
/// response that is nowhere above 1e-10 of the largest response of any point to the same force,
/// displacements and tilts each by themselves, is rounding and becomes zero.
/// @param Omega        spin speed [rad/s]
/// @param frequencies  0 or more [rad/s]
FrequencyResponse frequency_response(const Assembler& assembler, double Omega,
                                     const std::vector<double>& frequencies,
                                     const std::vector<ResponseEnd>& from,
                                     const std::vector<ResponseEnd>& to);

/// Frequencies that show the lowest modes at a speed: even ones up to 1.2 times that of the highest
/// of these modes, and some within the width of each peak [rad/s].
std::vector<double> usual_frequencies(const Assembler& assembler, double Omega);

}  // namespace whirl::inline dyn

#pragma once
/// Complex modes of a damped, spinning system, and what their orbits look like.

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

/// Sense of a mode along the whole rotor.
enum class Whirl { forward, backward, mixed, planar };
constexpr auto choices(Whirl) {
  return std::array{Choice<Whirl>{"forward", Whirl::forward},
                    Choice<Whirl>{"backward", Whirl::backward},
                    Choice<Whirl>{"mixed", Whirl::mixed}, Choice<Whirl>{"planar", Whirl::planar}};
}

/// Elliptical orbit of a point, x = Re(X e^(i w t)), y = Re(Y e^(i w t)).
struct Orbit {
  double forward = 0.0;   ///< radius of the circle that turns forward, |X + i Y| / 2
  double backward = 0.0;  ///< radius of the circle that turns backward, |X - i Y| / 2

  Orbit() = default;
  Orbit(Complex x, Complex y)
      : forward(0.5 * std::abs(x + Complex(0, 1) * y)),
        backward(0.5 * std::abs(x - Complex(0, 1) * y)) {}

  double major() const { return forward + backward; }
  double minor() const { return std::abs(forward - backward); }
  /// Signed ratio of the axes, minor / major; 1 forward circle, -1 backward circle, 0 a line.
  double kappa() const { return major() > 0.0 ? (forward - backward) / major() : 0.0; }
};

/// Damping ratio above which a mode is hardly a critical speed: that of a bearing, in most cases.
constexpr double heavy_damping = 0.5;

/// |Im| over |Re| of an eigenvalue below which it hardly oscillates.
constexpr double hardly_oscillating = 0.2;
inline bool oscillates(Complex lambda) {
  return lambda.imag() > hardly_oscillating * std::abs(lambda.real());
}

/// Coordinates below which all modes of a system are found at once: dense solvers are as fast
/// there.
constexpr int dense_below = 75;

/// One oscillatory mode, q = Re(shape e^(lambda t)).
struct Mode {
  Complex lambda;  ///< eigenvalue, Im > 0 [rad/s]
  CVec shape;      ///< coordinates of the system, largest lateral radius one
  Whirl whirl = Whirl::planar;
  double kappa = 0.0;          ///< signed axis ratio at the point that moves most
  std::vector<double> kappas;  ///< the same at every point (nodes, then bodies)

  double frequency() const { return lambda.imag(); }  ///< damped [rad/s]
  double damping_ratio() const { return -lambda.real() / std::abs(lambda); }
  /// 2 pi zeta / sqrt(1 - zeta^2); positive: stable.
  double log_decrement() const;
  bool is_heavily_damped() const { return damping_ratio() > heavy_damping; }

  static constexpr auto columns() {
    return ColumnList{
        column("frequency", &Mode::frequency, "rad/s", "damped natural frequency"),
        column("damping_ratio", &Mode::damping_ratio, "", "damping ratio"),
        column("log_decrement", &Mode::log_decrement, "", "logarithmic decrement"),
        column("heavily_damped", &Mode::is_heavily_damped, "", "damping ratio above 0.5")
            .only(Written::in_json),
        column("whirl", &Mode::whirl, "", "sense of whirl"),
        column("eigenvalue", &Mode::lambda, "rad/s", "eigenvalue").as("eigenvalue"),
        column("kappa", &Mode::kappa, "", "signed axis ratio where the mode moves most")};
  }
};

/// Whether a search for modes proves that it misses none, or takes those that it finds first.
enum class Completeness { proven, unproven };

struct Modes {
  std::vector<Mode> oscillatory;    ///< ascending frequency
  std::vector<Complex> overdamped;  ///< eigenvalues with |Im| < 0.2 |Re| (real ones too: divergent
                                    ///< or creeping), Im >= 0, nearest to zero first [rad/s]
  std::vector<Mode> rigid_body;     ///< modes of free systems that do not deform them
  Completeness completeness = Completeness::proven;  ///< of the oscillatory ones

  bool is_proven() const { return completeness == Completeness::proven; }
};

/// Complex modes of a system at its speed.
///
/// Below 150 states all are found densely; above, the lowest of those that oscillate, by a disc
/// about zero (DiscSolver) that grows until bounds of the energies prove that none is missing, and
/// where that is too far by discs that cover the plane from below; overdamped ones are then those
/// nearest to zero. Rigid-body motions (of free rotors, including the precession of a free spinning
/// rotor) are told apart by their strain energy and listed by themselves, as are overdamped
/// motions: real eigenvalues, and pairs with a damping ratio above 0.98, which only gyroscopics
/// keep from being real.
///
/// @param count         oscillatory modes wanted; fewer come back if there are fewer
/// @param completeness  unproven: the first ones that the disc shows, in half the time; a mode may
///                      be missing, most likely one of several that are equal
/// @throws NumericalError  if an eigensolver fails
Modes complex_modes(const System& system, int count,
                    Completeness completeness = Completeness::proven);

/// Complex modes of a structure at a speed [rad/s]. Where coefficients depend on the frequency of a
/// motion, each mode has those of its own (own_frequency_modes); shapes are those of
/// assembler.at(Omega).
Modes complex_modes(const Assembler& assembler, double Omega, int count,
                    Completeness completeness = Completeness::proven);

/// The mode of an eigenpair of a system with these dofs.
Mode mode_of(Complex lambda, const CVec& q, const DofMap& dofs);

/// Modes with their shapes at all points, as a result.
struct ModesAtPoints : Modes {
  ModesAtPoints() = default;
  ModesAtPoints(Modes modes, const DofMap& dofs);

  CMat shape;  ///< a column per oscillatory mode: full vectors, see DofMap

  /// Real parts of the overdamped ones [1/s].
  std::vector<double> real_roots() const;

  static constexpr std::string_view group = "/modes";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        rows(&ModesAtPoints::oscillatory, "modes").numbered("number", "mode"),
        column("shape", &ModesAtPoints::shape, "m, rad",
               "complex shape: x, y, theta_x, theta_y of every node, then of every body")
            .along("full modes")
            .only(in_file),
        column("real_roots", &ModesAtPoints::real_roots, "1/s", "real parts of overdamped ones")
            .as("real_roots")
            .only(in_json),
        column("overdamped", &ModesAtPoints::overdamped, "rad/s", "overdamped eigenvalues")
            .as("overdamped")
            .only(in_json),
        rows(&ModesAtPoints::rigid_body, "rigid_body").numbered("number", "mode").only(in_json),
        column("proven", &ModesAtPoints::is_proven, "", "the search proved that it missed none")
            .only(in_json)};
  }
};

/// The same for many speeds of one structure: work that does not depend on speed is done once.
class ModeFinder {
 public:
  explicit ModeFinder(const Assembler& assembler);
  ~ModeFinder();
  /// As complex_modes.
  Modes at(double Omega, int count) const;
  /// Modes around i * frequency [rad/s]: all of a small system's lowest `count`, or about so many
  /// that are nearest in the complex plane. Coefficients are those of this frequency.
  Modes near(double Omega, double frequency, int count) const;
  /// The mode that Newton's iteration finds from one of a speed beside this; coefficients as of
  /// near(). It may be another one, of another shape. Nothing: it does not converge, or not to a
  /// mode that oscillates.
  std::optional<Mode> followed(const Mode& mode, double Omega, double frequency) const;
  System system(double Omega) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Orbits of all points (nodes, then bodies) of a complex shape.
std::vector<Orbit> orbits(const DofMap& dofs, const CVec& shape);

/// The sense seen most often, of equals the first of the enumeration; planar where none was seen.
Whirl most_frequent(const std::vector<Whirl>& seen);

/// Sense of whirl from orbits: points below a thousandth of the largest are not asked.
Whirl whirl_of(const std::vector<Orbit>& orbits);

}  // namespace whirl::inline fe

#pragma once
/// Periodic orbits of a rotor, however they are found.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libdyn/orbits/harmonic_balance.hpp"
#include "libdyn/orbits/multiplier_modes.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/system/scene.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

/// How orbits are found.
enum class OrbitMethod { shooting, harmonic_balance };
constexpr auto choices(OrbitMethod) {
  return std::array{Choice<OrbitMethod>{"shooting", OrbitMethod::shooting},
                    Choice<OrbitMethod>{"harmonic-balance", OrbitMethod::harmonic_balance}};
}

/// Options of the search for an orbit in the stationary frame.
struct OrbitOptions {
  OrbitMethod method = OrbitMethod::shooting;
  int period = 1;            ///< [revolutions]
  int harmonics = 0;         ///< of harmonic balance; 0: as the tolerance asks
  bool is_verified = false;  ///< an orbit of harmonic balance is compared with that of shooting
};

/// How far an orbit of harmonic balance is from the one that shooting finds from the same states.
struct ShootingGap {
  Failure failure;  ///< of shooting; without a failure, all else is known
  std::optional<double> displacement{}, velocity{};  ///< where revolutions start [length scales]
  std::optional<double> multiplier{};                ///< largest, from the nearest of shooting
  std::optional<double> residual{};                  ///< of shooting [length scales]

  static constexpr auto columns() {
    using G = ShootingGap;
    return ColumnList{
        column("failure", &G::failure, "", "of shooting").only(Written::in_json).maybe(),
        column("displacement", &G::displacement, "", "[length scales]").maybe(),
        column("velocity", &G::velocity, "", "[length scales]").maybe(),
        column("multiplier", &G::multiplier, "", "largest distance of one").maybe(),
        column("residual", &G::residual, "", "of shooting [length scales]").maybe()};
  }
};

/// What harmonic balance adds to an orbit; the amplitudes are in group /orbit.
struct OrbitSeries {
  int harmonics = 0;        ///< of the orbit's frequency
  double truncation = 0.0;  ///< what harmonics left out change [length scales]; NaN: not known
  std::vector<HarmonicOrbit::Level> levels{};  ///< tried on the way
  std::optional<int> missing_multipliers{};    ///< too small to be told; nothing: no orbit
  std::optional<int> averaged_multipliers{};   ///< of modes too fast for the harmonics
  Failure stability_failure{};
  Vec orders{};       ///< frequency over speed of each amplitude, from 0
  CMat amplitudes{};  ///< of all points: displacement = Re sum amplitude e^(i order phase) [m, rad]
  std::optional<ShootingGap> gap{};  ///< if it is asked for

  static constexpr std::string_view group = "/orbit";
  static constexpr auto columns() {
    using S = OrbitSeries;
    using enum Written;
    return ColumnList{
        column("order", &S::orders, "", "frequency over speed").axis("orders").only(in_file),
        column("amplitude", &S::amplitudes, "m, rad",
               "displacement of all points is Re sum amplitude e^(i order phase)")
            .along("full orders")
            .only(in_file),
        column("harmonics", &S::harmonics, "", "of the orbit's frequency").only(in_json),
        column("truncation", &S::truncation, "", "what orders left out change").maybe(),
        rows(&S::levels, "levels").only(in_json),
        column("multipliers_left_out", &S::missing_multipliers, "", "too small to be told")
            .only(in_json)
            .maybe(),
        column("multipliers_of_means", &S::averaged_multipliers, "",
               "of modes too fast for the harmonics")
            .only(in_json)
            .maybe(),
        column("shooting", &S::gap, "", "how far it is from shooting").only(in_json).maybe()};
  }
};

/// An orbit, or how far the search for it got.
struct FoundOrbit {
  int period = 1, shortest_period = 1;  ///< [revolutions]
  /// [length scales]; NaN: none was computed
  double residual = std::numeric_limits<double>::quiet_NaN();
  long steps = 0;                       ///< of Newton's method
  std::vector<Vec> states{};            ///< at the starts of revolutions
  CVec multipliers{};                   ///< of the period, the largest first
  CVec exponents{};                     ///< [1/s]
  std::vector<MultiplierMode> modes{};  ///< of the multipliers; empty: not told
  bool is_stable = false;
  std::vector<ContactMeasure> contacts{};  ///< shares of the period
  std::vector<OrbitProbe> probes{};        ///< of the model; empty: there is no orbit
  Failure failure{};
  std::optional<OrbitSeries> series{};  ///< of harmonic balance

  bool is_good() const { return !failure; }
  std::optional<bool> stability() const;  ///< nothing: there is no orbit
  const Vec& state() const { return states.front(); }
  std::vector<ContactShare> contact_shares() const;

  static constexpr auto columns() {
    using O = FoundOrbit;
    return ColumnList{
        column("period_revs", &O::period, "", "revolutions"),
        column("shortest_period_revs", &O::shortest_period, "", "after which it repeats"),
        column("residual", &O::residual, "", "[length scales]"),
        column("steps", &O::steps, "", "of Newton's method"),
        column("floquet", &O::multipliers, "", "multipliers of the period, the largest first"),
        column("exponents", &O::exponents, "1/s", "log(multiplier) / period"),
        rows(&O::modes, "floquet_modes"),
        column("stable", &O::stability, "", "null: there is no orbit"),
        column("state", &O::state, "", "reduced, at phase 0"),
        rows(&O::contact_shares, "contacts"),
        rows(&O::probes, "probes").only(Written::in_json).maybe(),
        column("harmonic_balance", &O::series, "", "what it says beside").maybe(),
        column("failure", &O::failure, "", "why there is none").only(Written::in_json).maybe()};
  }
};

/// An orbit that repeats as seen from the rotor.
struct RotatingOrbit : AutonomousOrbit {
  double revolutions = 0.0;          ///< of its period
  std::vector<OrbitProbe> probes{};  ///< of the model; empty: there is no orbit

  long steps() const;                     ///< of Newton's method
  std::optional<bool> stability() const;  ///< nothing: there is no orbit

  static constexpr auto columns() {
    using O = RotatingOrbit;
    return ColumnList{
        column("period_revs", &O::revolutions, "", "revolutions"),
        column("period", &O::period, "s", "as a time"),
        column("residual", &O::residual, "", "[length scales]"),
        column("steps", &O::steps, "", "of Newton's method"),
        column("floquet", &O::multipliers, "", "multipliers of the period, the largest first"),
        column("stable", &O::stability, "", "null: there is no orbit"),
        column("state", &O::state, "", "reduced, at phase 0"),
        rows(&O::probes, "probes").only(Written::in_json).maybe(),
        column("failure", &O::failure, "", "why there is none").only(Written::in_json).maybe()};
  }
};

/// The orbit near a state at phase 0, with its stability.
FoundOrbit find_orbit_near(const Scene& scene, const Vec& start, const OrbitOptions& options);

/// The orbit near the end of a transient; if the transient failed or was stopped, why there is no
/// orbit.
FoundOrbit find_orbit_after(const Trajectory& transient, const Scene& scene,
                            const OrbitOptions& options);

/// Time after which a motion from a start comes back as seen from the rotor [s].
/// @throws NumericalError  if the motion does not come back
double guessed_period(const Scene& scene, const Vec& start);

/// The orbit near a start that repeats as seen from the rotor, with its shortest period.
/// @param flow  of the scene as seen from the rotor
/// @throws NumericalError  as guessed_period
RotatingOrbit find_rotating_orbit(const AutonomousFlow& flow, const Scene& scene, const Vec& start);

}  // namespace whirl::inline dyn

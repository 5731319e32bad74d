#pragma once
/// Periodic orbits of a rotor, however they are found.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "libbase/column.hpp"
#include "libbase/field.hpp"
#include "libdyn/orbits/cycle.hpp"
#include "libdyn/orbits/harmonic_balance.hpp"
#include "libdyn/orbits/multiplier_modes.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// How orbits are found.
enum class OrbitMethod { shooting, harmonic_balance };
constexpr auto choices(OrbitMethod) {
  return std::array{Choice<OrbitMethod>{"shooting", OrbitMethod::shooting},
                    Choice<OrbitMethod>{"harmonic-balance", OrbitMethod::harmonic_balance}};
}

/// Where orbits are seen from, to be closed.
enum class OrbitFrame { stationary, rotating };
constexpr auto choices(OrbitFrame) {
  return std::array{Choice<OrbitFrame>{"stationary", OrbitFrame::stationary},
                    Choice<OrbitFrame>{"rotating", OrbitFrame::rotating}};
}

/// Of an orbit in the stationary frame.
struct OrbitOptions {
  OrbitMethod method = OrbitMethod::shooting;
  int period = 1;            ///< [revolutions]
  int harmonics = 0;         ///< of harmonic balance; 0: as many as it takes
  bool is_verified = false;  ///< an orbit of harmonic balance is compared with that of shooting
};

/// How far an orbit of harmonic balance is from the one that shooting finds from the same states.
struct ShootingGap {
  double displacement = 0.0, velocity = 0.0;  ///< at the starts of revolutions [length scales]
  double multiplier = 0.0;                    ///< of each, from the nearest of shooting
  double residual = 0.0;                      ///< of shooting [length scales]
  std::string failure;                        ///< of shooting; empty: it found one
};

/// What harmonic balance says of an orbit beside; in group /orbit its amplitudes.
struct OrbitSeries {
  int harmonics = 0;        ///< of the orbit's frequency
  double truncation = 0.0;  ///< what those left out change [length scales]; NaN: not known
  std::vector<HarmonicOrbit::Level> levels{};  ///< on the way
  int missing_multipliers = 0;                 ///< too small to be told
  int averaged_multipliers = 0;                ///< of modes too fast for the harmonics
  std::string stability_failure{};             ///< empty: the multipliers are known
  Vec orders{};                                ///< frequency over speed of each amplitude, from 0
  CMat amplitudes{};  ///< of all points: displacement = Re sum amplitude e^(i order phase) [m, rad]
  std::optional<ShootingGap> gap{};  ///< if it is asked for

  static constexpr std::string_view group = "/orbit";
  static constexpr auto columns() {
    using S = OrbitSeries;
    return std::tuple{
        column("order", &S::orders, "", "frequency over speed").axis("orders"),
        column("amplitude", &S::amplitudes, "m, rad",
               "displacement of all points is Re sum amplitude e^(i order phase)")
            .along("full orders"),
        column("truncation", &S::truncation, "", "what orders left out change").maybe()};
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
  std::string failure{};                   ///< empty: it is an orbit
  std::optional<OrbitSeries> series{};     ///< of harmonic balance

  bool is_good() const { return failure.empty(); }
};

/// The orbit near a state at phase 0, with its stability.
FoundOrbit find_orbit_near(const Scene& scene, const Vec& start, const OrbitOptions& options);

/// Time after which a motion from a start comes back as seen from the rotor [s].
/// @throws NumericalError  if it does not
double guessed_period(const Scene& scene, const Vec& start);

/// The orbit near a start that repeats as seen from the rotor, after the shortest period it has.
/// @param flow  of the scene as seen from there
/// @throws NumericalError  as guessed_period
Cycle find_rotating_orbit(const FreeFlow& flow, const Scene& scene, const Vec& start);

}  // namespace whirl::inline dyn

#pragma once
/// Options that several verbs share.

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libio/results/motion_window.hpp"
#include "libio/text/option.hpp"

namespace whirl::inline cli {

/// [rad/s]
inline Option<std::vector<double>> speeds_option() {
  return {"speeds", "A:B:STEP", "speeds, such as 0:8000:50rpm", parse_speeds};
}

// of motions
/// Ranges of what several verbs count. Each bounds what a number alone can cost; memory is checked
/// besides, where it grows with several numbers (libbase/system/memory.hpp).
inline constexpr Whole mode_range{1, 10'000};
inline constexpr Whole revolution_range{1, 10'000'000};
inline constexpr Whole discard_range{0, 10'000'000};
inline constexpr Whole point_range{2, 1'000'000};
inline constexpr Whole start_range{1, 1'000'000};
inline constexpr Whole period_range{1, 1000};
inline constexpr Whole step_range{1, 1'000'000};
inline constexpr Whole seed_range{0, 1'000'000'000};  // which costs nothing

inline Option<long> discard_option() {
  return {"discard", "N", "revolutions before them, for the transient", 500, discard_range};
}
inline Option<double> tolerance_option() {
  return {"tolerance", "T", "of a step, displacements by the clearance", 1e-10, parse_tolerance};
}
/// Which Lyapunov exponents are computed, and how well.
struct ExponentVerbOptions {
  Option<int> count{"lyapunov", "N",
                    "Lyapunov exponents that are computed, the largest ones, of which two tell "
                    "every kind of motion; left out: all",
                    Whole{1, 1000}};
  Option<double> resolution{"resolution", "R",
                            "chaos is averaged until its largest exponent is known to this "
                            "[1/revolution]; left out: over all revolutions",
                            parse_resolution};
  auto fields() { return std::tie(count, resolution); }
};

inline Option<std::string> from_option() {
  return file_option("from", "FILE.h5", "start where a result ended");
}
inline Option<std::string> isa_option() {
  return {"isa", "NAME",
          "instruction set of the integrator, such as avx2 or baseline; left out: the best one"};
}
inline Option<std::uint64_t> seed_option() {
  return {"seed", "S", "of the random starts", 1, seed_range};
}
inline Option<double> start_size_option() {
  return {"size", "R", "how far they are, in clearances", 0.5};
}

/// What motions are classified with.
enum class StepMethod { taylor, rk4 };
constexpr auto choices(StepMethod) {
  return std::array{Choice<StepMethod>{"taylor", StepMethod::taylor},
                    Choice<StepMethod>{"rk4", StepMethod::rk4}};
}
struct StepVerbOptions {
  Option<StepMethod> method{"method", "M",
                            "taylor, or rk4: the classical Runge-Kutta method with equal steps, "
                            "slow, to see what studies that use it see",
                            StepMethod::taylor};
  Option<long> steps{"steps", "N", "of rk4 in a revolution", 1000, step_range};
  auto fields() { return std::tie(method, steps); }

  /// As ClassifyOptions has it: 0 without rk4.
  /// @throws ModelError  for a number that no method takes
  long rk4_steps() const {
    const bool is_rk4 = *method == StepMethod::rk4;
    if (steps.is_given && !is_rk4) throw steps.wrong("goes with --method rk4 only");
    return is_rk4 ? *steps : 0;
  }
  /// Notes on motions by rk4; none with another method.
  std::vector<std::string> notes() const {
    if (rk4_steps() == 0) return {};
    return {
        fmt::format("motions are those that {} equal steps of rk4 a revolution make: kinds change "
                    "with the steps, and no orbit is proven",
                    *steps)};
  }
};

// of results
inline Option<std::string> frequency_option() {
  return {"frequency", "U",
          "unit of frequency axes: Hz, cpm or rad/s; left out: as --units says, else Hz", "Hz"};
}

/// Which stretch of a motion is shown.
struct WindowVerbOptions {
  Option<long> from_revolution{"from-revolution", "N",
                               "first revolution of a motion, counted from its start", seed_range};
  Option<long> revolutions{"revolutions", "N", "of a motion, given alone: the last ones",
                           revolution_range};
  Option<std::pair<double, double>> times{
      "times", "A:B", "instead of revolutions, from A to B [s] of a motion", parse_times};
  auto fields() { return std::tie(from_revolution, revolutions, times); }
};

}  // namespace whirl::inline cli

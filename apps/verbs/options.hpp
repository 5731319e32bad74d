#pragma once
/// Options that several verbs share.

#include "apps/verb.hpp"

namespace whirl::inline cli {

constexpr OptionSpec speeds_option{"speeds", "A:B:STEP", "speeds, such as 0:8000:50rpm"};

// of motions
constexpr OptionSpec discard_option{"discard", "N", "revolutions before them, for the transient",
                                    "500"};
constexpr OptionSpec tolerance_option{"tolerance", "T", "of a step, displacements by the clearance",
                                      "1e-10"};
constexpr OptionSpec from_option{"from", "FILE.h5", "start where a result ended"};
constexpr OptionSpec seed_option{"seed", "S", "of the random starts", "1"};
constexpr OptionSpec start_size_option{"size", "R", "how far they are, in clearances", "0.5"};

// of orbits and circles, and of their branches
constexpr OptionSpec frame_option{"frame", "F", "in which it repeats: stationary or rotating",
                                  "stationary"};
constexpr OptionSpec orbit_method_option{"method", "M", "shooting or harmonic-balance", "shooting"};
constexpr OptionSpec harmonics_option{
    "harmonics", "N",
    "of harmonic balance, of the orbit's frequency; left out: as many as it takes"};
constexpr OptionSpec branch_discard_option{
    "discard", "N", "revolutions before it, for the transient; with --from none", "500"};
constexpr OptionSpec branch_points_option{"points", "N",
                                          "how many values a range without a step has", "101"};

// of studies
constexpr OptionSpec over_option{
    "over", "PATH=A:B:STEP",
    "a value of the model and what it runs over: first:last:step, first:last "
    "with --points, or value,value,..."};
constexpr OptionSpec points_option{"points", "N", "how many values a range without a step has"};
constexpr OptionSpec restart_option{"restart", "", "begin anew, whatever the file of --out holds"};

// of results
constexpr OptionSpec frequency_option{"frequency", "U", "unit of frequency axes: Hz, cpm or rad/s",
                                      "Hz"};
constexpr OptionSpec from_revolution_option{"from-revolution", "N",
                                            "first revolution of a motion, counted from its start"};
constexpr OptionSpec times_option{"times", "A:B",
                                  "instead of revolutions, from A to B [s] of a motion"};

}  // namespace whirl::inline cli

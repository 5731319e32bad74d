#pragma once
/// Options of the verb orbit, which finds one orbit from a motion, or many from random starts.

#include "libverbs/options/orbits.hpp"

namespace whirl::inline cli {

struct OrbitVerbOptions {
  Option<int> period{"period", "N",
                     "revolutions after which it repeats; with --point those of its branch", 1,
                     period_range};
  Option<OrbitFrame> frame = frame_option();
  Option<long> point{"point", "N",
                     "begins at this point of the branches of --from, its value included",
                     Whole{1, 1'000'000'000}};
  OrbitMethodVerbOptions how{};
  Flag verify{"verify", "how far harmonic balance is from shooting"};
  Option<long> starts{"starts", "N", "all orbits near so many random starts, unstable ones too",
                      start_range};
  Option<std::uint64_t> seed = seed_option();
  Option<double> size = start_size_option();
  SettledVerbOptions settled{
      .discard = {"discard", "N",
                  "revolutions before it, for the transient; with --from none, with --starts 10",
                  500, discard_range}};
  Option<std::string> from = from_option();
  auto fields() {
    return std::tie(period, frame, point, how, verify, starts, seed, size, settled, from);
  }
};

/// Orbits near random starts.
Report search_orbits(const Invocation& call, const OrbitVerbOptions& asked);

}  // namespace whirl::inline cli

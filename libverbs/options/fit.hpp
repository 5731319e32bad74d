#pragma once
/// Options of fits to measured motions.

#include "libio/measured/record_values.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/measured.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

struct FitVerbOptions {
  RecordVerbOptions record{};
  Option<std::string> free{"free", "PATH[=LO:HI],...",
                           "values of the model that are found, with bounds if they have any"};
  Option<double> from{"from-revolution", "N", "revolutions of a record before those that count",
                      0.0, parse_revolutions};
  Option<double> revolutions{"revolutions", "N",
                             "of a record that count; 0: all, as with --steady if left out", 20.0,
                             parse_revolutions};
  Option<ProbeNoise> noise{"noise", "S",
                           "standard deviation of the probes' noise, such as 2um, or 1% of what "
                           "each reads; left out: what is left is noise",
                           parse_probe_noise};
  Option<int> steady{"steady", "N",
                     "the motion repeats after N revolutions: its average over all that count is "
                     "fitted to, as one that closes",
                     Whole{1, 10'000}};
  Flag offsets{"offsets", "find a constant that each probe adds, too, such as its gap"};
  Option<int> runout{"runout", "N",
                     "find what each probe reads of a shaft at rest at 1X to NX, too, the same in "
                     "all records",
                     Whole{1, 8}};
  Option<std::string> against =
      file_option("against", "FILE,...", "other models, told by their likelihood beside this one");
  Option<int> starts{"starts", "N", "of the search, the first one at the model's values", 1,
                     start_range};
  Option<std::uint64_t> seed = seed_option();
  auto fields() {
    return std::tie(record, free, from, revolutions, noise, steady, offsets, runout, against,
                    starts, seed);
  }
};

}  // namespace whirl::inline cli

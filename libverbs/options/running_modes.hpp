#pragma once
/// Options of verbs that find the modes of a running machine in a record.

#include <optional>

#include "libdata/measured/running_comparison.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/measured.hpp"

namespace whirl::inline cli {

struct RunningModesVerbOptions {
  Flag running_modes{"running-modes",
                     "find the modes that the rotor shows in the record, whatever drives it"};
  Option<int> order{"order", "N", "largest order of their models, two for each mode; left out: 60",
                    Whole{1, 1000}};
  Option<int> block_rows{"block-rows", "N",
                         "of the covariances they come from; left out: by what the record has",
                         Whole{1, 1000}};
  Option<double> highest{"highest", "F", "frequency of interest, for which samples are thinned out",
                         parse_frequency};
  Option<int> speed_harmonics{"speed-harmonics", "N", "of the speed that are taken out before", 10,
                              Whole{0, 1000}};
  Flag keep_harmonics{"keep-harmonics", "mark these, and leave them in the record"};
  auto fields() {
    return std::tie(running_modes, order, block_rows, highest, speed_harmonics, keep_harmonics);
  }
};

/// Running modes beside those of the model; nothing: they are not asked for.
/// @throws ModelError  for their options without --running-modes, and as running_modes
std::optional<RunningModes> find_running_modes(RunningModesVerbOptions asked,
                                               const Measurement& measurement,
                                               const MeasuredIdentification& measured,
                                               const Assembler& assembler);

}  // namespace whirl::inline cli
